"""The gate's states: every transition, and every other pair refused (SR-5)."""

from __future__ import annotations

import itertools
from dataclasses import replace

import pytest

from fusion.skeleton import Side
from server.config import GateConfig
from server.messages import (
    Assistance,
    CloseSession,
    DriveState,
    Enable,
    FollowBody,
    Hold,
    OpenSession,
    Pain,
    Reset,
    Resume,
    SetAssistance,
    Stop,
    Wish,
)
from server.station.exo import gate
from server.station.exo.gate import TRANSITIONS, Facts, GateState

CONFIG = GateConfig()
WISHES: tuple[Wish, ...] = (
    OpenSession(
        number=1,
        session="1",
        patient="P",
        healthy_side=Side.LEFT,
        side_confirmed=True,
        limits=(),
        limits_set_by="t",
        recording="",
    ),
    CloseSession(number=2),
    Enable(number=3),
    Hold(number=4, reason="a pause"),
    Resume(number=5),
    Stop(number=6, reason="pain"),
    Reset(number=7),
    FollowBody(number=8, sensor="s", body="b"),
    Pain(number=9, reason="my shoulder"),
    SetAssistance(number=10, mode=Assistance.FREE, level=0.5),
)
PAIRS = list(itertools.product(DriveState, WISHES))
OPEN = {state: state is not DriveState.OFF for state in DriveState}


def _at(state: DriveState, session_open: bool = True) -> GateState:
    return GateState(state=state, reason="as given", since_s=0.0, session_open=session_open)


@pytest.mark.parametrize(("state", "wish"), [p for p in PAIRS if (p[0], type(p[1])) in TRANSITIONS])
def test_sr5_every_listed_wish_leads_where_the_table_says(state: DriveState, wish: Wish) -> None:
    after, refusal = gate.wish(_at(state, OPEN[state]), wish, Facts(), 1.0)
    assert refusal == ""
    assert after.state is TRANSITIONS[state, type(wish)]


@pytest.mark.parametrize(("state", "wish"), [p for p in PAIRS if (p[0], type(p[1])) not in TRANSITIONS])
def test_sr5_every_other_wish_is_refused_and_changes_nothing(state: DriveState, wish: Wish) -> None:
    before = _at(state)
    after, refusal = gate.wish(before, wish, Facts(), 1.0)
    assert after is before
    assert state.value in refusal


@pytest.mark.parametrize("state", [DriveState.STOPPED, DriveState.FAULT])
def test_sr5_reset_never_enables_and_without_a_session_leads_to_off(state: DriveState) -> None:
    assert gate.wish(_at(state), Reset(number=1), Facts(), 1.0)[0].state is DriveState.READY
    assert gate.wish(_at(state, session_open=False), Reset(number=1), Facts(), 1.0)[0].state is DriveState.OFF


def test_sr5_reset_is_refused_while_the_fault_lasts() -> None:
    after, refusal = gate.wish(_at(DriveState.FAULT), Reset(number=1), Facts(fault="The motor is hot."), 1.0)
    assert (after.state, refusal) == (DriveState.FAULT, "The motor is hot.")


def test_sr5_a_session_that_closes_while_stopped_leaves_the_stop_latched() -> None:
    closed, _ = gate.wish(_at(DriveState.STOPPED), CloseSession(number=1), Facts(), 1.0)
    assert closed.state is DriveState.STOPPED
    assert gate.wish(closed, Reset(number=2), Facts(), 2.0)[0].state is DriveState.OFF


@pytest.mark.parametrize("wish", [Enable(number=1), Resume(number=1)])
@pytest.mark.parametrize(
    "facts",
    [
        Facts(blockers=("No.",)),
        Facts(lost="No."),
        Facts(far=("No.",)),
        Facts(silence="No."),
        Facts(fault="No."),
        Facts(give_way="No."),
    ],
)
def test_sr10_neither_enable_nor_resume_is_granted_while_anything_is_missing(wish: Wish, facts: Facts) -> None:
    state = DriveState.READY if isinstance(wish, Enable) else DriveState.HOLD
    after, refusal = gate.wish(_at(state), wish, facts, 1.0)
    assert (after.state, refusal) == (state, "No.")


@pytest.mark.parametrize("state", [DriveState.READY, DriveState.ENGAGED, DriveState.HOLD])
def test_sr5_a_fault_latches_from_every_live_state(state: DriveState) -> None:
    after = gate.watch(_at(state), Facts(fault="The motor is hot."), CONFIG, 1.0)
    assert after.state is DriveState.FAULT
    assert gate.watch(after, Facts(near=True), CONFIG, 100.0).state is DriveState.FAULT


@pytest.mark.parametrize("state", [s for s in DriveState if s is not DriveState.ENGAGED])
def test_sr5_nothing_enables_itself(state: DriveState) -> None:
    before = _at(state)
    for t in range(100):
        assert gate.watch(before, Facts(near=True), CONFIG, t / 10).state is state


def _lost_at(t_s: float) -> GateState:
    return gate.watch(_at(DriveState.ENGAGED), Facts(lost="No sensor."), CONFIG, t_s)


def test_sr4_lost_sensors_hold() -> None:
    assert _lost_at(1.0).state is DriveState.HOLD
    assert _lost_at(1.0).reason == "No sensor."


def test_sr5_a_short_loss_near_the_arm_resumes_by_itself() -> None:
    assert gate.watch(_lost_at(1.0), Facts(near=True), CONFIG, 2.9).state is DriveState.ENGAGED


@pytest.mark.parametrize(
    "facts", [Facts(near=False), Facts(near=True, blockers=("Limits.",)), Facts(near=True, lost="Still.")]
)
def test_sr5_a_short_loss_far_from_the_arm_or_with_a_blocker_stays(facts: Facts) -> None:
    assert gate.watch(_lost_at(1.0), facts, CONFIG, 2.0).state is DriveState.HOLD


def test_sr5_a_loss_longer_than_two_seconds_needs_a_person() -> None:
    held = gate.watch(_lost_at(1.0), Facts(near=True), CONFIG, 3.1)
    assert held.state is DriveState.HOLD
    assert "A person resumes" in held.reason
    assert gate.watch(held, Facts(near=True), CONFIG, 3.2).state is DriveState.HOLD
    assert gate.wish(held, Resume(number=1), Facts(near=True), 4.0)[0].state is DriveState.ENGAGED


def test_sr5_a_persons_hold_during_a_loss_is_not_resumed_by_itself() -> None:
    held, _ = gate.wish(_lost_at(1.0), Hold(number=1, reason="a pause"), Facts(), 1.5)
    assert gate.watch(held, Facts(near=True), CONFIG, 1.6).state is DriveState.HOLD


def test_sr9_a_silent_service_holds_until_a_person_resumes() -> None:
    held = gate.watch(_at(DriveState.ENGAGED), Facts(silence="The service is silent."), CONFIG, 1.0)
    assert held.state is DriveState.HOLD
    assert gate.watch(held, Facts(near=True), CONFIG, 1.1).state is DriveState.HOLD


def test_sr9_silence_during_a_loss_takes_the_right_to_resume_by_itself() -> None:
    held = gate.watch(_lost_at(1.0), Facts(silence="The service is silent."), CONFIG, 1.1)
    assert gate.watch(held, Facts(near=True), CONFIG, 1.2).state is DriveState.HOLD


def _soft_at(t_s: float, state: DriveState = DriveState.ENGAGED) -> GateState:
    return gate.wish(_at(state), Pain(number=1, reason="my shoulder"), Facts(), t_s)[0]


@pytest.mark.parametrize("state", [DriveState.ENGAGED, DriveState.HOLD])
def test_sr18_pain_holds_softly_and_only_a_person_resumes(state: DriveState) -> None:
    held = _soft_at(1.0, state)
    assert (held.state, held.reason, held.compliant) == (DriveState.HOLD, "my shoulder", True)
    for t in range(100):
        assert gate.watch(held, Facts(near=True), CONFIG, 1.0 + t / 10) == held
    resumed, refusal = gate.wish(held, Resume(number=2), Facts(near=True), 2.0)
    assert (resumed.state, resumed.compliant, refusal) == (DriveState.ENGAGED, False, "")


def test_sr18_a_stopped_arm_that_hurts_or_resists_is_held_softly_and_stays_stopped() -> None:
    stopped = _at(DriveState.STOPPED)
    hurts, refusal = gate.wish(stopped, Pain(number=1, reason="my shoulder"), Facts(), 1.0)
    assert (hurts.state, hurts.reason, hurts.compliant, refusal) == (DriveState.STOPPED, stopped.reason, True, "")
    resists = gate.watch(stopped, Facts(give_way="The elbow resists."), CONFIG, 1.0)
    assert resists == replace(stopped, compliant=True)


@pytest.mark.parametrize("state", [DriveState.OFF, DriveState.READY, DriveState.FAULT])
def test_sr18_pain_where_nothing_moves_is_refused_in_words(state: DriveState) -> None:
    assert "A hold for pain is not possible" in gate.wish(_at(state), Pain(number=1, reason=""), Facts(), 1.0)[1]


@pytest.mark.parametrize("state", [DriveState.ENGAGED, DriveState.HOLD])
def test_sr18_resistance_holds_softly_and_only_a_person_resumes(state: DriveState) -> None:
    held = gate.watch(_at(state), Facts(give_way="The elbow resists."), CONFIG, 1.0)
    assert (held.state, held.reason, held.compliant) == (DriveState.HOLD, "The elbow resists.", True)
    assert gate.watch(held, Facts(near=True), CONFIG, 1.5) == held


def test_sr18_resistance_during_a_short_loss_takes_the_right_to_resume_by_itself() -> None:
    held = gate.watch(_lost_at(1.0), Facts(lost="No sensor.", give_way="The elbow resists."), CONFIG, 1.1)
    assert held.compliant
    assert gate.watch(held, Facts(near=True), CONFIG, 1.2).state is DriveState.HOLD


@pytest.mark.parametrize("state", [DriveState.OFF, DriveState.READY, DriveState.FAULT])
def test_sr18_an_arm_that_is_not_moved_may_be_pushed(state: DriveState) -> None:
    assert gate.watch(_at(state), Facts(give_way="The elbow resists."), CONFIG, 1.0) == _at(state)


def test_sr18_a_soft_hold_stays_soft_through_stop_and_fault_and_ends_with_the_reset() -> None:
    stopped, _ = gate.wish(_soft_at(1.0), Stop(number=2, reason=""), Facts(), 2.0)
    faulty = gate.watch(_soft_at(1.0), Facts(fault="The motor is hot."), CONFIG, 2.0)
    for latched, state in ((stopped, DriveState.STOPPED), (faulty, DriveState.FAULT)):
        assert (latched.state, latched.compliant) == (state, True)
        assert not gate.wish(latched, Reset(number=3), Facts(), 3.0)[0].compliant


def test_sr11_nobody_in_charge_holds_until_a_person_resumes() -> None:
    held = gate.watch(_at(DriveState.ENGAGED), Facts(silence="Nobody is in charge."), CONFIG, 1.0)
    assert (held.state, held.reason, held.compliant) == (DriveState.HOLD, "Nobody is in charge.", False)
    assert gate.watch(held, Facts(near=True), CONFIG, 1.1).state is DriveState.HOLD


def test_an_arm_that_is_left_free_minds_neither_a_lost_nor_a_far_target() -> None:
    facts = Facts(lost="No sensor.", far=("Too far.",), leads=False)
    assert gate.watch(_at(DriveState.ENGAGED), facts, CONFIG, 1.0).state is DriveState.ENGAGED
    assert gate.wish(_at(DriveState.READY), Enable(number=1), facts, 1.0)[0].state is DriveState.ENGAGED


def test_sr5_choosing_another_assistance_keeps_the_state_but_no_loss_ends_by_itself_in_it() -> None:
    chosen = SetAssistance(number=1, mode=Assistance.FREE, level=1.0)
    for state in (DriveState.READY, DriveState.ENGAGED, DriveState.HOLD):
        assert gate.wish(_at(state), chosen, Facts(), 1.0)[0] == _at(state)
    after, _ = gate.wish(_lost_at(1.0), chosen, Facts(), 1.2)
    assert gate.watch(after, Facts(near=True), CONFIG, 1.3).state is DriveState.HOLD
