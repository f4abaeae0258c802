"""Puts one fault into a scene and says what became of the arm, by the drive's own log."""

from __future__ import annotations

import asyncio
import time
from dataclasses import dataclass
from typing import Final

from server.experiments.rig.drive_log import Note, commands, still_after_s, told_after_s
from server.experiments.rig.fault import Fault, Where
from server.messages import DriveState, JointLimits

SPEED_TOLERANCE: Final = 1.5
"""As the safety gate judges measured speed."""


@dataclass(frozen=True, slots=True)
class Observed:
    """What one fault did."""

    fault: str
    state: DriveState | None
    """The station's at the end; None = it is gone."""
    reason: str
    decided_s: float | None
    """From the fault to the station's first change of state."""
    told_s: float | None
    """From the fault to the first command that comes to rest."""
    still_s: float | None
    """From the fault to the arm's last movement; None = it moved to the end."""
    commands: int
    """How many came while it was watched."""
    outside_rad: float
    """How far the arm was ever measured outside its limits."""
    speed: float
    """Largest measured speed, as a share of what is allowed."""


async def observed(where: Where, fault: Fault[Where]) -> Observed:
    """Put the fault in while the arm moves, watch, and take it out again."""
    await where.mirroring()
    since_s, limits = time.monotonic(), where.limits
    async with fault.put_in(where):
        await asyncio.sleep(fault.watched_s)
        state, reason = where.heard()
        notes = where.drive.log.since(since_s)
    if fault.heard_after_s:
        await asyncio.sleep(fault.heard_after_s)
        state, reason = where.heard()
    return Observed(
        fault.name,
        state,
        reason,
        where.decided_after_s(since_s),
        told_after_s(notes, since_s),
        still_after_s(notes, since_s),
        len(commands(notes)),
        max((_outside_rad(note, limits) for note in notes), default=0.0),
        max((_speed(note, limits) for note in notes), default=0.0),
    )


def trouble(found: Observed, fault: Fault[Where]) -> str:
    """What was not as it must be; "" = safe and in time."""
    checks = (
        (found.outside_rad > 0.0, f"{found.outside_rad:.3f} rad outside the limits"),
        (found.speed > SPEED_TOLERANCE, f"{found.speed:.2f} times the allowed speed"),
        (not _is_among(found.state, fault.safe), f"the state is {found.state}: {found.reason}"),
        (not fault.goes_on and not any(words in found.reason for words in fault.words), f"it says '{found.reason}'"),
        (_is_late(found.decided_s, fault.decided_within_s), f"decided after {found.decided_s}"),
        (_is_late(found.still_s, fault.still_within_s), f"still after {found.still_s}"),
    )
    return "; ".join(words for is_so, words in checks if is_so)


def _is_among(state: DriveState | None, safe: frozenset[DriveState]) -> bool:
    return state in safe if safe else state is None


def _is_late(found_s: float | None, within_s: float | None) -> bool:
    return within_s is not None and (found_s is None or found_s > within_s)


def _outside_rad(note: Note, limits: tuple[JointLimits, ...]) -> float:
    pairs = zip(note.angle_rad, limits, strict=True)
    return max(max(joint.min_rad - angle, angle - joint.max_rad, 0.0) for angle, joint in pairs)


def _speed(note: Note, limits: tuple[JointLimits, ...]) -> float:
    pairs = zip(note.velocity_rad_s, limits, strict=True)
    return max(abs(velocity) / joint.velocity_rad_s for velocity, joint in pairs)
