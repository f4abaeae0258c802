"""Difficulty that finds its own level: a weighted up-down staircase towards 75 % success."""

from __future__ import annotations

from typing import Final

SUCCESS_WANTED: Final = 0.75
STEP_DOWN: Final = 0.09
STEP_UP: Final = STEP_DOWN * (1.0 - SUCCESS_WANTED) / SUCCESS_WANTED
"""Kaernbach 1991 (Perception & Psychophysics 49:227-229): up·p = down·(1-p) rests where the share of hits is p."""


def adapted(level: float, success: bool) -> float:
    """The level after an attempt."""
    return min(max(level + (STEP_UP if success else -STEP_DOWN), 0.0), 1.0)
