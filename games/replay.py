"""A game played again from what was recorded of it: the same inputs give the same picture."""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from dataclasses import dataclass

from games.catalogue import open_game
from games.game import GameInput, GameSettings, GameView, Workspace


@dataclass(frozen=True, slots=True)
class GameRecord:
    """All that a game's course depends on, but for its inputs."""

    game: str
    workspace: Workspace
    seed: int
    settings: GameSettings


def replay(record: GameRecord, inputs: Iterable[GameInput]) -> Iterator[GameView]:
    """Every picture of the game, one per input.

    Raises:
        InputError: there is no game of that name.
    """
    game = open_game(record.game, record.workspace, record.seed, record.settings)
    return (game.step(given) for given in inputs)
