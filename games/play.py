"""One exercise: rounds and rests round any game's rules, with score, adapted level, pause, posture and fatigue."""

from __future__ import annotations

from dataclasses import dataclass, replace
from math import isfinite
from typing import Final

import numpy as np

from games.difficulty import adapted
from games.fatigue import COMPARED, Movement, is_tired, movement_of
from games.game import LONGEST_STEP_S, GameInput, GameSettings, GameView, Phase, Point, Trial, Wish, Workspace
from games.posture import EASED, UPRIGHT, Posture
from games.rules import Ended, PlayInput, RulesFactory
from games.trial_meter import Attempt, trial_of
from games.workspace import hand_at, middle_pose

BEGINS_AFTER_S: Final = 10.0
"""A game that nobody starts begins by itself: not every hand finds the spot."""
GRACE_S: Final = 6.0
"""An attempt under way at a round's end may be finished within this."""
LARGEST_BONUS: Final = 5
STREAK_EVERY: Final = 5


@dataclass(frozen=True, slots=True)
class State:
    """Everything that changes, but for the rules."""

    hand: Point
    level: float
    pinned: bool
    time_left_s: float = BEGINS_AFTER_S
    phase: Phase = Phase.WAITING
    goes_on: Phase = Phase.WAITING
    """What a pause interrupted."""
    round_left_s: float = 0.0
    """What an early rest left of its round."""
    round: int = 1
    score: int = 0
    streak: int = 0
    hits: int = 0
    misses: int = 0
    attempt: Attempt | None = None
    posture: Posture = UPRIGHT
    rest_suggested: bool = False
    feedback: tuple[str, ...] = ()


class Play:
    """An exercise in progress.

    While `GameInput.active` is False nothing changes but the hand, and what a person wishes. A missed attempt costs
    nothing but the streak.

    Args:
        name: the game's.
        make_rules: its rules.
        workspace: where the hand can go.
        seed: makes the attempts; the same seed, settings and inputs give the same game.
        settings: rounds, times, level.
    """

    def __init__(
        self, name: str, make_rules: RulesFactory, workspace: Workspace, seed: int, settings: GameSettings
    ) -> None:
        self._name, self._settings = name, settings
        self._rules = make_rules(workspace, np.random.default_rng(seed))
        self._trials: list[Trial] = []
        self._movements: list[Movement] = []
        level = min(max(settings.start_level, 0.0), 1.0)
        self._state = State(hand_at(workspace, middle_pose(workspace)), level, settings.pinned)

    @property
    def trials(self) -> tuple[Trial, ...]:
        """Every attempt that has ended, in order."""
        return tuple(self._trials)

    def step(self, given: GameInput) -> GameView:
        """Advance by `given.dt_s` and say what is to be drawn."""
        hand = given.hand if all(isfinite(part) for part in given.hand) else self._state.hand
        state = self._wished(replace(self._state, hand=hand, feedback=()), given)
        dt_s = min(max(given.dt_s, 0.0), LONGEST_STEP_S)
        if given.active and state.phase not in (Phase.OVER, Phase.PAUSED):
            posture = state.posture.after(given.trunk_lean_m, given.shoulder_hitch_m, dt_s)
            state = self._timed(self._played(replace(state, posture=posture), given, dt_s), dt_s)
        self._state = state
        return self.view()

    def view(self) -> GameView:
        """The picture as it stands."""
        state, scene = self._state, self._rules.scene()
        playing = state.phase is Phase.PLAYING
        return GameView(
            game=self._name,
            phase=state.phase,
            score=state.score,
            streak=state.streak,
            round=state.round,
            rounds=self._settings.rounds,
            things=scene.things if playing else (),
            way=scene.way if playing else (),
            aim=scene.aim if playing else None,
            hand=state.hand,
            time_left_s=max(state.time_left_s, 0.0),
            hits=state.hits,
            misses=state.misses,
            level=state.level,
            pinned=state.pinned,
            posture=state.posture.said,
            rest_suggested=state.rest_suggested,
            total_score=state.score,
            feedback=state.feedback,
        )

    def _wished(self, state: State, given: GameInput) -> State:
        """What a person wants, done where the phase allows it."""
        match given.wish, state.phase:
            case ((Wish.START | Wish.GO_ON), (Phase.WAITING | Phase.PAUSED | Phase.REST)):
                return self._gone_on(state)
            case Wish.PAUSE, (Phase.WAITING | Phase.PLAYING | Phase.REST):
                return replace(state, phase=Phase.PAUSED, goes_on=state.phase, feedback=("paused",))
            case Wish.REST, Phase.PLAYING:
                # Where the round's time is over and an attempt is being finished, the round is over with it.
                return self._resting(state, state.time_left_s) if state.time_left_s > 0.0 else self._round_over(state)
            case Wish.QUIT, phase if phase is not Phase.OVER:
                return self._over(state)
            case _:
                return _levelled(state, given)

    def _gone_on(self, state: State) -> State:
        """Out of waiting, a pause or a rest."""
        if state.phase is Phase.PAUSED:
            return replace(state, phase=state.goes_on)
        return self._begun(state) if state.phase is Phase.WAITING else self._after_rest(state, 0.0)

    def _played(self, state: State, given: GameInput, dt_s: float) -> State:
        """One step of play."""
        if state.phase is not Phase.PLAYING:
            return state
        ended = self._rules.step(PlayInput(dt_s, state.hand, given.healthy_hand, _asked(state)))
        state = replace(state, attempt=self._attempt(state, dt_s, is_over=bool(ended)))
        for one in ended:
            state = self._counted(state, one)
        return state

    def _attempt(self, state: State, dt_s: float, *, is_over: bool) -> Attempt | None:
        """The attempt under way one step later; the rules may have begun another one."""
        number, before = self._rules.scene().trial, state.attempt
        if before is not None and (is_over or before.number == number):
            return before.after(state.hand, dt_s)
        return _set_out(state, number) if number else None

    def _counted(self, state: State, ended: Ended) -> State:
        self._keep(state, ended)
        level = state.level if state.pinned else adapted(state.level, ended.success)
        told = replace(state, level=level, attempt=None, feedback=(*state.feedback, *ended.feedback))
        counted = _succeeded(told, ended.points) if ended.success else _missed(told)
        return replace(counted, rest_suggested=counted.rest_suggested or is_tired(self._movements))

    def _keep(self, state: State, ended: Ended) -> None:
        attempt = state.attempt or _set_out(state, 0)
        self._trials.append(trial_of(attempt, ended, len(self._trials) + 1, self._name))
        movement = movement_of(attempt)
        if movement is not None:
            self._movements.append(movement)

    def _timed(self, state: State, dt_s: float) -> State:
        """Count down, and change over at the end."""
        left_s = state.time_left_s - dt_s
        if left_s > 0.0 or (state.phase is Phase.PLAYING and state.attempt is not None and left_s > -GRACE_S):
            return replace(state, time_left_s=left_s)
        if state.phase is Phase.WAITING:
            return self._begun(state)
        if state.phase is Phase.REST:
            return self._after_rest(state, left_s)
        return self._round_over(state)

    def _round_over(self, state: State) -> State:
        return self._resting(state, 0.0) if state.round < self._settings.rounds else self._over(state)

    def _begun(self, state: State) -> State:
        return replace(
            state, phase=Phase.PLAYING, time_left_s=self._settings.round_s, feedback=(*state.feedback, "round")
        )

    def _resting(self, state: State, round_left_s: float) -> State:
        self._rules.clear()
        del self._movements[COMPARED:]
        return replace(
            state,
            phase=Phase.REST,
            attempt=None,
            time_left_s=self._settings.rest_s,
            round_left_s=round_left_s,
            rest_suggested=False,
            feedback=(*state.feedback, "rest"),
        )

    def _after_rest(self, state: State, left_s: float) -> State:
        """On with the round that was left, or with the next one."""
        fresh = replace(state, phase=Phase.PLAYING, feedback=(*state.feedback, "round"))
        if state.round_left_s > 0.0:
            return replace(fresh, time_left_s=state.round_left_s, round_left_s=0.0)
        return replace(fresh, round=state.round + 1, time_left_s=left_s + self._settings.round_s)

    def _over(self, state: State) -> State:
        self._rules.clear()
        return replace(state, phase=Phase.OVER, attempt=None, time_left_s=0.0, feedback=(*state.feedback, "over"))


def _asked(state: State) -> float:
    """The level of attempts that begin now."""
    return max(state.level - EASED, 0.0) if state.posture.said else state.level


def _set_out(state: State, number: int) -> Attempt:
    return Attempt(number, state.hand, state.hand, _asked(state))


def _levelled(state: State, given: GameInput) -> State:
    """The state with its level pinned, or set free to follow success."""
    if given.wish is Wish.PIN and isfinite(given.level):
        return replace(state, level=min(max(given.level, 0.0), 1.0), pinned=True)
    return replace(state, pinned=False) if given.wish is Wish.ADAPT else state


def _succeeded(state: State, points: int) -> State:
    streak = state.streak + 1
    said = ("hit", "streak") if streak % STREAK_EVERY == 0 else ("hit",)
    return replace(
        state,
        hits=state.hits + 1,
        streak=streak,
        score=state.score + points + min(streak - 1, LARGEST_BONUS),
        feedback=(*state.feedback, *said),
    )


def _missed(state: State) -> State:
    return replace(state, misses=state.misses + 1, streak=0, feedback=(*state.feedback, "missed"))
