"""A session's exercises in turn: one game after another, steered by gestures or by what a person wishes."""

from __future__ import annotations

from dataclasses import dataclass, replace
from typing import Final

from games.catalogue import open_game
from games.game import (
    LONGEST_STEP_S,
    ChoiceView,
    Game,
    GameInput,
    GameSettings,
    GameView,
    Phase,
    Point,
    Trial,
    Wish,
    Workspace,
)
from games.menu import Menu

BETWEEN_S: Final = 15.0
"""The next exercise begins by itself after this."""
SEEDS_APART: Final = 7919
"""The n-th exercise's seed is the session's plus n times this, so that no two play alike."""
SPACES_APART: Final = 1_000_000
"""Ids of things are never used twice in a session."""


@dataclass(frozen=True, slots=True)
class Exercise:
    """One game of a session."""

    game: str
    settings: GameSettings


class Programme:
    """The exercises in progress; the last one's end is the end.

    Args:
        exercises: in turn; at least one.
        workspace: where the hand can go.
        seed: makes every attempt; the same seed, exercises and inputs give the same session.

    Raises:
        InputError: there is no game of such a name.
    """

    def __init__(self, exercises: tuple[Exercise, ...], workspace: Workspace, seed: int) -> None:
        self._exercises = exercises
        self._games: tuple[Game, ...] = tuple(
            open_game(one.game, workspace, seed + number * SEEDS_APART, one.settings)
            for number, one in enumerate(exercises)
        )
        self._menu = Menu(workspace)
        self._current = 0
        self._between_s: float | None = None
        self._quit = False
        self._earned = 0
        """Points of the exercises before this one."""
        self._view = self._seen(self._games[0].view())

    @property
    def trials(self) -> tuple[Trial, ...]:
        """Every attempt that has ended, in order; numbered within its exercise."""
        return tuple(trial for game in self._games for trial in game.trials)

    @property
    def outcomes(self) -> tuple[GameView, ...]:
        """How every exercise stands."""
        return tuple(game.view() for game in self._games)

    def step(self, given: GameInput) -> GameView:
        """Advance by `given.dt_s` and say what is to be drawn."""
        wish = given.wish
        if wish is Wish.NONE and given.active:
            wish = self._menu.step(self._offered(), self._view.hand, min(max(given.dt_s, 0.0), LONGEST_STEP_S))
        self._view = self._seen(self._advanced(replace(given, wish=wish)))
        return self._view

    def view(self) -> GameView:
        """The picture as it stands."""
        return self._view

    def _advanced(self, given: GameInput) -> GameView:
        """The exercise on the stage after one step."""
        if self._between_s is not None:
            return self._waited(given)
        if given.wish is Wish.QUIT:
            self._quit = True
        if given.wish is Wish.NEXT and self._has_next:
            self._games[self._current].step(replace(given, wish=Wish.QUIT))
            return self._opened(given)
        view = self._games[self._current].step(given)
        if view.phase is Phase.OVER and self._has_next and not self._quit:
            self._between_s = BETWEEN_S
        return view

    def _waited(self, given: GameInput) -> GameView:
        """One step between two exercises."""
        if given.wish is Wish.QUIT:
            self._between_s, self._quit = None, True
            return self._games[self._current].view()
        if given.wish is Wish.PAUSE:
            return self._opened(given, Wish.PAUSE)
        left_s = (self._between_s or 0.0) - (min(max(given.dt_s, 0.0), LONGEST_STEP_S) if given.active else 0.0)
        if left_s <= 0.0 or given.wish in (Wish.GO_ON, Wish.NEXT, Wish.START):
            return self._opened(given)
        self._between_s = left_s
        return replace(self._games[self._current].step(replace(given, active=False, wish=Wish.NONE)), feedback=())

    def _opened(self, given: GameInput, wish: Wish = Wish.START) -> GameView:
        """The next exercise, begun unless it is wished otherwise: who has come this far need not start it once more."""
        self._earned += self._games[self._current].view().score
        self._current, self._between_s = self._current + 1, None
        return self._games[self._current].step(replace(given, wish=wish))

    @property
    def _has_next(self) -> bool:
        return self._current + 1 < len(self._games)

    def _offered(self) -> tuple[Wish, ...]:
        return self._menu.offered(self._view, has_next=self._has_next)

    def _seen(self, view: GameView) -> GameView:
        """The exercise's picture as part of the session's."""
        between = self._between_s is not None
        staged = replace(
            view,
            phase=Phase.BETWEEN if between else view.phase,
            time_left_s=view.time_left_s if self._between_s is None else self._between_s,
            things=tuple(replace(one, id=one.id + self._current * SPACES_APART) for one in view.things),
            exercise=self._current + 1,
            exercises=len(self._games),
            next_game=self._exercises[self._current + 1].game if self._has_next and not self._quit else "",
            total_score=self._earned + view.score,
        )
        offered = self._menu.offered(staged, has_next=self._has_next)
        choices = self._menu.views(offered)
        return replace(staged, choices=choices, aim=staged.aim or _invited(choices))


def _invited(choices: tuple[ChoiceView, ...]) -> Point | None:
    """Where a hand goes that wants the game to begin; out of a rest or a pause nobody is lured."""
    return next((one.position for one in choices if one.id is Wish.START), None)
