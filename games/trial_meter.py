"""What the hand did during one attempt, the same for every game."""

from __future__ import annotations

from dataclasses import dataclass, replace
from typing import Final

from games.game import Point, Trial
from games.rules import Ended
from games.workspace import distance_m

SETS_OUT_M: Final = 0.03
"""The hand has set out once it is this far from where it was: less is tremor and the sensors' noise."""
LEAST_WAY_M: Final = 0.05
"""A shorter way has no meaningful ratio of path to straight line."""


@dataclass(frozen=True, slots=True)
class Attempt:
    """An attempt under way."""

    number: int
    start: Point
    hand: Point
    level: float
    """At which it began: what is pinned or eased meanwhile is for the next one."""
    age_s: float = 0.0
    path_m: float = 0.0
    set_out_s: float | None = None

    def after(self, hand: Point, dt_s: float) -> Attempt:
        """The attempt `dt_s` later with the hand at `hand`."""
        age_s = self.age_s + dt_s
        leaves = self.set_out_s is None and distance_m(hand, self.start) > SETS_OUT_M
        return replace(
            self,
            hand=hand,
            age_s=age_s,
            path_m=self.path_m + distance_m(hand, self.hand),
            set_out_s=age_s if leaves else self.set_out_s,
        )

    @property
    def way_m(self) -> float:
        """Straight from where the hand was at the beginning to where it is now."""
        return distance_m(self.start, self.hand)

    @property
    def movement_s(self) -> float | None:
        """Since the hand set out."""
        return None if self.set_out_s is None else self.age_s - self.set_out_s


def trial_of(attempt: Attempt, ended: Ended, number: int, game: str) -> Trial:
    """What is kept of an attempt that ended."""
    far_enough = attempt.way_m >= LEAST_WAY_M
    return Trial(
        number=number,
        game=game,
        success=ended.success,
        level=attempt.level,
        duration_s=attempt.age_s,
        reaction_s=attempt.set_out_s,
        movement_s=attempt.movement_s,
        path_ratio=attempt.path_m / attempt.way_m if far_enough else None,
        error_m=ended.error_m,
        hold_m=ended.hold_m,
    )
