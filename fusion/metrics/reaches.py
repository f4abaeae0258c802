"""The healthy hand's path cut into movements, and what each movement was like."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from typing import Final

import numpy as np

from fusion.messages import Floats
from fusion.metrics.metric import SENSOR_NOISE, Metric
from fusion.metrics.record import SessionRecord
from fusion.metrics.smoothness import sparc
from fusion.metrics.stretches import RATE_HZ, Stretch, low_passed, stretches

MOVING_M_S: Final = 0.10
"""A movement exceeds this at least once ..."""
RESTING_M_S: Final = 0.05
"""... and lasts for as long as the speed stays above this (hysteresis, so that noise cuts no movement in two)."""
SHORTEST_S: Final = 0.3
SHORTEST_M: Final = 0.08
"""Path of the shortest movement that counts: the sensors' noise makes shorter ones."""


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


def movements(stretch: Stretch) -> list[Movement]:
    """The movements in a stretch of hand positions (N, 3), low-passed first.

    Onset and end by a speed threshold, as usual in reaching studies (Schwarz et al., Stroke 50:718, 2019, review);
    two thresholds instead of one.
    """
    smooth = low_passed(stretch)
    speed = np.linalg.norm(np.gradient(smooth.values, 1.0 / RATE_HZ, axis=0), axis=1)
    found = (_movement(smooth, speed, first, last) for first, last in _above(speed))
    return [one for one in found if one is not None]


def reach_metrics(record: SessionRecord) -> list[Metric]:
    """Number of movements, and medians over them: time, peak and mean speed, path ratio, SPARC."""
    pieces = stretches(record.t_s, record.engaged & record.healthy_valid, record.hand_in_trunk)
    made = [one for piece in pieces for one in movements(piece)]
    if not made:
        return []
    side = record.healthy_side

    def median(name: str, unit: str, of: Callable[[Movement], float], caveat: str | None = None) -> Metric:
        return Metric(name, float(np.median([of(one) for one in made])), unit, side=side, caveat_key=caveat)

    return [
        Metric("movements", float(len(made)), "1", side=side),
        median("movement_time", "s", lambda one: one.duration_s),
        median("peak_speed", "m/s", lambda one: one.peak_speed_m_s, SENSOR_NOISE),
        median("mean_speed", "m/s", lambda one: one.mean_speed_m_s),
        median("path_ratio", "1", lambda one: one.path_ratio),
        median("sparc", "1", lambda one: one.sparc, SENSOR_NOISE),
    ]


def _above(speed: Floats) -> list[tuple[int, int]]:
    """First and last index of every run above the lower threshold that also passes the higher one and has both ends."""
    moving = np.concatenate([[False], speed > RESTING_M_S, [False]])
    edges = np.flatnonzero(np.diff(moving.astype(int)))
    runs = zip(edges[::2], edges[1::2] - 1, strict=True)
    whole = [(int(a), int(b)) for a, b in runs if a > 0 and b < len(speed) - 1]
    return [(a, b) for a, b in whole if speed[a : b + 1].max() > MOVING_M_S]


def _movement(smooth: Stretch, speed: Floats, first: int, last: int) -> Movement | None:
    path = smooth.values[first : last + 1]
    duration_s = (last - first) / RATE_HZ
    path_m = float(np.linalg.norm(np.diff(path, axis=0), axis=1).sum())
    straight_m = float(np.linalg.norm(path[-1] - path[0]))
    if duration_s < SHORTEST_S or path_m < SHORTEST_M or straight_m <= 0.0:
        return None
    return Movement(
        start_s=float(smooth.t_s[first]),
        duration_s=duration_s,
        peak_speed_m_s=float(speed[first : last + 1].max()),
        mean_speed_m_s=path_m / duration_s,
        path_ratio=path_m / straight_m,
        sparc=sparc(speed[first : last + 1], RATE_HZ),
    )
