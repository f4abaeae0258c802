"""A joint finds its home only when it is asked to, and stops when nobody watches."""

from __future__ import annotations

import pytest
from cia402_bench import Bench, emulated, four_joints, powered

from fusion.errors import MachineError
from server.station.exo.cia402 import Cia402Drive
from server.station.exo.cia402.homing import home, is_homed


def test_a_joint_that_takes_the_present_position_does_not_move(bench: Bench) -> None:
    bench.order("forget elbow")
    before = bench.angles()
    assert not is_homed(bench.exoskeleton, "elbow")
    home(bench.exoskeleton, "elbow")
    assert is_homed(bench.exoskeleton, "elbow")
    assert bench.angles() == pytest.approx(before, abs=1e-3)


def test_a_joint_with_a_switch_moves_to_it_then_holds_and_may_be_used() -> None:
    with emulated(four_joints(homing_method=17)) as bench:
        bench.order("place elbow -0.2")
        bench.order("forget elbow")
        home(bench.exoskeleton, "elbow")
        assert bench.nodes["elbow"].drive.state.value == "quick stop active"
        assert bench.angles()["elbow"] == pytest.approx(0.0, abs=0.02)
        with Cia402Drive(bench.exoskeleton) as drive:
            assert powered(drive, bench).angle_rad[3] == pytest.approx(0.2, abs=0.02)


def test_a_fault_on_the_way_home_is_said() -> None:
    with emulated(four_joints(homing_method=17)) as bench:
        bench.order("forget elbow")
        bench.order("fault elbow 0x7305")
        with pytest.raises(MachineError, match="'elbow'"):
            home(bench.exoskeleton, "elbow")
