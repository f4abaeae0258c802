"""A session's games in progress: stepped with every tick, steered by what people wish, and written down."""

from __future__ import annotations

from collections import deque
from collections.abc import Sequence

from db.exercise import Exercise, PlayedExercise
from games.game import GameInput, GameSettings, GameView, Trial, Wish
from games.programme import Exercise as GameExercise
from games.replay import GameRecord, opened
from server.api.exercises import FIRST_LEVEL
from server.api.game_log_writer import GameLogWriter
from server.api.tally import Tally
from server.messages import LiveTick

ROUND_S = 60.0
"""A round lasts about so long; an exercise is as many whole rounds as come nearest to its minutes."""


class Playing:
    """The games in progress.

    Args:
        record: what they begin with.
        log: where every input goes before the games take it.
    """

    def __init__(self, record: GameRecord, log: GameLogWriter) -> None:
        self._programme, self._tally, self.log = opened(record), Tally(), log
        self._wishes: deque[tuple[Wish, float]] = deque()

    @property
    def picture(self) -> GameView:
        """How the games stand."""
        return self._programme.view()

    @property
    def played(self) -> tuple[PlayedExercise, ...]:
        """What became of every exercise that was begun."""
        return self._tally.played

    @property
    def trials(self) -> tuple[Trial, ...]:
        """Every attempt so far."""
        return self._programme.trials

    def wish(self, wish: Wish, level: float = 0.0) -> None:
        """Somebody wishes something; it is done with the next tick."""
        self._wishes.append((wish, level))

    def step(self, tick: LiveTick, dt_s: float, *, active: bool) -> GameView:
        """Take a tick."""
        wish, level = self._wishes.popleft() if self._wishes else (Wish.NONE, 0.0)
        given = GameInput(
            dt_s=dt_s,
            hand=tick.affected.points_in_trunk[-1],
            active=active,
            healthy_hand=tick.healthy.points_in_trunk[-1] if tick.healthy is not None and tick.healthy.valid else None,
            trunk_lean_m=tick.trunk_lean_m,
            shoulder_hitch_m=tick.shoulder_hitch_m,
            wish=wish,
            level=level,
        )
        self.log.take(given, tick.t_s)
        view = self._programme.step(given)
        self._tally.take(view, dt_s, active=active)
        return view


def as_games(exercises: Sequence[Exercise]) -> tuple[GameExercise, ...]:
    """A session's exercises as the games take them."""
    return tuple(GameExercise(one.game, _settings(one)) for one in exercises)


def _settings(exercise: Exercise) -> GameSettings:
    rounds = max(1, round(exercise.minutes * 60.0 / ROUND_S))
    return GameSettings(
        rounds=rounds,
        round_s=exercise.minutes * 60.0 / rounds,
        start_level=FIRST_LEVEL if exercise.level is None else exercise.level,
        pinned=exercise.pinned,
    )
