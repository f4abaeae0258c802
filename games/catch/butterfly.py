"""A butterfly: where it flies, how long, and what catching it asks."""

from __future__ import annotations

from dataclasses import dataclass, replace
from typing import Final

import numpy as np

from games.even_steps import STEP_S, on_the_way
from games.game import Point
from games.levels import between, evenly_between
from games.workspace import distance_m

Corners = tuple[Point, Point, Point, Point]
"""Of a cubic Bézier curve."""

EASY_FLIGHT_S, HARD_FLIGHT_S = 6.0, 2.4
EASY_NOTICE_S, HARD_NOTICE_S = 6.0, 0.7
EASY_LINGER_S, HARD_LINGER_S = 2.0, 0.1
EASY_RADIUS_M, HARD_RADIUS_M = 0.1, 0.05

FROM_AHEAD_M: Final = (1.1, 1.7)
FROM_ASIDE_M: Final = (0.35, 0.85)
SINKS_M: Final = 0.2
"""The last of its way leads straight down, so that it never flies at the patient."""
SETTLING: Final = 1.6
"""Over 1: it slows as it comes down."""


@dataclass(frozen=True, slots=True)
class Demands:
    """What one butterfly asks."""

    flight_s: float
    """From its appearing to its arrival."""
    notice_s: float
    """The place is announced this long before the arrival."""
    linger_s: float
    """It hangs in its place this long and can still be caught."""
    radius_m: float
    """So near to the place catches it."""


def demands(level: float) -> Demands:
    """What a butterfly asks at a level in 0..1: quicker, smaller, with less notice and less patience."""
    return Demands(
        flight_s=evenly_between(EASY_FLIGHT_S, HARD_FLIGHT_S, level),
        notice_s=evenly_between(EASY_NOTICE_S, HARD_NOTICE_S, level),
        linger_s=evenly_between(EASY_LINGER_S, HARD_LINGER_S, level),
        radius_m=between(EASY_RADIUS_M, HARD_RADIUS_M, level),
    )


@dataclass(frozen=True, slots=True)
class Butterfly:
    """A butterfly on its way."""

    number: int
    corners: Corners
    """Of its way; the last is its place."""
    demands: Demands
    steps: int = 0
    """Even steps since it appeared."""
    off_at_arrival_m: float | None = None
    """How far the hand was from the place when it arrived; None until then."""

    @property
    def place(self) -> Point:
        """Where it comes down."""
        return self.corners[-1]

    @property
    def age_s(self) -> float:
        """Since it appeared."""
        return self.steps * STEP_S

    @property
    def has_arrived(self) -> bool:
        """Whether it hangs in its place."""
        return self.age_s >= self.demands.flight_s

    @property
    def is_announced(self) -> bool:
        """Whether its place is shown."""
        return self.age_s >= self.demands.flight_s - self.demands.notice_s

    @property
    def is_over(self) -> bool:
        """Whether it has waited long enough."""
        return self.age_s >= self.demands.flight_s + self.demands.linger_s

    def later(self, hand: Point) -> Butterfly:
        """One even step later, with the hand at `hand`."""
        older = replace(self, steps=self.steps + 1)
        if self.off_at_arrival_m is None and older.has_arrived:
            return replace(older, off_at_arrival_m=distance_m(hand, self.place))
        return older

    def position(self) -> Point:
        """Where it is now."""
        share = min(self.age_s / self.demands.flight_s, 1.0)
        return _on_curve(self.corners, 1.0 - (1.0 - share) ** SETTLING)


def way_to(place: Point, high_m: float, rng: np.random.Generator) -> Corners:
    """A curve from the far distance, on one side, that ends straight down in its place.

    Args:
        place: where it comes down.
        high_m: it sets out this high, where the eyes see it at its distance, or higher where the place is high.
        rng: draws side and distance.
    """
    aside_m = float(rng.choice((-1.0, 1.0))) * float(rng.uniform(*FROM_ASIDE_M))
    x, y, z = place
    start = (x + aside_m, max(high_m, y + SINKS_M), z - float(rng.uniform(*FROM_AHEAD_M)))
    drifting = on_the_way(start, (x + 0.5 * aside_m, start[1], z), 0.6)
    return start, drifting, (x, y + SINKS_M, z), place


def _on_curve(corners: Corners, share: float) -> Point:
    """The point of a cubic Bézier curve: straight ways between straight ways (de Casteljau)."""
    a, b, c, d = corners
    ab, bc, cd = on_the_way(a, b, share), on_the_way(b, c, share), on_the_way(c, d, share)
    return on_the_way(on_the_way(ab, bc, share), on_the_way(bc, cd, share), share)
