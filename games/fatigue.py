"""Whether a rest is due: movements have become slower, jerkier or smaller than they were at the beginning."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from statistics import median
from typing import Final

from games.trial_meter import LEAST_WAY_M, Attempt

COMPARED: Final = 6
"""So many movements at the beginning against so many now; a median of six forgives two odd ones."""
SLOWER: Final = 0.75
JERKIER: Final = 1.3
SMALLER: Final = 0.75
SIGNS_NEEDED: Final = 2
"""One sign alone may be the game's doing: near targets make small movements, far ones slow ones."""


@dataclass(frozen=True, slots=True)
class Movement:
    """What an attempt says of the arm's freshness."""

    speed_m_s: float
    path_ratio: float
    extent_m: float


def movement_of(attempt: Attempt) -> Movement | None:
    """The attempt's movement; None where there was hardly any."""
    time_s = attempt.movement_s
    if not time_s or attempt.way_m < LEAST_WAY_M:
        return None
    return Movement(attempt.way_m / time_s, attempt.path_m / attempt.way_m, attempt.way_m)


def is_tired(movements: Sequence[Movement]) -> bool:
    """Whether the newest movements show at least two signs of fatigue against the first ones.

    The signs are those that change with fatigue after stroke: speed, smoothness and range of the movement; the shares
    are chosen, not measured.
    """
    if len(movements) < 2 * COMPARED:
        return False
    first, newest = movements[:COMPARED], movements[-COMPARED:]

    def change(of: Callable[[Movement], float]) -> float:
        return median(of(one) for one in newest) / median(of(one) for one in first)

    signs = (
        change(lambda one: one.speed_m_s) < SLOWER,
        change(lambda one: one.path_ratio) > JERKIER,
        change(lambda one: one.extent_m) < SMALLER,
    )
    return sum(signs) >= SIGNS_NEEDED
