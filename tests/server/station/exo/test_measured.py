"""What is measured is judged: broken, old, astray (SR-2)."""

from __future__ import annotations

from dataclasses import replace
from math import inf, nan

import numpy as np
import pytest
from quick_gate import HERE, LIMITS, RIGID, at, engaged, gate_rig, run

from server.experiments.gate.plant import QuickArm
from server.experiments.gate.rig import GOOD
from server.messages import Assistance, DriveState, Hold, Reset
from server.station.exo import safety
from server.station.exo.driver import ZERO, DriveReading
from server.station.exo.gate import GateState
from server.station.exo.limiter import Motion
from server.station.exo.measured import ASTRAY_RAD, sound
from server.station.exo.safety_state import SafetyState
from server.station.exo.set_points import as_measured


@pytest.mark.parametrize("t_s", [9.8, 10.2, nan, -inf])
def test_sr2_a_measurement_that_is_not_of_now_is_a_fault_at_the_expected_angles(t_s: float) -> None:
    got = sound(DriveReading(t_s, (9.0,) * 4, (9.0,) * 4, ZERO), HERE, None, 10.0, 0.01)
    assert "stopped measuring" in got.fault
    assert (got.angle_rad, got.velocity_rad_s) == (HERE, ZERO)


def test_sr2_a_drives_own_fault_is_told_before_ours() -> None:
    told = sound(DriveReading(0.0, (), ZERO, ZERO, fault="The motor is hot."), HERE, None, 10.0, 0.01)
    assert told.fault == "The motor is hot."


@pytest.mark.parametrize("mode", Assistance)
@pytest.mark.parametrize("elbow_rad", [1e300, 1.3])
def test_sr2_a_measurement_that_jumps_is_a_fault_and_no_set_point_goes_there(
    mode: Assistance, elbow_rad: float
) -> None:
    rig = engaged(mode, 0.5)
    before = rig.command.angle_rad
    run(rig, 0.01, scene=replace(GOOD, spoilt=lambda r: replace(r, angle_rad=(*r.angle_rad[:3], elbow_rad))))
    assert rig.now is DriveState.FAULT
    assert rig.command.angle_rad == pytest.approx(before, abs=0.01)
    run(rig, 1.0)
    assert rig.wish(Reset(number=9))


def test_sr2_an_angle_that_no_arm_can_have_moves_nothing_even_before_a_session() -> None:
    rig = gate_rig()
    rig.state = SafetyState()
    run(rig, 0.01, scene=replace(GOOD, spoilt=lambda r: replace(r, angle_rad=(1e300,) * 4)))
    assert max(rig.command.angle_rad) < 10.0


def test_sr2_a_drive_that_stops_measuring_is_a_fault_within_a_tenth_of_a_second() -> None:
    rig = engaged()
    last = rig.arm.read(rig.t_s)
    began_s = rig.t_s
    while rig.now is DriveState.ENGAGED:
        run(rig, 0.01, at(0, 0, 0, 0.3), replace(GOOD, spoilt=lambda reading: last))
    assert rig.now is DriveState.FAULT
    assert rig.t_s - began_s <= 0.115


def test_sr2_a_drive_that_lies_about_where_it_is_faults_soon_after_its_command_has_gone_elsewhere() -> None:
    rig = engaged()
    lie = rig.arm.read(rig.t_s)
    run(rig, 2.0, at(0, 0, 0, 1.2), replace(GOOD, spoilt=lambda reading: replace(lie, t_s=reading.t_s)))
    assert rig.now is DriveState.FAULT
    assert rig.state.gate.reason == "The elbow does not follow its command."
    assert abs(rig.arm.angle_rad[3] - HERE[3]) < 0.8


def test_sr2_a_drive_that_does_not_obey_faults() -> None:
    rig = engaged(device=RIGID)
    run(rig, 2.0, at(0, 0.6, 0, 0), replace(GOOD, obeyed=False))
    assert rig.state.gate.reason == "The elevation does not follow its command."


def test_an_arm_that_the_person_keeps_from_its_set_point_is_not_astray_while_it_is_only_assisted() -> None:
    rig = engaged(Assistance.ASSISTED, 0.3)
    rig.arm.push_nm = (0.0, 0.0, 0.0, -2.0)
    run(rig, 2.0, at(0, 0, 0, 0.4))
    assert abs(rig.arm.angle_rad[3] - rig.command.angle_rad[3]) > ASTRAY_RAD
    assert rig.now is DriveState.ENGAGED


@pytest.mark.parametrize(("over_rad", "state"), [(0.04, DriveState.ENGAGED), (0.06, DriveState.FAULT)])
def test_sr1_a_free_arm_may_lean_on_the_end_of_its_range_up_to_the_tolerance(
    over_rad: float, state: DriveState
) -> None:
    rig = engaged(Assistance.FREE)
    end = rig.limits[3].max_rad
    for elbow_rad in np.arange(HERE[3], end + over_rad, 0.01):
        measured_rad = (*HERE[:3], float(elbow_rad))
        run(
            rig,
            0.01,
            scene=replace(GOOD, spoilt=lambda r, to=measured_rad: replace(r, angle_rad=to, velocity_rad_s=ZERO)),
        )
    assert rig.now is state


def test_sr2_an_arm_that_is_put_in_somewhere_else_has_not_jumped() -> None:
    rig = gate_rig()
    rig.arm = QuickArm(tuple(angle + 0.4 for angle in HERE))
    rig.state = safety.put_in(rig.state, rig.arm.read(rig.t_s), rig.t_s)
    run(rig, 0.1)
    assert rig.now is DriveState.READY


def test_sr1_an_arm_that_is_held_and_measured_outside_its_range_is_a_fault() -> None:
    rig = engaged()
    assert rig.wish(Hold(number=3, reason=""))
    run(rig, 0.5)
    assert rig.now is DriveState.HOLD
    top_rad = LIMITS[1].max_rad
    rig.state = replace(rig.state, seen_rad=(HERE[0], top_rad, *HERE[2:]))
    run(rig, 0.01, scene=replace(GOOD, spoilt=lambda r: replace(r, angle_rad=(HERE[0], top_rad + 0.03, *HERE[2:]))))
    assert rig.now is DriveState.FAULT
    assert "outside the patient's range" in rig.state.gate.reason


def test_sr2_a_drive_with_a_fault_moves_no_set_point_before_a_session_either() -> None:
    rig = gate_rig()
    rig.state = replace(rig.state, gate=GateState())
    elsewhere = tuple(angle + 0.2 for angle in HERE)
    run(rig, 0.1, scene=replace(GOOD, spoilt=lambda r: replace(r, angle_rad=elsewhere, fault="The encoder is loose.")))
    assert rig.now is DriveState.OFF
    assert rig.command.angle_rad == HERE


def test_sr1_a_set_point_that_begins_where_the_arm_moves_leaves_itself_room_to_brake() -> None:
    rig = gate_rig()
    top_rad, top_rad_s = rig.boxes[1].high_rad, LIMITS[1].velocity_rad_s
    place, speed = (HERE[0], top_rad - 0.02, *HERE[2:]), (0.0, top_rad_s, 0.0, 0.0)
    inputs = replace(rig.inputs, reading=replace(rig.inputs.reading, angle_rad=place, velocity_rad_s=speed))
    assert as_measured(inputs)[1] == Motion(top_rad - 0.02)
    back = replace(inputs, reading=replace(inputs.reading, velocity_rad_s=(0.0, -top_rad_s, 0.0, 0.0)))
    assert as_measured(back)[1].velocity_rad_s == -top_rad_s


def test_sr1_a_yielding_arm_that_leans_out_of_its_range_is_held_at_the_ranges_end() -> None:
    rig = engaged(Assistance.ASSISTED, 0.3, seconds=5.0)
    end_rad = LIMITS[3].max_rad
    rig.state = replace(rig.state, seen_rad=(*HERE[:3], end_rad))
    assert rig.wish(Hold(number=3, reason=""))
    run(rig, 0.01, scene=replace(GOOD, spoilt=lambda r: replace(r, angle_rad=(*HERE[:3], end_rad + 0.03))))
    assert rig.now is DriveState.HOLD
    assert rig.command.angle_rad[3] == end_rad
