"""What is wrong with a drive, in plain words that name its joint (SR-3, SR-8)."""

from __future__ import annotations

from server.station.exo.cia402 import objects
from server.station.exo.cia402.bus import OPERATIONAL
from server.station.exo.cia402.faults import words
from server.station.exo.cia402.link import Link
from server.station.exo.cia402.states import State

_FAULTY = (State.FAULT, State.FAULT_REACTION)


def trouble(link: Link, silent_after_s: float, unanswered: int, now_s: float) -> str:
    """Why this drive cannot be relied on, "" = it can.

    Args:
        link: the drive.
        silent_after_s: a heartbeat older than this is a drive that is gone.
        unanswered: so many SYNCs without its measurement are a drive that does not measure.
        now_s: monotonic time.
    """
    if link.state in _FAULTY or link.emergency:
        return f"The drive of '{link.joint.name}' reports: {words(link.error)}."
    if now_s - link.heard_s > silent_after_s:
        return f"The drive of '{link.joint.name}' (node {link.joint.node}) is silent: no heartbeat."
    if link.unanswered > unanswered:
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
