"""SR-18: the range that the patient reaches unaided is taken from free movement alone."""

from importlib.util import module_from_spec, spec_from_file_location
from pathlib import Path

import msgspec
from hypothesis import given
from hypothesis import strategies as st

from fusion.skeleton import Side
from server.api.measured_range import RangeMeter
from server.messages import EXO_JOINTS, Assistance, DriveState


def _stand_in():
    spec = spec_from_file_location("stand_in_station", Path(__file__).with_name("stand_in_station.py"))
    module = module_from_spec(spec)
    spec.loader.exec_module(module)
    return module


TICK = _stand_in().tick(0, 10.0, DriveState.ENGAGED, "1", Side.RIGHT, assistance=Assistance.FREE)
angles = st.tuples(*[st.floats(-3.0, 3.0)] * len(EXO_JOINTS))


def reaching(angle_rad, state=DriveState.ENGAGED, assistance=Assistance.FREE):
    exo = msgspec.structs.replace(TICK.exo, angle_rad=angle_rad, assistance=assistance)
    return msgspec.structs.replace(TICK, state=state, exo=exo)


@given(st.lists(angles, min_size=2, max_size=20))
def test_sr18_the_range_is_from_the_least_angle_to_the_greatest(reached):
    meter = RangeMeter()
    for angle_rad in reached:
        meter.take(reaching(angle_rad))
    found = meter.read()
    assert found.ticks == len(reached)
    spans = [(min(column), max(column)) for column in zip(*reached, strict=True)]
    if all(high - low >= 0.02 for low, high in spans):
        measured = [getattr(found.range, joint) for joint in EXO_JOINTS]
        assert [(joint.min_rad, joint.max_rad) for joint in measured] == spans
    else:
        assert found.range is None


@given(st.sampled_from(DriveState), st.sampled_from(Assistance), angles)
def test_sr18_what_the_drive_moved_tells_nothing_of_the_patient(state, assistance, angle_rad):
    meter = RangeMeter()
    meter.take(reaching(angle_rad, state, assistance))
    counts = state is DriveState.ENGAGED and assistance is Assistance.FREE
    assert meter.read().ticks == int(counts)
