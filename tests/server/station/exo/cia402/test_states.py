"""The station's and the emulated drive's state machines fit together, and a fault takes a person."""

from __future__ import annotations

import pytest
from hypothesis import given
from hypothesis import strategies as st

from server.emulated.cia402 import machine
from server.station.exo.cia402.states import RESET_FAULT, State, Wanted, controlword, state_of

BEGINNINGS = [State.DISABLED, State.READY, State.SWITCHED_ON, State.ENABLED, State.QUICK_STOP]
words = st.integers(0, 0xFFFF)


def _led(state: State, wanted: Wanted, times: int = 6) -> State:
    before = 0
    for _ in range(times):
        word = controlword(state_of(machine.statusword(state)), wanted)
        state, before = machine.after(state, word, before), word
    return state


@pytest.mark.parametrize("state", State)
def test_a_statusword_names_its_state(state: State) -> None:
    assert state_of(machine.statusword(state)) is state


@pytest.mark.parametrize("state", BEGINNINGS)
def test_every_state_without_a_fault_leads_to_operation(state: State) -> None:
    assert _led(state, Wanted.ENABLED) is State.ENABLED


@pytest.mark.parametrize("wanted", [Wanted.ENABLED, Wanted.STANDING])
def test_sr5_a_fault_is_not_left_unless_a_person_asks(wanted: Wanted) -> None:
    assert _led(State.FAULT, wanted, 50) is State.FAULT


def test_sr5_a_persons_reset_leads_out_of_a_fault() -> None:
    assert _led(State.FAULT, Wanted.RESET) is State.ENABLED


def test_sr7_a_stopped_drive_stays_powered() -> None:
    assert _led(State.ENABLED, Wanted.STANDING, 50) is State.QUICK_STOP
    assert State.QUICK_STOP in machine.POWERED


@given(st.lists(words.map(lambda word: word & ~RESET_FAULT)))
def test_sr5_no_controlwords_without_the_reset_bit_leave_a_fault(sent: list[int]) -> None:
    state = State.FAULT
    for before, word in zip([0, *sent], sent, strict=False):
        state = machine.after(state, word, before)
    assert state is State.FAULT


@given(words)
def test_a_statusword_of_any_bits_is_one_state(statusword: int) -> None:
    assert state_of(statusword) in State
