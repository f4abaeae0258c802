"""Catching: a butterfly drifts in on the breeze and sinks to a place; be there with the hand when it comes.

Things of its scene, two to a butterfly:
    "butterfly": where it is now. `progress` 0..1 of its flight. `state` "flying", or "here" while it hangs in its place.
    "place": where it comes down and how near the hand must be (`radius_m`); shown once it is announced. `progress`
        0..1 of the time from the announcement to the arrival. `state` "coming", or "here".

Feedback of its own: "in_time" where the hand was there before the butterfly.
"""

from __future__ import annotations

from dataclasses import dataclass, replace
from typing import Final

import numpy as np

from games.even_steps import STEP_S, EvenSteps, on_the_way
from games.game import Point, ThingView, Workspace
from games.levels import between, evenly_between
from games.rules import Ended, PlayInput, SceneView
from games.workspace import distance_m, next_reach

NAME: Final = "catch"

EASY_FLIGHT_S, HARD_FLIGHT_S = 6.0, 2.4
EASY_NOTICE_S, HARD_NOTICE_S = 6.0, 0.7
EASY_LINGER_S, HARD_LINGER_S = 2.0, 0.1
EASY_RADIUS_M, HARD_RADIUS_M = 0.1, 0.05

PAUSE_S: Final = 0.9
"""Between two butterflies."""
POINTS, IN_TIME_POINTS = 10, 2
RECENT: Final = 4

FROM_AHEAD_M: Final = (1.1, 1.7)
FROM_ASIDE_M: Final = (0.35, 0.85)
FROM_ABOVE_SHOULDER_M: Final = 0.36
"""A butterfly sets out this high, where the eyes see it at its distance."""
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
    corners: tuple[Point, Point, Point, Point]
    """Of its Bézier curve; the last is its place."""
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


class CatchRules:
    """The butterflies, one after the other; an attempt lasts from the announcement of a place.

    Args:
        workspace: where the hand can go.
        rng: draws places and ways.
    """

    def __init__(self, workspace: Workspace, rng: np.random.Generator) -> None:
        self._workspace, self._rng = workspace, rng
        self._steps = EvenSteps()
        self._butterfly: Butterfly | None = None
        self._count = 0
        self._recent: tuple[Point, ...] = ()
        self._pause_steps = 0

    def step(self, given: PlayInput) -> tuple[Ended, ...]:
        """Advance by `given.dt_s`; the butterflies that were caught or missed."""
        ended = [self._stepped(moment.hand, given.level) for moment in self._steps.take(given)]
        return tuple(one for one in ended if one is not None)

    def scene(self) -> SceneView:
        """What is to be drawn now."""
        butterfly = self._butterfly
        if butterfly is None:
            return SceneView(0, (), None)
        if not butterfly.is_announced:
            return SceneView(0, (_butterfly_view(butterfly),), None)
        return SceneView(butterfly.number, (_butterfly_view(butterfly), _place_view(butterfly)), butterfly.place)

    def clear(self) -> None:
        """The round is over."""
        self._butterfly, self._pause_steps = None, 0
        self._steps.forget()

    def _stepped(self, hand: Point, level: float) -> Ended | None:
        """One even step."""
        if self._butterfly is None:
            self._pause_steps -= 1
            if self._pause_steps <= 0:
                self._butterfly = self._next_butterfly(hand, level)
            return None
        self._butterfly = self._butterfly.later(hand)
        ended = _outcome(self._butterfly, hand)
        if ended is not None:
            self._butterfly, self._pause_steps = None, round(PAUSE_S / STEP_S)
        return ended

    def _next_butterfly(self, hand: Point, level: float) -> Butterfly:
        place = next_reach(self._workspace, level, hand, self._recent, self._rng).position
        self._recent = (*self._recent, place)[-RECENT:]
        self._count += 1
        return Butterfly(self._count, self._way_to(place), demands(level))

    def _way_to(self, place: Point) -> tuple[Point, Point, Point, Point]:
        """A curve from the far distance, on one side, that ends straight down in its place."""
        aside_m = float(self._rng.choice((-1.0, 1.0))) * float(self._rng.uniform(*FROM_ASIDE_M))
        x, y, z = place
        high = self._workspace.shoulder[1] + FROM_ABOVE_SHOULDER_M
        start = (x + aside_m, max(high, y + SINKS_M), z - float(self._rng.uniform(*FROM_AHEAD_M)))
        above = (x, y + SINKS_M, z)
        drifting = on_the_way(start, (x + 0.5 * aside_m, start[1], z), 0.6)
        return start, drifting, above, place


def _outcome(butterfly: Butterfly, hand: Point) -> Ended | None:
    """Caught, missed, or None while neither is certain."""
    if not butterfly.has_arrived:
        return None
    error_m, radius_m = butterfly.off_at_arrival_m, butterfly.demands.radius_m
    if distance_m(hand, butterfly.place) <= radius_m:
        in_time = error_m is not None and error_m <= radius_m
        points, said = (POINTS + IN_TIME_POINTS, ("in_time",)) if in_time else (POINTS, ())
        return Ended(True, points, error_m=error_m, feedback=said)
    return Ended(False, 0, error_m=error_m) if butterfly.is_over else None


def _on_curve(corners: tuple[Point, Point, Point, Point], share: float) -> Point:
    """The point of a cubic Bézier curve: straight ways between straight ways (de Casteljau)."""
    a, b, c, d = corners
    ab, bc, cd = on_the_way(a, b, share), on_the_way(b, c, share), on_the_way(c, d, share)
    return on_the_way(on_the_way(ab, bc, share), on_the_way(bc, cd, share), share)


def _butterfly_view(butterfly: Butterfly) -> ThingView:
    share = min(butterfly.age_s / butterfly.demands.flight_s, 1.0)
    state = "here" if butterfly.has_arrived else "flying"
    return ThingView(
        2 * butterfly.number - 1, "butterfly", butterfly.position(), butterfly.demands.radius_m, share, state
    )


def _place_view(butterfly: Butterfly) -> ThingView:
    left_s = max(butterfly.demands.flight_s - butterfly.age_s, 0.0)
    share, state = 1.0 - left_s / butterfly.demands.notice_s, "here" if butterfly.has_arrived else "coming"
    return ThingView(2 * butterfly.number, "place", butterfly.place, butterfly.demands.radius_m, share, state)
