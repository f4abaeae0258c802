"""The games there are, by name. A further game is a folder beside `reach` and a line here."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Final

from fusion.errors import InputError
from games.catch.rules import CatchRules
from games.everyday.rules import EverydayRules
from games.game import GameSettings, Workspace
from games.play import Play
from games.reach.rules import ReachRules
from games.row.rules import RowRules
from games.rules import RulesFactory
from games.trace.rules import TraceRules
from games.wipe.rules import WipeRules

GAMES: Final[Mapping[str, RulesFactory]] = {
    "reach": ReachRules,
    "trace": TraceRules,
    "catch": CatchRules,
    "row": RowRules,
    "everyday": EverydayRules,
    "wipe": WipeRules,
}


def open_game(name: str, workspace: Workspace, seed: int, settings: GameSettings) -> Play:
    """A new game by name; the same arguments make the same game.

    Raises:
        InputError: there is no game of that name.
    """
    check_game(name)
    return Play(name, GAMES[name], workspace, seed, settings)


def check_game(name: str) -> None:
    """Make sure that there is such a game.

    Raises:
        InputError: there is none.
    """
    if name not in GAMES:
        raise InputError(
            f"There is no game called '{name}'", f"one of {', '.join(sorted(GAMES))}", "choose one of these games"
        )
