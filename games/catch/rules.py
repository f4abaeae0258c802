"""Catching: a butterfly drifts in on the breeze and sinks to a place; be there with the hand when it comes.

Things of its scene, two to a butterfly:
    "butterfly": where it is now. `progress` 0..1 of its flight. `state` "flying", or "here" while it hovers in its
        place.
    "place": where it comes down and how near the hand must be (`radius_m`); shown once it is announced. `progress`
        0..1 of the time from the announcement to the arrival. `state` "coming", or "here".

Feedback of its own: "in_time" where the hand was there before the butterfly.
"""

from __future__ import annotations

from typing import Final

import numpy as np

from games.catch.butterfly import Butterfly, demands, way_to
from games.even_steps import STEP_S, EvenSteps
from games.game import Point, ThingView, Workspace
from games.rules import Ended, PlayInput, SceneView
from games.workspace import distance_m, next_reach

PAUSE_S: Final = 0.9
"""Between two butterflies."""
POINTS, IN_TIME_POINTS = 10, 2
RECENT: Final = 4
FROM_ABOVE_SHOULDER_M: Final = 0.36
"""A butterfly sets out this high, where the eyes see it at its distance."""


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
        high_m = self._workspace.shoulder[1] + FROM_ABOVE_SHOULDER_M
        return Butterfly(self._count, way_to(place, high_m, self._rng), demands(level))


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
