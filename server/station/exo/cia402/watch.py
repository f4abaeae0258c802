"""What is wrong with a drive, in plain words that name its joint (SR-3, SR-8)."""

from __future__ import annotations

from dataclasses import dataclass

from server.station.exo.cia402 import objects
from server.station.exo.cia402.bus import OPERATIONAL
from server.station.exo.cia402.faults import words
from server.station.exo.cia402.link import Link
from server.station.exo.cia402.states import State

_FAULTY = (State.FAULT, State.FAULT_REACTION)


@dataclass(frozen=True, slots=True)
class Patience:
    """How long a drive may be silent."""

    heartbeat_s: float
    """A heartbeat older than this is a drive that is gone."""
    syncs: int
    """So many SYNCs without its measurement are a drive that does not measure. Counted, not timed: a station that was
    held up has sent none."""


def trouble(link: Link, patience: Patience, now_s: float) -> str:
    """Why this drive cannot be relied on, "" = it can."""
    if link.state in _FAULTY or link.emergency:
        return f"The drive of '{link.joint.name}' reports: {words(link.error)}."
    if now_s - link.heard_s > patience.heartbeat_s:
        return f"The drive of '{link.joint.name}' (node {link.joint.node}) is silent: no heartbeat."
    if link.unanswered > patience.syncs:
        return f"The drive of '{link.joint.name}' (node {link.joint.node}) no longer says where it stands."
    if link.network_state != OPERATIONAL:
        return f"The drive of '{link.joint.name}' has restarted or left the cycle by itself."
    return ""


def not_enabled(link: Link) -> str:
    """Why a drive that should be powered and following is not."""
    if link.details.mode != objects.CYCLIC_POSITION:
        return f"The drive of '{link.joint.name}' left the cyclic position mode by itself."
    told = f": {words(link.error)}" if link.error else ""
    return f"The drive of '{link.joint.name}' is not in operation ({link.state}){told}."
