"""An arm that resists is given way to (SR-18, SR-2)."""

from __future__ import annotations

from dataclasses import replace

import pytest
from quick_gate import ELBOW, HERE, LIMITS, RIGID, at, engaged, refusal, run

from server.experiments.gate.plant import QuickArm
from server.experiments.gate.rig import GOOD, GateRig, opening
from server.messages import Assistance, CloseSession, DriveState, Pain, Resume, Stop
from server.station.exo import safety
from server.station.exo.driver import DriveMode, Joints
from server.station.exo.softness import SOFT_SHARE

OVER_NM = LIMITS[ELBOW].resistance_nm + 1.0


def elbow(nm: float) -> Joints:
    return (0.0, 0.0, 0.0, nm)


def bending(device_rigid: bool = False) -> GateRig:
    """The elbow is being bent."""
    rig = engaged(device=RIGID) if device_rigid else engaged()
    run(rig, 0.3, at(0, 0, 0, 0.8))
    assert rig.command.velocity_rad_s[ELBOW] > 0.3
    return rig


def test_sr18_resistance_is_given_way_to_in_the_third_tick_and_names_the_joint() -> None:
    rig = bending()
    rig.arm.push_nm = elbow(-OVER_NM)
    run(rig, 0.02, at(0, 0, 0, 0.8))
    assert rig.now is DriveState.ENGAGED
    run(rig, 0.01, at(0, 0, 0, 0.8))
    assert rig.now is DriveState.HOLD
    assert rig.state.gate.reason == f"The elbow resists with {OVER_NM:.1f} N m; the arm is held softly."
    assert max(rig.command.share) <= SOFT_SHARE
    assert rig.command.torque_nm[ELBOW] < LIMITS[ELBOW].torque_nm


def test_sr18_a_single_outlier_of_the_torque_sensor_is_no_resistance() -> None:
    rig = bending()
    for _ in range(20):
        rig.arm.push_nm = elbow(-30.0)
        run(rig, 0.01, at(0, 0, 0, 0.8), replace(GOOD))
        rig.arm.push_nm = elbow(0.0)
        run(rig, 0.02, at(0, 0, 0, 0.8))
    assert rig.now is DriveState.ENGAGED


def test_sr18_what_the_patient_adds_to_the_motion_is_no_resistance() -> None:
    rig = bending()
    rig.arm.push_nm = elbow(OVER_NM)
    run(rig, 0.1, at(0, 0, 0, 0.8))
    assert rig.now is DriveState.ENGAGED


def test_sr2_more_torque_than_the_drive_may_use_is_given_way_to_whichever_way_it_points() -> None:
    rig = bending()
    rig.arm.push_nm = elbow(LIMITS[ELBOW].torque_nm + 1.0)
    run(rig, 0.05, at(0, 0, 0, 0.8))
    assert rig.now is DriveState.HOLD
    assert rig.state.gate.compliant


@pytest.mark.parametrize("nm", [OVER_NM, -OVER_NM])
def test_sr18_an_arm_that_is_held_still_resists_either_way(nm: float) -> None:
    rig = engaged()
    rig.arm.push_nm = elbow(nm)
    run(rig, 0.05)
    assert rig.state.gate.compliant


def test_sr18_a_compliant_hold_goes_back_to_where_the_arm_began_to_resist() -> None:
    rig = bending()
    rig.arm.push_nm = elbow(-OVER_NM)
    run(rig, 0.03, at(0, 0, 0, 0.8))
    place = rig.arm.angle_rad[ELBOW]
    rig.arm.push_nm = elbow(0.0)
    run(rig, 2.0, at(0, 0, 0, 0.8))
    assert rig.command.mode is DriveMode.HOLD
    assert rig.command.angle_rad[ELBOW] == pytest.approx(place, abs=2e-3)


def test_sr18_the_arm_pushes_a_compliant_hold_away_and_is_not_let_go() -> None:
    rig = engaged()
    assert rig.wish(Pain(number=3, reason=""))
    rig.arm.push_nm = elbow(-5.0)
    run(rig, 3.0)
    assert HERE[ELBOW] - rig.arm.angle_rad[ELBOW] > 0.2
    assert rig.limits[ELBOW].min_rad < rig.arm.angle_rad[ELBOW]
    assert rig.now is DriveState.HOLD


def test_sr18_a_drive_that_cannot_comply_holds_where_the_arm_began_to_resist() -> None:
    rig = bending(device_rigid=True)
    rig.arm.push_nm = elbow(-OVER_NM)
    run(rig, 0.03, at(0, 0, 0, 0.8))
    place = rig.arm.angle_rad[ELBOW]
    assert (rig.now, rig.command.share) == (DriveState.HOLD, (1.0,) * 4)
    assert rig.state.gate.reason.endswith("N m; the arm is held.")
    run(rig, 2.0, at(0, 0, 0, 0.8))
    assert rig.command.angle_rad[ELBOW] == pytest.approx(place, abs=2e-3)


def test_sr18_only_a_person_resumes_and_not_while_the_arm_still_resists() -> None:
    rig = engaged(device=RIGID)
    rig.arm.push_nm = elbow(OVER_NM)
    run(rig, 1.0)
    assert "elbow resists" in refusal(rig, Resume(number=3))
    rig.arm.push_nm = elbow(0.0)
    run(rig, 5.0)
    assert rig.now is DriveState.HOLD
    assert rig.wish(Resume(number=4))


def test_sr18_a_person_who_moves_a_free_arm_too_fast_is_held_softly() -> None:
    rig = engaged(Assistance.FREE)
    fast = 1.5 * LIMITS[ELBOW].velocity_rad_s + 0.4
    run(rig, 0.01, scene=replace(GOOD, spoilt=lambda r: replace(r, velocity_rad_s=elbow(fast))))
    assert (rig.now, rig.state.gate.compliant) == (DriveState.HOLD, True)
    assert "elbow moves faster" in rig.state.gate.reason


def test_sr7_sr18_a_stop_in_a_compliant_hold_stays_soft_and_does_not_fall() -> None:
    rig = engaged()
    assert rig.wish(Pain(number=3, reason=""))
    assert rig.wish(Stop(number=4, reason=""))
    run(rig, 10.0)
    assert max(rig.command.share) <= SOFT_SHARE
    assert rig.arm.angle_rad == pytest.approx(HERE, abs=0.05)


def test_sr5_sr18_the_next_patients_arm_does_not_move_to_where_the_last_one_gave_way() -> None:
    rig = engaged()
    run(rig, 3.0, at(0, 0.5, 0, 0.5))
    for wish in (Pain(number=3, reason=""), Stop(number=4, reason=""), CloseSession(number=5), opening()):
        assert rig.wish(wish)
        run(rig, 0.5)
    rig.arm = QuickArm((0.5, 0.3, 0.0, 0.5))
    rig.state = safety.put_in(rig.state, rig.arm.read(rig.t_s), rig.t_s)
    run(rig, 2.0)
    assert (rig.now, rig.state.gate.compliant) == (DriveState.STOPPED, True)
    assert rig.command.angle_rad == pytest.approx((0.5, 0.3, 0.0, 0.5), abs=1e-3)


def test_sr18_an_arm_that_resists_after_a_stop_is_held_softly_where_it_is() -> None:
    rig = engaged()
    assert rig.wish(Stop(number=3, reason=""))
    run(rig, 0.6)
    assert min(rig.command.share) == 1.0
    rig.arm.push_nm = elbow(OVER_NM)
    run(rig, 0.05)
    assert rig.now is DriveState.STOPPED
    assert rig.command.share[:ELBOW] == (SOFT_SHARE,) * ELBOW
    assert rig.command.torque_nm[0] < LIMITS[0].torque_nm
