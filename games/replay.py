"""A session's games played again from what was recorded of them: the same inputs give the same pictures."""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from dataclasses import dataclass

from games.game import GameInput, GameView, Trial, Workspace
from games.programme import Exercise, Programme


@dataclass(frozen=True, slots=True)
class GameRecord:
    """All that the games' course depends on, but for the inputs."""

    exercises: tuple[Exercise, ...]
    workspace: Workspace
    seed: int


@dataclass(frozen=True, slots=True)
class Played:
    """What became of the games."""

    outcomes: tuple[GameView, ...]
    """How every exercise stood at the end."""
    trials: tuple[Trial, ...]


def opened(record: GameRecord) -> Programme:
    """The games at their beginning.

    Raises:
        InputError: there is no game of such a name.
    """
    return Programme(record.exercises, record.workspace, record.seed)


def replay(record: GameRecord, inputs: Iterable[GameInput]) -> Iterator[GameView]:
    """Every picture of the games, one per input.

    Raises:
        InputError: there is no game of such a name.
    """
    programme = opened(record)
    return (programme.step(given) for given in inputs)


def played(record: GameRecord, inputs: Iterable[GameInput]) -> Played:
    """What became of the games.

    Raises:
        InputError: there is no game of such a name.
    """
    programme = opened(record)
    for given in inputs:
        programme.step(given)
    return Played(programme.outcomes, programme.trials)
