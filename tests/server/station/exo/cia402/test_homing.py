"""A joint finds its home only when it is asked to, and stops when nobody watches."""

from __future__ import annotations

import pytest
from cia402_bench import Bench, emulated, four_joints, powered

from fusion.errors import InputError, MachineError
from server.cli.exoskeleton_home import walk_home
from server.cli.exoskeleton_wizard import Dialogue
from server.exoskeleton import BUILT_IN
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


def test_people_are_asked_before_each_joint_that_needs_it_and_a_no_leaves_it(bench: Bench) -> None:
    bench.order("forget elbow")
    bench.order("forget shoulder plane")
    asked: list[str] = []
    said: list[str] = []

    def answer(question: str) -> str:
        asked.append(question)
        return "y" if "elbow" in question else ""

    walk_home(bench.exoskeleton, Dialogue(answer, said.append))
    assert len(asked) == 2
    assert is_homed(bench.exoskeleton, "elbow")
    assert not is_homed(bench.exoskeleton, "shoulder plane")
    assert "elbow: homed, and holds." in said


def test_a_device_without_drives_of_this_kind_has_no_homing() -> None:
    with pytest.raises(InputError, match="simulated"):
        walk_home(BUILT_IN, Dialogue(str, str))
