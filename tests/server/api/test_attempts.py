"""Attempts in a session's games become figures, and a game's file that is spoilt costs no other figure."""

import logging

import pytest

from fusion.skeleton import Side
from games.game import GameInput, GameSettings, Workspace
from games.player import QUICK, Player
from games.programme import Exercise
from games.replay import GameRecord, opened
from server.api.attempts import attempts_again
from server.api.game_log_writer import GameLogWriter

WORKSPACE = Workspace(Side.LEFT, (-0.2, 0.0, 0.0), 0.3, 0.3, (0.1, 1.5), (0.3, 1.3), (-0.5, 0.5), (0.3, 1.8))
RECORD = GameRecord((Exercise("reach", GameSettings(rounds=1, round_s=30.0)),), WORKSPACE, 11)


@pytest.fixture
def recording(tmp_path):
    """Where a session is recorded whose game was played for half a minute."""
    path = tmp_path / "session-000001.mcap"
    games, player, log = opened(RECORD), Player(QUICK, seed=5), GameLogWriter(path.with_suffix(".game"), RECORD)
    for step in range(800):
        given = GameInput(dt_s=0.05, hand=player.step(games.view(), 0.05), active=True)
        log.take(given, 0.05 * step)
        games.step(given)
    log.close()
    return path, games


def test_attempts_are_those_of_the_game(recording):
    path, games = recording
    told = attempts_again(path)
    assert len(told) == len(games.trials) > 3
    for attempt, trial in zip(told, games.trials, strict=True):
        assert (attempt.game, attempt.success, attempt.level) == (trial.game, trial.success, trial.level)
        assert (attempt.reaction_s, attempt.hold_m) == (trial.reaction_s, trial.hold_m)


def test_a_session_without_games_has_none(tmp_path):
    assert attempts_again(tmp_path / "session-000002.mcap") == ()


def test_a_spoilt_file_has_none_and_says_why(recording, caplog):
    path, _ = recording
    path.with_suffix(".game").write_bytes(b"no game")
    with caplog.at_level(logging.WARNING):
        assert attempts_again(path) == ()
    assert "does not hold a session's games" in caplog.text
