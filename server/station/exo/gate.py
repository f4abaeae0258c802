"""The safety gate's states, and who may change them (SR-5): people go up, anything may go down.

    off ──open──▶ ready ──enable──▶ engaged ◀──resume── hold
                    ▲                  └──hold, pain, resistance, lost sensors, silence──▶┘
                    └──reset── stopped, fault (latched)

A hold for pain or resistance is soft, and stays so through a stop or a fault (SR-18). A stopped arm that hurts or
resists becomes soft as well and stays stopped: people stop because it hurts.
Stopped and fault outlive their session: the next one opens in them and takes a reset and a start.
The one exception is written in SR-5: a hold for lost sensors that ends soon, near the arm, resumes by itself.
"""

from __future__ import annotations

from dataclasses import dataclass, replace
from typing import Final

from server.config import GateConfig
from server.messages import (
    CloseSession,
    DriveState,
    Enable,
    Hold,
    OpenSession,
    Pain,
    Reset,
    Resume,
    SetAssistance,
    Stop,
    Wish,
)

OFF, READY, ENGAGED = DriveState.OFF, DriveState.READY, DriveState.ENGAGED
HOLD, FAULT, STOPPED = DriveState.HOLD, DriveState.FAULT, DriveState.STOPPED

TRANSITIONS: Final[dict[tuple[DriveState, type[Wish]], DriveState]] = {
    (OFF, OpenSession): READY,
    (READY, CloseSession): OFF,
    (ENGAGED, CloseSession): OFF,
    (HOLD, CloseSession): OFF,
    (STOPPED, OpenSession): STOPPED,
    (STOPPED, CloseSession): STOPPED,
    (FAULT, OpenSession): FAULT,
    (FAULT, CloseSession): FAULT,
    (READY, Enable): ENGAGED,
    (ENGAGED, Hold): HOLD,
    (HOLD, Hold): HOLD,
    (HOLD, Resume): ENGAGED,
    (ENGAGED, Pain): HOLD,
    (HOLD, Pain): HOLD,
    (STOPPED, Pain): STOPPED,
    **{(state, SetAssistance): state for state in (READY, ENGAGED, HOLD)},
    (STOPPED, Reset): READY,
    (FAULT, Reset): READY,
    **{(state, Stop): STOPPED for state in DriveState},
}
"""Every wish that a state can grant, and the state it leads to; every other pair is refused."""

_NAMES: Final[dict[type[Wish], str]] = {
    OpenSession: "Opening a session",
    CloseSession: "Closing the session",
    Enable: "Enable",
    Hold: "Hold",
    Resume: "Resume",
    Stop: "Stop",
    Reset: "Reset",
    Pain: "A hold for pain",
    SetAssistance: "Another assistance",
}


@dataclass(frozen=True, slots=True)
class GateState:
    """Where the gate stands."""

    state: DriveState = OFF
    reason: str = "no session is open"
    since_s: float = 0.0
    session_open: bool = False
    lost: bool = False
    """In hold for lost sensors, and for nothing else: may resume by itself (SR-5)."""
    compliant: bool = False
    """The arm resisted or hurts: it is held softly (SR-18)."""


@dataclass(frozen=True, slots=True)
class Facts:
    """What the gate judges by in one tick."""

    blockers: tuple[str, ...] = ()
    """What forbids motion (SR-6, SR-10), in plain words; empty = it may begin."""
    fault: str = ""
    """What is wrong with drive or arm."""
    silence: str = ""
    """Why a person must look before it goes on: nobody is in charge, the service is silent, the loop stood still."""
    give_way: str = ""
    """Why the drive must give way at once: the arm resists (SR-18)."""
    lost: str = ""
    """Why the healthy arm cannot be followed now (SR-4)."""
    far: tuple[str, ...] = ()
    """Where the target is further than agreed (SR-6)."""
    leads: bool = True
    """The drive would lead the arm to the target; one that leaves the arm free minds neither `lost` nor `far`."""
    can_comply: bool = False
    """The drive can yield."""
    near: bool = False
    """The target is within `GateConfig.resume_within_rad`."""

    @property
    def obstacles(self) -> tuple[str, ...]:
        """Everything that keeps motion from beginning now."""
        unled = self.unled if self.leads else ()
        return tuple(filter(None, (self.fault, *self.blockers, self.silence, self.give_way, *unled)))

    @property
    def unled(self) -> tuple[str, ...]:
        """Why the arm could not be led to the target now."""
        return tuple(filter(None, (self.lost, *self.far)))


def wish(gate: GateState, wanted: Wish, facts: Facts, now_s: float) -> tuple[GateState, str]:
    """What becomes of a person's wish.

    Returns:
        The gate afterwards, and why the wish was refused ("" = granted).
    """
    after = TRANSITIONS.get((gate.state, type(wanted)))
    if after is None:
        return gate, f"{_NAMES.get(type(wanted), 'That')} is not possible while the exoskeleton is '{gate.state}'."
    refusal = _refusal(wanted, facts)
    if refusal:
        return gate, refusal
    if isinstance(wanted, SetAssistance):  # another way of moving, no other state; but no loss ends by itself in it
        return replace(gate, lost=False), ""
    session_open = gate.session_open
    if isinstance(wanted, OpenSession | CloseSession):
        session_open = isinstance(wanted, OpenSession)
    if after is READY and not session_open:
        after = OFF
    reason = gate.reason if after is gate.state and after in (STOPPED, FAULT) else _reason(after, wanted)
    compliant = isinstance(wanted, Pain) or (gate.compliant and after in (HOLD, STOPPED, FAULT))
    return GateState(after, reason, now_s, session_open, compliant=compliant), ""


def watch(gate: GateState, facts: Facts, config: GateConfig, now_s: float) -> GateState:
    """What the tick's facts make of the gate: down at any time, up only out of a short loss (SR-5)."""
    if facts.fault and gate.state in (READY, ENGAGED, HOLD):
        return replace(gate, state=FAULT, reason=facts.fault, since_s=now_s, lost=False)
    if facts.give_way and gate.state in (ENGAGED, HOLD) and not gate.compliant:
        return replace(gate, state=HOLD, reason=facts.give_way, since_s=now_s, lost=False, compliant=True)
    if facts.give_way and gate.state is STOPPED:
        return replace(gate, compliant=True)
    if gate.state is ENGAGED:
        return _watch_engaged(gate, facts, now_s)
    if gate.state is HOLD and gate.lost:
        return _watch_lost(gate, facts, config, now_s)
    return gate


def _watch_engaged(gate: GateState, facts: Facts, now_s: float) -> GateState:
    reason = facts.silence or (facts.lost if facts.leads else "")
    if not reason:
        return gate
    return replace(gate, state=HOLD, reason=reason, since_s=now_s, lost=not facts.silence)


def _watch_lost(gate: GateState, facts: Facts, config: GateConfig, now_s: float) -> GateState:
    if facts.silence:
        return replace(gate, reason=facts.silence, lost=False)
    if now_s - gate.since_s > config.resume_within_s:
        return replace(gate, reason=f"{gate.reason} A person resumes.", lost=False)
    if facts.obstacles or not facts.near:
        return gate
    return replace(gate, state=ENGAGED, reason="", since_s=now_s, lost=False)


def _refusal(wanted: Wish, facts: Facts) -> str:
    if isinstance(wanted, Enable | Resume):
        return " ".join(facts.obstacles)
    if isinstance(wanted, Reset):
        return facts.fault
    return ""


def _reason(after: DriveState, wanted: Wish) -> str:
    if isinstance(wanted, Stop | Hold):
        return wanted.reason or f"{after} by a person"
    if isinstance(wanted, Pain):
        return wanted.reason or "It hurts."
    return {OFF: "no session is open", READY: "waiting to be enabled"}.get(after, "")
