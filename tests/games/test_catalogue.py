"""Games are opened by name, and a wrong name says which there are."""

from __future__ import annotations

import pytest

from fusion.errors import InputError
from fusion.skeleton import Side
from games.catalogue import GAMES, open_game
from games.game import GameSettings, Workspace

ANY = Workspace(Side.LEFT, (-0.18, 0.0, 0.0), 0.28, 0.33, (0.2, 1.8), (0.2, 1.5), (-0.8, 0.8), (0.2, 2.0))


@pytest.mark.parametrize("name", list(GAMES))
def test_every_game_in_the_catalogue_opens_and_knows_its_name(name: str) -> None:
    view = open_game(name, ANY, 1, GameSettings()).view()
    assert view.game == name
    assert view.phase == "waiting"


def test_an_unknown_game_names_those_there_are() -> None:
    with pytest.raises(InputError, match="reach"):
        open_game("chess", ANY, 1, GameSettings())
