"""What a course comes to: how far off, how late, how abrupt."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from time import process_time
from typing import Final

import numpy as np

from fusion.messages import Flags, Floats
from server.experiments.cranked.following import Course, hand_m
from server.experiments.cranked.station import DT_S
from server.messages import DriveState
from server.station.exo.driver import ZERO, Drive, DriveCommand, DriveMode

Span = tuple[float, float]
ENGAGED: Final = DriveState.ENGAGED
LONGEST_DELAY_S: Final = 0.4
DELAY_STEP_S: Final = 0.001


@dataclass(frozen=True, slots=True)
class Late:
    """How one signal follows another, per angle (4,)."""

    delay_s: Floats
    """The shift with the least difference."""
    rms_rad: Floats
    """At no shift."""
    rms_shifted_rad: Floats
    """At that shift."""


def within(t_s: Floats, spans: Sequence[Span]) -> Flags:
    """Which instants (T,) lie in any of the spans."""
    inside: Flags = np.zeros(len(t_s), dtype=bool)
    for start, end in spans:
        inside |= (t_s > start) & (t_s <= end)
    return inside


def engaged_share(course: Course, rows: Flags) -> float:
    """Share of the instants `rows` in which the exoskeleton follows."""
    engaged = np.array([state is ENGAGED for state in course.state])
    return float(engaged[rows].mean()) if rows.any() else float("nan")


def hand_off_m(course: Course, angle_rad: Floats) -> Floats:
    """(T,) m from where the hand belongs to where these angles (T, 4) would bring it; NaN where either is unknown."""
    places = np.array([hand_m(angles) if np.isfinite(angles).all() else (np.nan,) * 3 for angles in angle_rad])
    off: Floats = np.linalg.norm(places - course.truth_m, axis=1)
    return off


def arm_off_m(course: Course) -> Floats:
    """(T,) m from where the hand belongs to where the hand of the arm in the exoskeleton is."""
    off: Floats = np.linalg.norm(course.arm_m - course.truth_m, axis=1)
    return off


def rms(values: Floats) -> float:
    """Root mean square of what is known; NaN where nothing is."""
    known = values[np.isfinite(values)]
    return float(np.sqrt(np.mean(known**2))) if len(known) else float("nan")


def steps_m(course: Course) -> Floats:
    """(T,) m that the hand of the arm in the exoskeleton moves in each tick."""
    moved: Floats = np.linalg.norm(np.diff(course.arm_m, axis=0, prepend=course.arm_m[:1]), axis=1)
    return moved


def apart_m(one: Course, other: Course) -> Floats:
    """(T,) m between the hands of two courses of equal length."""
    apart: Floats = np.linalg.norm(one.arm_m - other.arm_m, axis=1)
    return apart


def grown_m(t_s: Floats, apart: Floats, since_s: float, for_s: float) -> float:
    """By how much a distance (T,) grows at most from an instant on, for so long."""
    rows = within(t_s, [(since_s, since_s + for_s)])
    return float((apart[rows] - apart[rows][0]).max()) if rows.any() else 0.0


def held_after_s(course: Course, span: Span) -> float:
    """Time from the beginning of a span to the first tick in it that does not follow; infinite where all do."""
    rows = within(course.t_s, [span])
    held = [t_s for t_s, state, row in zip(course.t_s, course.state, rows, strict=True) if row and state is not ENGAGED]
    return float(held[0]) - span[0] if held else float("inf")


def fastest_rad_s(angle_rad: Floats) -> float:
    """Speed that the quickest angle of (T, 4) exceeds in a twentieth of the time.

    The plane counts by the sine of the elevation, as the hand feels it.
    """
    speed = np.abs(np.angle(np.exp(1j * np.diff(angle_rad, axis=0)))) / DT_S
    speed[:, 0] *= np.sin(np.clip(angle_rad[1:, 1], 0.0, np.pi / 2))
    return float(np.nanpercentile(speed, 95, axis=0).max())


def drive_work_s(drive: Drive, ticks: int) -> float:
    """What a tick of a drive costs this machine, in seconds of processing: the median of so many."""
    took = []
    at = drive.read(0.0).angle_rad
    for tick in range(ticks):
        now_s, began_s = tick * DT_S, process_time()
        drive.read(now_s)
        drive.command(DriveCommand(DriveMode.HOLD, at, ZERO, ""), now_s)
        took.append(process_time() - began_s)
    return float(np.median(took))


def late(follower_rad: Floats, leader_rad: Floats, rows: Flags, longest_s: float = LONGEST_DELAY_S) -> Late:
    """How the follower (T, 4) comes behind the leader (T, 4) in the instants `rows`, angle by angle."""
    found = [_late(follower_rad[:, i], leader_rad[:, i], rows, longest_s) for i in range(follower_rad.shape[1])]
    delay, plain, shifted = (np.array(part) for part in zip(*found, strict=True))
    return Late(delay, plain, shifted)


def _late(follower: Floats, leader: Floats, rows: Flags, longest_s: float) -> tuple[float, float, float]:
    """The leader is carried to each shift by interpolation; the least rms wins."""
    ticks = np.arange(len(leader), dtype=float)
    known = np.isfinite(leader)
    shifts = np.arange(0.0, longest_s, DELAY_STEP_S)
    off = [rms((follower - np.interp(ticks - shift / DT_S, ticks[known], leader[known]))[rows]) for shift in shifts]
    best = int(np.argmin(off))
    return float(shifts[best]), off[0], off[best]
