"""The CiA 402 state machine as the station sees it: what a statusword says, and which controlword leads on.

not ready ─▶ switch on disabled ─▶ ready ─▶ switched on ─▶ operation enabled ◀─▶ quick stop active
                    ▲ a person's reset
fault reaction ─▶ fault
"""

from __future__ import annotations

from enum import StrEnum
from typing import Final


class State(StrEnum):
    """States of one drive; only the last two are powered."""

    NOT_READY = "not ready to switch on"
    DISABLED = "switch on disabled"
    READY = "ready to switch on"
    SWITCHED_ON = "switched on"
    FAULT_REACTION = "fault reaction active"
    FAULT = "fault"
    QUICK_STOP = "quick stop active"
    ENABLED = "operation enabled"


class Wanted(StrEnum):
    """What the station wants of a drive."""

    ENABLED = "powered, following its set-point"
    STANDING = "stopped by its own ramp and held"
    RESET = "out of its fault, because a person asked"


SHUT_DOWN, SWITCH_ON, ENABLE = 0x06, 0x07, 0x0F
QUICK_STOP, RESET_FAULT, NOTHING = 0x02, 0x80, 0x00
START_HOMING = 0x1F

INTERNAL_LIMIT = 1 << 11
HOMING_ATTAINED, HOMING_ERROR = 1 << 12, 1 << 13

_MASKS: Final = (
    (0x4F, 0x00, State.NOT_READY),
    (0x4F, 0x40, State.DISABLED),
    (0x6F, 0x21, State.READY),
    (0x6F, 0x23, State.SWITCHED_ON),
    (0x6F, 0x27, State.ENABLED),
    (0x6F, 0x07, State.QUICK_STOP),
    (0x4F, 0x0F, State.FAULT_REACTION),
    (0x4F, 0x08, State.FAULT),
)
_UPWARDS: Final = {
    State.DISABLED: SHUT_DOWN,
    State.READY: SWITCH_ON,
    State.SWITCHED_ON: ENABLE,
    State.ENABLED: ENABLE,
    State.QUICK_STOP: ENABLE,
}
"""A fault is not in it: nothing but a person's reset leads out of it (SR-5)."""


def state_of(statusword: int) -> State:
    """The state that a statusword names; bits that belong to no state are read as not ready."""
    return next((state for mask, bits, state in _MASKS if statusword & mask == bits), State.NOT_READY)


def controlword(state: State, wanted: Wanted) -> int:
    """The next controlword on the way from a state to what is wanted; repeated until the state has changed."""
    if wanted is Wanted.RESET and state is State.FAULT:
        return RESET_FAULT
    if wanted is Wanted.STANDING:
        return QUICK_STOP
    return _UPWARDS.get(state, NOTHING)
