"""The games there are, by name. A further game is a file beside `reach.py` and a line here."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Final, Protocol

from fusion.errors import InputError
from games import reach
from games.game import Game, GameSettings, Workspace


class GameFactory(Protocol):
    """Makes a game at its beginning."""

    def __call__(self, workspace: Workspace, seed: int, settings: GameSettings) -> Game:
        """A new game; the same arguments make the same game."""
        ...


GAMES: Final[Mapping[str, GameFactory]] = {
    reach.NAME: reach.ReachGame,
}


def open_game(name: str, workspace: Workspace, seed: int, settings: GameSettings) -> Game:
    """A new game by name.

    Raises:
        InputError: there is no game of that name.
    """
    if name not in GAMES:
        raise InputError(
            f"There is no game called '{name}'", f"one of {', '.join(sorted(GAMES))}", "choose one of these games"
        )
    return GAMES[name](workspace, seed, settings)
