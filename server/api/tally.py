"""What has been played of every exercise, counted from the games' pictures: while they are played, or once more."""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path

from db.exercise import PlayedExercise
from games.game import LONGEST_STEP_S, GameView, Phase, Trial
from games.replay import opened
from server.api.game_log import read_game


class Tally:
    """Counts the exercises that were begun."""

    def __init__(self) -> None:
        self._times_s: dict[int, float] = {}
        self._newest: dict[int, GameView] = {}

    def take(self, view: GameView, dt_s: float, *, active: bool) -> None:
        """Count a step that led to that picture; while the arm is held nobody plays."""
        if view.phase is Phase.PLAYING:
            step_s = min(max(dt_s, 0.0), LONGEST_STEP_S) if active else 0.0
            self._times_s[view.exercise] = self._times_s.get(view.exercise, 0.0) + step_s
        self._newest[view.exercise] = view

    @property
    def played(self) -> tuple[PlayedExercise, ...]:
        """What became of every exercise that was begun; rests, pauses and holds are no time of play."""
        return tuple(_counted(self._newest[number], duration_s) for number, duration_s in sorted(self._times_s.items()))


@dataclass(frozen=True, slots=True)
class PlayedAgain:
    """What a file of games came to."""

    exercises: tuple[PlayedExercise, ...]
    trials: tuple[Trial, ...]


def play_again(path: Path) -> PlayedAgain:
    """What was played, from the file of a session's games. Takes a while: run it in a worker thread.

    Raises:
        RecordingError: the file cannot be read, or is none of ours.
        InputError: there is no game of such a name any more.
    """
    log, tally = read_game(path), Tally()
    games = opened(log.record)
    for logged in log.inputs():
        tally.take(games.step(logged.given), logged.dt_s, active=logged.active)
    return PlayedAgain(tally.played, games.trials)


def _counted(view: GameView, duration_s: float) -> PlayedExercise:
    return PlayedExercise(
        game=view.game,
        played_s=round(duration_s, 3),
        score=view.score,
        hits=view.hits,
        misses=view.misses,
        level=view.level,
    )
