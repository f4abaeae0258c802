"""A CiA 402 drive's state machine: what a controlword does, and the statusword that tells of it (CiA 402-2)."""

from __future__ import annotations

from typing import Final

from server.station.exo.cia402.states import State

_STATUS: Final = {
    State.NOT_READY: 0x00,
    State.DISABLED: 0x40,
    State.READY: 0x21,
    State.SWITCHED_ON: 0x23,
    State.ENABLED: 0x27,
    State.QUICK_STOP: 0x07,
    State.FAULT_REACTION: 0x0F,
    State.FAULT: 0x08,
}
_VOLTAGE, _REMOTE = 1 << 4, 1 << 9
POWERED: Final = (State.ENABLED, State.QUICK_STOP, State.FAULT_REACTION)

_DISABLE: Final = dict.fromkeys((State.READY, State.SWITCHED_ON, State.ENABLED, State.QUICK_STOP), State.DISABLED)
_QUICK_STOP: Final = {
    State.READY: State.DISABLED,
    State.SWITCHED_ON: State.DISABLED,
    State.ENABLED: State.QUICK_STOP,
}
_SHUT_DOWN: Final = dict.fromkeys((State.DISABLED, State.SWITCHED_ON, State.ENABLED), State.READY)
_SWITCH_ON: Final = dict.fromkeys((State.READY, State.ENABLED), State.SWITCHED_ON)
_ENABLE: Final = dict.fromkeys((State.SWITCHED_ON, State.QUICK_STOP), State.ENABLED)


def after(state: State, control: int, before: int) -> State:
    """The state after a controlword; `before` is the last one, for the reset works by its rising edge."""
    if state is State.FAULT:
        return State.DISABLED if control & 0x80 and not before & 0x80 else state
    return _moves(control).get(state, state)


def _moves(control: int) -> dict[State, State]:
    if not control & 0x02:
        return _DISABLE
    if not control & 0x04:
        return _QUICK_STOP
    return {0: _SHUT_DOWN, 1: _SWITCH_ON}.get(control & 0x01, {}) if not control & 0x08 else _enabling(control)


def _enabling(control: int) -> dict[State, State]:
    return _ENABLE if control & 0x01 else _SHUT_DOWN


def statusword(state: State) -> int:
    """The bits that name the state, with voltage and remote."""
    return _STATUS[state] | _VOLTAGE | _REMOTE
