"""Reaching and collecting: bring the hand to a target and stay there until it is collected."""

from __future__ import annotations

from dataclasses import dataclass, replace
from math import isfinite
from typing import Final

import numpy as np

from games.difficulty import Demands, adapted, demands
from games.game import GameInput, GameSettings, GameView, Point, TargetView, Workspace
from games.workspace import distance_m, hand_at, middle_pose, next_reach

NAME: Final = "reach"
LONGEST_STEP_S: Final = 0.1
"""A longer step counts as this much: a stalled machine is not the patient's miss."""
LEAVING: Final = 0.5
"""Outside the target the dwell is lost at half the speed at which it was won."""
POINTS_PER_HIT, LARGEST_BONUS = 10, 5
STREAK_EVERY: Final = 5
RECENT: Final = 4


@dataclass(frozen=True, slots=True)
class Target:
    """The target that waits."""

    id: int
    position: Point
    demands: Demands
    progress: float = 0.0
    age_s: float = 0.0


@dataclass(frozen=True, slots=True)
class State:
    """Everything that changes, but for the random generator."""

    hand: Point
    time_left_s: float
    level: float
    phase: str = "waiting"
    round: int = 1
    score: int = 0
    streak: int = 0
    hits: int = 0
    misses: int = 0
    target: Target | None = None
    next_id: int = 1
    recent: tuple[Point, ...] = ()
    feedback: tuple[str, ...] = ()


class ReachGame:
    """The game in progress.

    Rounds of play alternate with rests; while `GameInput.active` is False nothing changes but the hand. A target that
    waited too long is taken away without any loss but the streak.

    Args:
        workspace: where the hand can go.
        seed: makes the targets; the same seed, settings and inputs give the same game.
        settings: rounds, times, level.
    """

    def __init__(self, workspace: Workspace, seed: int, settings: GameSettings) -> None:
        self._workspace = workspace
        self._settings = settings
        self._rng = np.random.default_rng(seed)
        level = settings.start_level if settings.pinned_level is None else settings.pinned_level
        hand = hand_at(workspace, middle_pose(workspace))
        self._state = State(hand=hand, time_left_s=settings.round_s, level=min(max(level, 0.0), 1.0))

    def step(self, given: GameInput) -> GameView:
        """Advance by `given.dt_s` and say what is to be drawn."""
        hand = given.hand if all(isfinite(part) for part in given.hand) else self._state.hand
        self._state = replace(self._state, hand=hand, feedback=())
        dt_s = min(max(given.dt_s, 0.0), LONGEST_STEP_S)
        if given.active and self._state.phase != "over":
            self._state = self._timed(self._advanced(self._begun(self._state), dt_s), dt_s)
        return self.view()

    def view(self) -> GameView:
        """The picture as it stands."""
        state = self._state
        return GameView(
            game=NAME,
            phase=state.phase,
            score=state.score,
            streak=state.streak,
            round=state.round,
            rounds=self._settings.rounds,
            targets=() if state.target is None else (_drawn(state.target),),
            hand=state.hand,
            time_left_s=state.time_left_s,
            hits=state.hits,
            misses=state.misses,
            level=state.level,
            feedback=state.feedback,
        )

    def _begun(self, state: State) -> State:
        """The first active step starts the first round."""
        if state.phase != "waiting":
            return state
        return replace(state, phase="playing", feedback=("round",))

    def _advanced(self, state: State, dt_s: float) -> State:
        """One step of play on the target, which is drawn where none waits."""
        if state.phase != "playing":
            return state
        target = _held(state.target or self._new_target(state), state.hand, dt_s)
        if target.progress >= 1.0:
            return self._collected(_without(state, target))
        if target.age_s >= target.demands.time_s:
            return self._missed(_without(state, target))
        return replace(state, target=target)

    def _new_target(self, state: State) -> Target:
        reach = next_reach(self._workspace, state.level, state.hand, state.recent, self._rng)
        return Target(state.next_id, reach.position, demands(state.level))

    def _collected(self, state: State) -> State:
        streak = state.streak + 1
        feedback = ("hit", "streak") if streak % STREAK_EVERY == 0 else ("hit",)
        return replace(
            state,
            hits=state.hits + 1,
            streak=streak,
            score=state.score + POINTS_PER_HIT + min(streak - 1, LARGEST_BONUS),
            level=self._next_level(state.level, hit=True),
            feedback=(*state.feedback, *feedback),
        )

    def _missed(self, state: State) -> State:
        return replace(
            state,
            misses=state.misses + 1,
            streak=0,
            level=self._next_level(state.level, hit=False),
            feedback=(*state.feedback, "missed"),
        )

    def _next_level(self, level: float, *, hit: bool) -> float:
        return adapted(level, hit) if self._settings.pinned_level is None else level

    def _timed(self, state: State, dt_s: float) -> State:
        """Count the round or the rest down, and change over at its end; what is over of the step counts on."""
        left_s = state.time_left_s - dt_s
        if left_s > 0.0:
            return replace(state, time_left_s=left_s)
        feedback = state.feedback
        if state.target is not None:
            state = _without(state, state.target)
        if state.phase == "rest":
            left_s, phase, said = left_s + self._settings.round_s, "playing", "round"
            state = replace(state, round=state.round + 1)
        elif state.round < self._settings.rounds:
            left_s, phase, said = left_s + self._settings.rest_s, "rest", "rest"
        else:
            left_s, phase, said = 0.0, "over", "over"
        return replace(state, phase=phase, time_left_s=left_s, feedback=(*feedback, said))


def _held(target: Target, hand: Point, dt_s: float) -> Target:
    """The target one step older, its dwell grown or shrunk."""
    inside = distance_m(hand, target.position) <= target.demands.radius_m
    change = dt_s / target.demands.dwell_s * (1.0 if inside else -LEAVING)
    progress = min(max(target.progress + change, 0.0), 1.0)
    return replace(target, progress=progress, age_s=target.age_s + dt_s)


def _without(state: State, target: Target) -> State:
    """The state after a target has gone, which the next ones keep clear of."""
    return replace(state, target=None, next_id=target.id + 1, recent=(*state.recent, target.position)[-RECENT:])


def _drawn(target: Target) -> TargetView:
    return TargetView(target.id, target.position, target.demands.radius_m, target.progress)
