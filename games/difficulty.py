"""Difficulty that finds its own level: a weighted up-down staircase towards 75 % success."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Final

SUCCESS_WANTED: Final = 0.75
STEP_DOWN: Final = 0.09
STEP_UP: Final = STEP_DOWN * (1.0 - SUCCESS_WANTED) / SUCCESS_WANTED
"""Kaernbach 1991 (Perception & Psychophysics 49:227-229): up·p = down·(1-p) rests where the share of hits is p."""

EASY_RADIUS_M, HARD_RADIUS_M = 0.09, 0.05
EASY_DWELL_S, HARD_DWELL_S = 0.4, 0.8
EASY_TIME_S, HARD_TIME_S = 14.0, 7.0


@dataclass(frozen=True, slots=True)
class Demands:
    """What one target asks."""

    radius_m: float
    dwell_s: float
    """How long the hand stays inside."""
    time_s: float
    """How long the target waits."""


def demands(level: float) -> Demands:
    """What a target asks at a level in 0..1: smaller, longer to hold, less patient."""
    return Demands(
        radius_m=_between(EASY_RADIUS_M, HARD_RADIUS_M, level),
        dwell_s=_between(EASY_DWELL_S, HARD_DWELL_S, level),
        time_s=_between(EASY_TIME_S, HARD_TIME_S, level),
    )


def adapted(level: float, hit: bool) -> float:
    """The level after a target was collected or missed."""
    return min(max(level + (STEP_UP if hit else -STEP_DOWN), 0.0), 1.0)


def _between(easy: float, hard: float, level: float) -> float:
    return easy + level * (hard - easy)
