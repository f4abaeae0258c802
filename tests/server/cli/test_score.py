"""`mirrorlimb score`: the same points as were won when the games were played."""

import pytest
import typer
from typer.testing import CliRunner

from fusion.errors import RecordingError
from fusion.skeleton import Side
from games.game import GameInput, GameSettings, Wish, Workspace
from games.player import QUICK, Player
from games.programme import Exercise
from games.replay import GameRecord, opened
from server.api.game_log_writer import GameLogWriter
from server.cli.score import score

WORKSPACE = Workspace(Side.RIGHT, (0.2, 0.0, 0.0), 0.3, 0.3, (0.1, 1.5), (0.3, 1.3), (-0.5, 0.5), (0.3, 1.8))
RECORD = GameRecord((Exercise("reach", GameSettings(rounds=1, round_s=20.0)),), WORKSPACE, 4)


@pytest.fixture
def command():
    app = typer.Typer()
    app.command()(score)
    return lambda *words: CliRunner().invoke(app, [str(word) for word in words])


@pytest.fixture
def game(tmp_path):
    """A file of one game, and how it ended."""
    path = tmp_path / "session-000001.game"
    games, player, log = opened(RECORD), Player(QUICK, seed=2), GameLogWriter(path, RECORD)
    for step in range(500):
        given = GameInput(0.04, player.step(games.view(), 0.04), active=True, wish=Wish.NONE if step else Wish.START)
        log.take(given, float(step))
        games.step(given)
    log.close()
    return path, games.view()


@pytest.mark.parametrize("named", [".game", ".mcap"])
def test_the_points_are_those_that_were_won(command, game, named):
    path, view = game
    said = command(path.with_suffix(named))
    assert said.exit_code == 0, said.output
    assert f"1. reach: {view.score} points, {view.hits} of {view.hits + view.misses} attempts" in said.output
    assert view.score > 0


def test_a_file_of_another_version_says_so(command, game, monkeypatch):
    monkeypatch.setattr("server.cli.score.__version__", "99.0")
    assert "99.0" in command(game[0]).output


def test_what_is_no_game_is_refused(command, tmp_path):
    path = tmp_path / "x.game"
    path.write_text("some notes")
    assert isinstance(command(path).exception, RecordingError)
