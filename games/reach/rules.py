"""Reaching and collecting: bring the hand to a fruit and stay there until it is collected.

One thing of kind "fruit"; its progress is the dwell.
"""

from __future__ import annotations

from dataclasses import dataclass, replace
from typing import Final

import numpy as np

from games.dwell import spread_m
from games.game import Point, ThingView, Workspace
from games.levels import between
from games.rules import Ended, PlayInput, SceneView
from games.workspace import distance_m, next_reach

EASY_RADIUS_M, HARD_RADIUS_M = 0.09, 0.05
EASY_DWELL_S, HARD_DWELL_S = 0.4, 0.8
EASY_TIME_S, HARD_TIME_S = 14.0, 1.6
LEAVING: Final = 0.5
"""Outside the target the dwell is lost at half the speed at which it was won."""
POINTS: Final = 10
RECENT: Final = 4


@dataclass(frozen=True, slots=True)
class Target:
    """The target that waits, and what it asks."""

    id: int
    position: Point
    radius_m: float
    dwell_s: float
    """How long the hand stays inside."""
    time_s: float
    """How long the target waits."""
    progress: float = 0.0
    age_s: float = 0.0
    held: tuple[Point, ...] = ()
    """Where the hand was while inside."""


class ReachRules:
    """Targets one after the other, each drawn to suit the level."""

    def __init__(self, workspace: Workspace, rng: np.random.Generator) -> None:
        self._workspace, self._rng = workspace, rng
        self._target: Target | None = None
        self._next_id = 1
        self._recent: tuple[Point, ...] = ()

    def step(self, given: PlayInput) -> tuple[Ended, ...]:
        """One step of play on the target, which is drawn where none waits."""
        target = _held(self._target or self._new_target(given), given)
        self._target = target
        if target.progress >= 1.0:
            return self._ended(target, success=True)
        if target.age_s >= target.time_s:
            return self._ended(target, success=False)
        return ()

    def scene(self) -> SceneView:
        """The target."""
        target = self._target
        if target is None:
            return SceneView(0, (), None)
        return SceneView(target.id, (_drawn(target),), target.position)

    def clear(self) -> None:
        """Let the target go."""
        if self._target is not None:
            self._recent = (*self._recent, self._target.position)[-RECENT:]
            self._target = None

    def _new_target(self, given: PlayInput) -> Target:
        reach = next_reach(self._workspace, given.level, given.hand, self._recent, self._rng)
        number, self._next_id = self._next_id, self._next_id + 1
        return Target(
            id=number,
            position=reach.position,
            radius_m=between(EASY_RADIUS_M, HARD_RADIUS_M, given.level),
            dwell_s=between(EASY_DWELL_S, HARD_DWELL_S, given.level),
            time_s=between(EASY_TIME_S, HARD_TIME_S, given.level),
        )

    def _ended(self, target: Target, *, success: bool) -> tuple[Ended, ...]:
        self.clear()
        if not success:
            return (Ended(success=False, points=0),)
        error_m = float(np.mean([distance_m(place, target.position) for place in target.held]))
        return (Ended(success=True, points=POINTS, error_m=error_m, hold_m=spread_m(target.held)),)


def _held(target: Target, given: PlayInput) -> Target:
    """The target one step older, its dwell grown or shrunk."""
    inside = distance_m(given.hand, target.position) <= target.radius_m
    change = given.dt_s / target.dwell_s * (1.0 if inside else -LEAVING)
    progress = min(max(target.progress + change, 0.0), 1.0)
    held = (*target.held, given.hand) if inside else target.held
    return replace(target, progress=progress, age_s=target.age_s + given.dt_s, held=held if progress > 0.0 else ())


def _drawn(target: Target) -> ThingView:
    return ThingView(target.id, "fruit", target.position, target.radius_m, target.progress)
