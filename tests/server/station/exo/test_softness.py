"""How softly each joint is held: stop categories, torque bounds, walls (SR-1, SR-2, SR-7)."""

from __future__ import annotations

from dataclasses import replace

import msgspec
import pytest
from quick_gate import COMPLIANT, ELBOW, HERE, LIMITS, RIGID, STATION, at, engaged, gate_rig, run

from server.exoskeleton import Follows, StopCategory
from server.experiments.gate.rig import CONFIG
from server.messages import Assistance, DriveState, Hold, Stop
from server.station.exo.measured import YIELDING_TOLERANCE_RAD
from server.station.exo.softness import SOFT_SHARE, device_of, wall

SOFT_ELBOW = replace(COMPLIANT, soft_stop=(False, False, False, True))


def test_sr7_the_stop_category_of_each_angle_comes_from_the_joints_that_move_it() -> None:
    def soft(follows: Follows) -> tuple[bool, ...]:
        joints = tuple(
            msgspec.structs.replace(joint, stop=StopCategory.COMPLIANT if joint.follows is follows else joint.stop)
            for joint in STATION.exoskeleton.joints
        )
        return device_of(msgspec.structs.replace(STATION.exoskeleton, joints=joints), can_comply=True).soft_stop

    assert soft(Follows.ELBOW) == (False, False, False, True)
    assert soft(Follows.AXIAL_ROTATION) == (True, False, True, False)
    assert soft(Follows.NONE) == (False,) * 4


def test_sr7_a_stop_holds_each_joint_as_its_category_says_and_none_falls() -> None:
    rig = engaged(device=SOFT_ELBOW)
    assert rig.wish(Stop(number=3, reason=""))
    run(rig, 10.0)
    assert rig.command.share == (1.0, 1.0, 1.0, SOFT_SHARE)
    assert rig.command.torque_nm[:3] == tuple(joint.torque_nm for joint in LIMITS[:3])
    assert 0 < rig.command.torque_nm[ELBOW] < LIMITS[ELBOW].torque_nm
    assert rig.arm.angle_rad == pytest.approx(HERE, abs=0.05)


def test_sr7_a_persons_hold_is_firm_whatever_the_category() -> None:
    rig = engaged(device=SOFT_ELBOW)
    assert rig.wish(Hold(number=3, reason=""))
    run(rig, 0.5)
    assert rig.command.share == (1.0,) * 4


def test_sr2_every_command_is_bounded_by_the_patients_torque() -> None:
    for rig in (gate_rig(), engaged(), engaged(Assistance.FREE), engaged(device=RIGID)):
        assert rig.command.torque_nm == tuple(joint.torque_nm for joint in LIMITS)


def test_sr1_the_wall_rises_from_none_at_the_soft_margin_to_all_at_the_end_of_the_range() -> None:
    rig = gate_rig()

    def elbow_at(angle_rad: float, velocity_rad_s: float = 0.0) -> float:
        reading = replace(
            rig.inputs.reading, angle_rad=(*HERE[:3], angle_rad), velocity_rad_s=(0.0, 0.0, 0.0, velocity_rad_s)
        )
        return wall(replace(rig.inputs, reading=reading))[ELBOW]

    low, high = LIMITS[ELBOW].min_rad, LIMITS[ELBOW].max_rad
    assert elbow_at(low + CONFIG.soft_margin_rad) == elbow_at(high - CONFIG.soft_margin_rad) == 0.0
    assert elbow_at(high - CONFIG.soft_margin_rad / 2) == pytest.approx(0.5)
    assert [elbow_at(low), elbow_at(high), elbow_at(high + 1.0)] == pytest.approx([1.0] * 3)
    assert elbow_at(high - 0.2, 1.5) > 0.0 == elbow_at(high - 0.2, -1.5)
    assert [elbow_at(HERE[ELBOW], much * LIMITS[ELBOW].velocity_rad_s) for much in (1.0, -1.0, 1.25)] == [0.0, 0.0, 1.0]


def test_sr7_an_arm_that_was_free_is_stopped_where_it_is_and_held_firmly_soon() -> None:
    rig = engaged(Assistance.FREE)
    rig.arm.push_nm = (0.0, 0.0, 0.0, 2.0)
    run(rig, 0.4)
    assert rig.arm.angle_rad[ELBOW] > HERE[ELBOW] + 0.1
    rig.arm.push_nm = (0.0,) * 4
    moving_at = rig.arm.angle_rad[ELBOW]
    assert rig.wish(Stop(number=3, reason=""))
    run(rig, 0.3)
    assert rig.command.share == (1.0,) * 4
    run(rig, 1.0, at(0, 0, 0, 0))
    assert rig.now is DriveState.STOPPED
    assert 0 <= rig.arm.angle_rad[ELBOW] - moving_at < 0.4


def test_sr1_sr2_a_free_arm_that_is_pushed_hard_is_braked_before_the_end_of_its_range() -> None:
    rig = engaged(Assistance.FREE)
    rig.arm.push_nm = (0.0, 0.0, -0.75 * LIMITS[2].torque_nm, 0.0)
    run(rig, 2.0)
    assert rig.arm.angle_rad[2] >= LIMITS[2].min_rad - YIELDING_TOLERANCE_RAD
    assert rig.now is DriveState.ENGAGED
