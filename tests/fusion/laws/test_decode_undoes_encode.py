"""What a sensor says in any dialect, frame after frame, is heard: the same bodies at the same instants."""

from __future__ import annotations

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from hypothesis.extra.numpy import arrays

from fusion.formats.decoder import Decoder
from fusion.formats.dialect import Dialect
from fusion.formats.osceleton2 import NAMES
from fusion.formats.registry import DIALECTS
from fusion.messages import Packet, SkeletonSample
from fusion.skeleton import JOINT_COUNT

STREAM = "10.0.0.5"
WRAP = 2**31
EPOCHS_S = st.sampled_from([0.0, 1.7e9, -5.0, 86_400.0])
IDS = {"kinectv2-osc": 2**64 - 1, "osceleton2": 2**31 - 1, "mirrorlimb": 2**64 - 1}
SAYABLE = {name: sorted(set(NAMES.values())) if name == "osceleton2" else list(range(JOINT_COUNT)) for name in IDS}


@st.composite
def streams(draw: st.DrawFn, dialect: str) -> list[SkeletonSample]:
    """A few frames of one to three bodies, 20 ms and more apart; lost joints are NaN, positions fit float32."""
    bodies = draw(st.lists(st.integers(0, IDS[dialect]).map(str), min_size=1, max_size=3, unique=True))
    t_s, found = draw(EPOCHS_S), []
    for _ in range(draw(st.integers(1, 4))):
        for body in bodies:
            state = draw(arrays(np.uint8, JOINT_COUNT, elements=st.integers(0, 2)))
            positions = draw(arrays(np.float64, (JOINT_COUNT, 3), elements=st.floats(-49, 49, width=32)))
            positions[state == 0] = np.nan
            found.append(SkeletonSample("k", body, t_s, t_s, positions, state))
        t_s += draw(st.floats(0.02, 2.0))
    return found


@pytest.mark.parametrize("dialect", DIALECTS, ids=lambda dialect: dialect.name)
@settings(max_examples=30)
@given(data=st.data(), first=st.sampled_from([0, 7, WRAP - 2]))
def test_frame_after_frame(dialect: Dialect, data: st.DataObject, first: int) -> None:
    sent = data.draw(streams(dialect.name))
    decoder, came = Decoder(), []
    for number, sample in enumerate(sent):
        for payload in dialect.encode(sample, first + number):
            came += decoder.feed(Packet(STREAM, sample.t_s, payload))
    came += decoder.flush(sent[-1].t_s + 1.0)
    assert [(sample.body, sample.t_s) for sample in came] == [
        (sample.body, pytest.approx(sample.t_s, abs=1e-6)) for sample in sent
    ]
    says, exact = SAYABLE[dialect.name], dialect.name != "osceleton2"
    for one, other in zip(came, sent, strict=True):
        np.testing.assert_array_equal(one.state[says], other.state[says])
        tolerance = 0.0 if exact else 1e-6  # float32 millimetres
        np.testing.assert_allclose(
            one.positions_in_sensor[says], other.positions_in_sensor[says], rtol=tolerance, atol=tolerance * 1e-3
        )
    assert not dict(decoder.counts().refused)
