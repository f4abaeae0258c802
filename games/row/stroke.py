"""One stroke of the paddles under way: how far it has come, in what time, and how alike the two hands went."""

from __future__ import annotations

from dataclasses import dataclass, replace
from typing import Final

import numpy as np

from games.even_steps import STEP_S, Moment
from games.game import Point
from games.levels import between, evenly_between
from games.workspace import distance_m

EASY_LENGTH, HARD_LENGTH = 0.6, 1.0
EASY_TIME_S, HARD_TIME_S = 14.0, 1.1
EASY_RADIUS_M, HARD_RADIUS_M = 0.08, 0.04
EASY_APART_M, HARD_APART_M = 0.3, 0.06
RADIUS_SHARE: Final = 0.3
"""Of the way between the two ends a zone takes at most this share,"""
LEAST_RADIUS_M: Final = 0.03
"""but never less than this, where there is hardly any room to row."""
SEEN_ENOUGH: Final = 0.5
"""Share of a stroke that the healthy hand must be seen, for likeness to be judged."""


@dataclass(frozen=True, slots=True)
class Demands:
    """What one stroke asks."""

    length: float
    """Share of the longest course there is room for."""
    time_s: float
    radius_m: float
    """So near to an end is there."""
    apart_m: float
    """Mean distance that the shown hand may have from the healthy one's mirror image."""


def demands(level: float) -> Demands:
    """What a stroke asks at a level in 0..1: longer, quicker, more exact and more alike."""
    return Demands(
        length=between(EASY_LENGTH, HARD_LENGTH, level),
        time_s=evenly_between(EASY_TIME_S, HARD_TIME_S, level),
        radius_m=between(EASY_RADIUS_M, HARD_RADIUS_M, level),
        apart_m=between(EASY_APART_M, HARD_APART_M, level),
    )


@dataclass(frozen=True, slots=True)
class Stroke:
    """A stroke under way, of the shown hand."""

    number: int
    catch: Point
    """Where it begins, ahead."""
    finish: Point
    demands: Demands
    steps: int = 0
    """Even steps so far."""
    seen_steps: int = 0
    """Those at which the healthy hand was seen."""
    apart_sum_m: float = 0.0
    """Sum over those of the distance between the two hands' places."""
    has_caught: bool = False
    """The hand has been at the catch and now pulls."""
    pulled: float = 0.0
    """Largest share of the way from catch to finish so far."""

    @property
    def aim(self) -> Point:
        """The end to go to."""
        return self.finish if self.has_caught else self.catch

    @property
    def radius_m(self) -> float:
        """So near to an end is there."""
        return max(min(self.demands.radius_m, RADIUS_SHARE * self.length_m), LEAST_RADIUS_M)

    @property
    def length_m(self) -> float:
        """From end to end."""
        return distance_m(self.catch, self.finish)

    @property
    def time_share(self) -> float:
        """Share of its time that has passed, 0..1."""
        return min(self.steps * STEP_S / self.demands.time_s, 1.0)

    @property
    def apart_m(self) -> float | None:
        """Mean distance of the two hands' courses; None where the healthy hand was not seen enough."""
        enough = self.seen_steps > 0 and self.seen_steps >= SEEN_ENOUGH * self.steps
        return self.apart_sum_m / self.seen_steps if enough else None

    @property
    def is_alike(self) -> bool:
        """Whether the hands went alike enough, as far as anybody knows."""
        return self.apart_m is None or self.apart_m <= self.demands.apart_m

    def later(self, moment: Moment) -> Stroke:
        """One even step later."""
        has_caught = self.has_caught or distance_m(moment.hand, self.catch) <= self.radius_m
        off_m = apart_m(moment)
        return replace(
            self,
            steps=self.steps + 1,
            seen_steps=self.seen_steps + (off_m is not None),
            apart_sum_m=self.apart_sum_m + (off_m or 0.0),
            has_caught=has_caught,
            pulled=max(self.pulled, self._share(moment.hand)) if has_caught else 0.0,
        )

    def is_at_finish(self, hand: Point) -> bool:
        """Whether the stroke is whole."""
        return self.has_caught and distance_m(hand, self.finish) <= self.radius_m

    def _share(self, hand: Point) -> float:
        """How much of the way from catch to finish the hand has come, 0..1."""
        way = np.subtract(self.finish, self.catch)
        length_m2 = float(way @ way)
        return min(max(float(np.subtract(hand, self.catch) @ way) / length_m2, 0.0), 1.0) if length_m2 > 0.0 else 1.0


def apart_m(moment: Moment) -> float | None:
    """Distance between the shown hand and the mirror image of the healthy one; None = not seen."""
    if moment.healthy_hand is None:
        return None
    x, y, z = moment.healthy_hand
    return distance_m(moment.hand, (-x, y, z))
