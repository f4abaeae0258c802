"""Assistance: as much as is needed, none, and from one to another (SR-1, SR-6)."""

from __future__ import annotations

from math import nan, sin

import pytest
from hypothesis import given
from hypothesis import strategies as st
from quick_gate import COMPLIANT, ELBOW, HERE, LIMITS, RIGID, at, engaged, gate_rig, refusal, run

from server.experiments.gate.rig import TICK_S, GateRig, opening
from server.messages import Assistance, CloseSession, DriveState, Enable, SetAssistance, Stop
from server.station.exo import assistance
from server.station.exo.assistance import BLEND_S, LEAST, Help
from server.station.exo.mapping import JointTarget

WEAK_NM = -2.0


def reaching(t_s: float) -> JointTarget:
    return at(0, 0, 0, 0.4 * sin(1.5 * t_s))


def chosen(mode: Assistance, level: float = 1.0, number: int = 9) -> SetAssistance:
    return SetAssistance(number=number, mode=mode, level=level)


def assisted(push_nm: float, seconds: float, level: float = 1.0) -> GateRig:
    """An arm whose elbow is kept back by so much."""
    rig = engaged(Assistance.ASSISTED, level)
    rig.arm.push_nm = (0.0, 0.0, 0.0, push_nm)
    run(rig, seconds, reaching)
    return rig


def test_help_fades_while_the_arm_tracks_well_and_returns_when_it_is_kept_back() -> None:
    rig = assisted(0.0, 12.0)
    faded = rig.command.share
    assert max(faded) < 0.25
    rig.arm.push_nm = (0.0, 0.0, 0.0, WEAK_NM)
    run(rig, 6.0, reaching)
    assert rig.command.share[ELBOW] > faded[ELBOW] + 0.1
    assert rig.command.share[:ELBOW] == pytest.approx(faded[:ELBOW], abs=0.05)


def test_a_weaker_arm_gets_more_help() -> None:
    shares = [assisted(nm, 10.0).state.help.share[ELBOW] for nm in (-0.8, -2.0, -4.0)]
    assert shares == sorted(shares)
    assert shares[-1] > shares[0] + 0.1


def test_help_stays_below_the_therapists_level_and_the_torque_below_the_patients_limit() -> None:
    rig = assisted(-4.0, 10.0, level=0.25)
    assert rig.state.help.share[ELBOW] <= 0.25 + 1e-9
    assert rig.command.torque_nm == tuple(joint.torque_nm for joint in LIMITS)


@given(
    st.lists(st.lists(st.floats(-3, 3), min_size=4, max_size=4), min_size=1, max_size=60),
    st.floats(0, 1),
    st.sampled_from(Assistance),
)
def test_whatever_the_error_help_stays_in_its_bounds_and_changes_no_faster_than_a_blend(
    errors: list[list[float]], level: float, mode: Assistance
) -> None:
    help_now = assistance.chosen(Help(), mode, level)
    for error in errors:
        after = assistance.helped(help_now, tuple(error), TICK_S)
        for before_share, share, needed in zip(help_now.share, after.share, after.needed, strict=True):
            assert abs(share - before_share) <= TICK_S / BLEND_S + 1e-12
            assert 0.0 <= share <= 1.0
            assert 0.0 <= needed <= 1.0
        help_now = after
    settled = help_now
    for _ in range(round(2 * BLEND_S / TICK_S)):
        settled = assistance.helped(settled, tuple(errors[-1]), TICK_S)
    if mode is Assistance.ASSISTED:
        assert all(min(LEAST, level) - 1e-9 <= share <= level + 1e-9 for share in settled.share)
    else:
        assert settled.share == pytest.approx((0.0 if mode is Assistance.FREE else 1.0,) * 4)


@given(st.floats(0, 3), st.floats(0, 3))
def test_a_larger_error_never_needs_less_help(one_rad: float, other_rad: float) -> None:
    small, large = sorted((one_rad, other_rad))
    start = Help(Assistance.ASSISTED, 1.0, needed=(0.3,) * 4)
    after = assistance.helped(start, (small, large, -small, -large), TICK_S)
    assert after.needed[0] == after.needed[2] <= after.needed[1] == after.needed[3]


def test_a_free_arm_goes_where_it_is_pushed_and_stays_in_its_range() -> None:
    rig = engaged(Assistance.FREE)
    for nm in (1.0, -1.0):
        rig.arm.push_nm = (0.0, 0.0, 0.0, nm)
        run(rig, 0.5)
        assert rig.now is DriveState.ENGAGED, rig.state.gate.reason
    assert rig.command.share[:ELBOW] == (0.0,) * ELBOW
    assert rig.command.angle_rad[ELBOW] == pytest.approx(rig.arm.angle_rad[ELBOW], abs=0.05)


@pytest.mark.parametrize("nm", [4.0, -4.0])
def test_sr1_a_free_arm_that_is_pushed_steadily_does_not_leave_its_range(nm: float) -> None:
    rig = engaged(Assistance.FREE)
    rig.arm.push_nm = (0.0, 0.0, 0.0, nm / 2)
    run(rig, 3.0)
    rig.arm.push_nm = (0.0, 0.0, 0.0, nm)
    run(rig, 3.0)
    angle = rig.arm.angle_rad[ELBOW]
    assert LIMITS[ELBOW].min_rad <= angle <= LIMITS[ELBOW].max_rad
    assert min(angle - LIMITS[ELBOW].min_rad, LIMITS[ELBOW].max_rad - angle) < 0.1


def test_a_free_arm_needs_no_healthy_arm_in_view() -> None:
    rig = engaged(Assistance.FREE)
    run(rig, 3.0, None)
    assert rig.now is DriveState.ENGAGED


def test_sr6_leading_a_free_arm_again_begins_where_it_is() -> None:
    rig = engaged(Assistance.FREE)
    rig.arm.push_nm = (0.0, 0.0, 0.0, 2.0)
    run(rig, 0.5)
    rig.arm.push_nm = (0.0,) * 4
    run(rig, 1.0)
    away = rig.arm.angle_rad[ELBOW] - HERE[ELBOW]
    assert away > 0.2
    assert rig.wish(chosen(Assistance.PASSIVE))
    run(rig, 0.01)
    assert rig.command.angle_rad[ELBOW] - HERE[ELBOW] == pytest.approx(away, abs=0.03)
    run(rig, 1.0)
    assert rig.command.angle_rad[ELBOW] - HERE[ELBOW] > 0.2 * away
    run(rig, 3.0)
    assert rig.command.angle_rad[ELBOW] == pytest.approx(HERE[ELBOW], abs=0.01)


def test_sr6_a_free_arm_is_not_led_while_the_target_is_far_or_not_seen() -> None:
    rig = engaged(Assistance.FREE)
    run(rig, 0.1, at(0, 0, 0, -0.9))
    far = at(0, 1.3, 0, 1.2)
    rig.arm.push_nm = (0.0, 0.0, 0.0, -1.2)
    run(rig, 1.0, far)
    rig.arm.push_nm = (0.0,) * 4
    run(rig, 1.0, far)
    assert rig.now is DriveState.ENGAGED, rig.state.gate.reason
    assert "too far" in refusal(rig, chosen(Assistance.ASSISTED))
    run(rig, 0.05, None)
    assert "not seen well enough" in refusal(rig, chosen(Assistance.PASSIVE))
    assert rig.state.help.mode is Assistance.FREE


def test_changing_the_level_changes_the_help_over_a_second() -> None:
    rig = engaged(Assistance.ASSISTED, 0.8)
    rig.arm.push_nm = (0.0, 0.0, 0.0, -4.0)
    run(rig, 8.0, reaching)
    high = rig.state.help.share[ELBOW]
    assert rig.wish(chosen(Assistance.ASSISTED, 0.1))
    run(rig, 0.1, reaching)
    assert rig.state.help.share[ELBOW] == pytest.approx(high - 0.1, abs=0.02)
    run(rig, 1.0, reaching)
    assert rig.state.help.share[ELBOW] <= 0.1 + 1e-9


@pytest.mark.parametrize("level", [-0.1, 1.1, nan])
def test_a_level_outside_its_bounds_is_refused_in_words(level: float) -> None:
    rig = engaged()
    assert "between 0 and 1" in refusal(rig, chosen(Assistance.ASSISTED, level))
    assert rig.wish(CloseSession(number=3))
    run(rig, 0.5)
    assert "between 0 and 1" in refusal(rig, opening(Assistance.ASSISTED, level))


def test_a_drive_that_cannot_yield_only_mirrors_and_says_so() -> None:
    rig = engaged(device=RIGID)
    for mode in (Assistance.ASSISTED, Assistance.FREE):
        assert "cannot yield" in refusal(rig, chosen(mode))
    assert rig.wish(chosen(Assistance.PASSIVE))


def test_sr5_assistance_is_not_chosen_while_nothing_is_open_or_it_is_stopped() -> None:
    for wanted, state in ((CloseSession(number=3), DriveState.OFF), (Stop(number=3, reason=""), DriveState.STOPPED)):
        rig = gate_rig()
        rig.wish(wanted)
        run(rig, 0.05)
        assert rig.now is state
        assert "Another assistance is not possible" in refusal(rig, chosen(Assistance.FREE))


def test_a_session_opens_with_the_assistance_that_it_was_agreed_with() -> None:
    rig = gate_rig(COMPLIANT)
    rig.wish(CloseSession(number=3))
    run(rig, 0.05)
    assert rig.wish(opening(Assistance.ASSISTED, 0.4))
    run(rig, 0.05)
    assert rig.wish(Enable(number=4))
    run(rig, 1.5)
    assert (rig.state.help.mode, rig.state.help.level) == (Assistance.ASSISTED, 0.4)
    assert max(rig.state.help.share) <= 0.4 + 1e-9


def test_what_one_patient_needed_says_nothing_of_the_next() -> None:
    rig = assisted(0.0, 8.0)
    assert max(rig.state.help.needed) < 0.5
    rig.arm.push_nm = (0.0,) * 4
    rig.wish(CloseSession(number=3))
    run(rig, 1.0)
    assert rig.wish(opening(Assistance.ASSISTED, 0.9))
    assert rig.state.help.needed == (0.9,) * 4


def test_sr6_an_assisted_arm_that_was_kept_back_is_led_from_where_it_is() -> None:
    rig = engaged(Assistance.ASSISTED, 0.3)
    rig.arm.push_nm = (0.0, 0.0, 0.0, -4.0)
    run(rig, 3.0)
    away = rig.arm.angle_rad[ELBOW] - HERE[ELBOW]
    assert away < -0.1
    assert rig.wish(chosen(Assistance.PASSIVE))
    run(rig, 0.01)
    assert rig.command.angle_rad[ELBOW] - HERE[ELBOW] == pytest.approx(away, abs=0.02)
