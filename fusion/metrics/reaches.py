"""The healthy hand's path cut into movements, and what each movement was like."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from itertools import pairwise
from typing import Final

import numpy as np
from scipy.signal import find_peaks

from fusion.messages import Floats
from fusion.metrics.metric import ONE_SENSOR, SENSOR_NOISE, SLOW, UNRELIABLE, Metric
from fusion.metrics.record import SessionRecord
from fusion.metrics.smoothness import sparc
from fusion.metrics.stretches import RATE_HZ, Stretch, low_passed, stretches
from fusion.metrics.uncertainty import bootstrap_sem, mean_sem

FASTEST_M_S: Final = 0.15
"""A movement's peak speed reaches this."""
RISE: Final = 0.5
"""A peak stands out by this share of its height from the valleys beside it; lesser ones belong to the same movement."""
ENDS: Final = 0.15
"""A movement lasts while the speed is above this share of its peak, and above the resting speed."""
RESTING_M_S: Final = 0.05
SHORTEST_S: Final = 0.3
SHORTEST_M: Final = 0.08
"""A movement carries the hand at least this far from where it was: noise jitters, but goes nowhere."""
SLOW_M_S: Final = 0.6
"""Where the typical measured peak is lower, the sensors' noise makes several movements of one (docs/metrics.md)."""
PEAK_RISE_M_S: Final = 0.02
PEAKS_APART_S: Final = 0.15
"""What counts as a velocity peak within a movement, as the movement units of Alt Murphy et al., 2011."""


@dataclass(frozen=True, slots=True)
class Movement:
    """One movement of the hand, from rest to rest."""

    start_s: float
    duration_s: float
    peak_speed_m_s: float
    mean_speed_m_s: float
    path_ratio: float
    """Path over the straight line from start to end; 1 is straight."""
    sparc: float
    velocity_peaks: int
    """1 = one smooth bell."""


def movements(stretch: Stretch) -> list[Movement]:
    """The movements in a stretch of hand positions (N, 3), low-passed first.

    A movement is a bell in the speed: a peak that stands out, from where the speed rises above a share of the peak to
    where it falls below it, as usual in reaching studies (Schwarz et al., Stroke 50:718, 2019, review).
    """
    smooth = low_passed(stretch)
    speed = np.linalg.norm(np.gradient(smooth.values, 1.0 / RATE_HZ, axis=0), axis=1)
    found = (_movement(smooth, speed, first, last) for first, last in _bells(speed))
    return [one for one in found if one is not None]


def session_movements(record: SessionRecord) -> list[Movement]:
    """The healthy hand's movements while the arm was driven."""
    pieces = stretches(record.t_s, record.engaged & record.healthy_valid, record.hand_in_trunk)
    return [one for piece in pieces for one in movements(piece)]


def reach_metrics(record: SessionRecord) -> list[Metric]:
    """Number of movements, medians over them (time, speeds, path ratio, SPARC), and their mean number of peaks."""
    made = session_movements(record)
    if not made:
        return []
    side = record.healthy_side
    peaks = np.array([float(one.velocity_peaks) for one in made])
    common = _common_caveat(record, made)

    def median(name: str, unit: str, of: Callable[[Movement], float], caveat: str | None = None) -> Metric:
        values = np.array([of(one) for one in made])
        return Metric(name, float(np.median(values)), unit, None, side, caveat or common, bootstrap_sem(values))

    return [
        Metric("movements", float(len(made)), "1", side=side, caveat_key=common),
        median("movement_time", "s", lambda one: one.duration_s),
        median("peak_speed", "m/s", lambda one: one.peak_speed_m_s, UNRELIABLE),
        median("mean_speed", "m/s", lambda one: one.mean_speed_m_s),
        median("path_ratio", "1", lambda one: one.path_ratio),
        median("sparc", "1", lambda one: one.sparc, common or SENSOR_NOISE),
        Metric("velocity_peaks", float(peaks.mean()), "1", None, side, UNRELIABLE, mean_sem(peaks)),
    ]


def _common_caveat(record: SessionRecord, made: list[Movement]) -> str | None:
    """What must be said beside all of them: the worst first."""
    if np.median([one.peak_speed_m_s for one in made]) < SLOW_M_S:
        return SLOW
    return ONE_SENSOR if record.sees_with_one else None


def _bells(speed: Floats) -> list[tuple[int, int]]:
    """First and last index of every bell in a speed profile; those cut off by the profile's ends are left out."""
    peaks, found = find_peaks(speed, height=FASTEST_M_S, prominence=0.0)
    peaks = peaks[found["prominences"] >= RISE * found["peak_heights"]]
    if not len(peaks):
        return []
    valleys = [int(a + np.argmin(speed[a:b])) for a, b in pairwise(peaks)]
    spans = zip([0, *valleys], peaks, [*valleys, len(speed) - 1], strict=True)
    bells = [_ends(speed, int(peak), low, high) for low, peak, high in spans]
    return [(first, last) for first, last in bells if first > 0 and last < len(speed) - 1]


def _ends(speed: Floats, peak: int, low: int, high: int) -> tuple[int, int]:
    """Where the bell around `peak` begins and ends, no further than the valleys `low` and `high`."""
    slow = speed < max(RESTING_M_S, ENDS * float(speed[peak]))
    before, after = np.flatnonzero(slow[low:peak]), np.flatnonzero(slow[peak : high + 1])
    first = low + int(before[-1]) if len(before) else low
    return first, peak + int(after[0]) if len(after) else high


def _movement(smooth: Stretch, speed: Floats, first: int, last: int) -> Movement | None:
    path = smooth.values[first : last + 1]
    duration_s = (last - first) / RATE_HZ
    path_m = float(np.linalg.norm(np.diff(path, axis=0), axis=1).sum())
    straight_m = float(np.linalg.norm(path[-1] - path[0]))
    if duration_s < SHORTEST_S or straight_m < SHORTEST_M:
        return None
    return Movement(
        start_s=float(smooth.t_s[first]),
        duration_s=duration_s,
        peak_speed_m_s=float(speed[first : last + 1].max()),
        mean_speed_m_s=path_m / duration_s,
        path_ratio=path_m / straight_m,
        sparc=sparc(speed[first : last + 1], RATE_HZ),
        velocity_peaks=_velocity_peaks(speed[first : last + 1]),
    )


def _velocity_peaks(speed: Floats) -> int:
    """Of one movement's speed; its largest value always counts."""
    found, _ = find_peaks(speed, prominence=PEAK_RISE_M_S, distance=round(PEAKS_APART_S * RATE_HZ))
    return max(1, len(found))
