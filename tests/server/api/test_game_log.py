"""A session's games, written down while they are played, come back exactly: whole, or up to where they were cut off."""

import random
from dataclasses import replace

import pytest

from fusion.errors import RecordingError
from fusion.skeleton import Side
from games.game import GameInput, GameSettings, Wish, Workspace
from games.play import GRACE_S
from games.player import QUICK, Player
from games.programme import Exercise
from games.replay import GameRecord, opened
from server.api.game_log import played, read_game
from server.api.game_log_writer import GameLogWriter
from server.api.tally import Tally, play_again

WORKSPACE = Workspace(Side.LEFT, (-0.2, 0.0, 0.0), 0.3, 0.3, (0.1, 1.5), (0.3, 1.3), (-0.5, 0.5), (0.3, 1.8))
SETTINGS = GameSettings(rounds=2, round_s=15.0, rest_s=3.0)
RECORD = GameRecord((Exercise("reach", SETTINGS), Exercise("reach", replace(SETTINGS, pinned=True))), WORKSPACE, 11)
WISHES = {50: Wish.START, 400: Wish.PAUSE, 430: Wish.GO_ON, 600: Wish.PIN, 800: Wish.NEXT}
STEPS = 1200


def play(path):
    """Two exercises by a virtual player at an uneven rate; what became of them, and every input."""
    games, tally, log = opened(RECORD), Tally(), GameLogWriter(path, RECORD)
    player, rng, inputs = Player(QUICK, seed=5), random.Random(3), []
    for step in range(STEPS):
        dt_s = rng.uniform(0.005, 0.05)
        given = GameInput(
            dt_s=dt_s,
            hand=player.step(games.view(), dt_s),
            active=step % 300 > 10,
            healthy_hand=None if step % 7 == 0 else (0.2, -0.1, -0.3),
            trunk_lean_m=0.01,
            wish=WISHES.get(step, Wish.NONE),
            level=0.7,
        )
        inputs.append(given)
        log.take(given, 5.0 + step)
        tally.take(games.step(given), dt_s, active=given.active)
    log.close()
    return games, tally.played, inputs


@pytest.fixture(scope="module")
def game(tmp_path_factory):
    path = tmp_path_factory.mktemp("games") / "session-000001.game"
    return path, *play(path)


def test_every_input_comes_back_as_it_was(game):
    path, _, _, inputs = game
    log = read_game(path)
    assert log.record == RECORD
    logged = list(log.inputs())
    assert [one.given for one in logged] == inputs
    assert [one.t_s for one in logged] == [5.0 + step for step in range(STEPS)]


def test_the_score_and_every_attempt_replay_exactly(game):
    path, games, tally, _ = game
    again = played(path)
    assert again.outcomes == games.outcomes
    assert again.trials == games.trials
    assert len(again.trials) > 3
    assert (play_again(path).exercises, play_again(path).trials) == (tally, games.trials)
    assert [one.game for one in tally] == ["reach", "reach"]
    assert tally[0].score > 0
    assert 0 < tally[0].played_s <= 2 * (SETTINGS.round_s + GRACE_S)


@pytest.mark.parametrize("kept", [0.31, 0.77, 0.999])
def test_a_file_that_was_cut_off_replays_up_to_its_last_whole_entry(game, tmp_path, kept):
    path, _, _, inputs = game
    cut = tmp_path / "cut.game"
    whole = path.read_bytes()
    cut.write_bytes(whole[: int(len(whole) * kept)])
    logged = [one.given for one in read_game(cut).inputs()]
    assert logged == inputs[: len(logged)]
    assert 0.97 * kept * STEPS < len(logged) <= STEPS, "entries are nearly of one length"
    games = opened(RECORD)
    for given in logged:
        games.step(given)
    assert played(cut).trials == games.trials


def test_a_spoilt_entry_ends_the_file_there(game, tmp_path):
    path, _, _, inputs = game
    spoilt = tmp_path / "spoilt.game"
    whole = bytearray(path.read_bytes())
    whole[len(whole) // 2] ^= 0xFF
    spoilt.write_bytes(whole)
    logged = [one.given for one in read_game(spoilt).inputs()]
    assert logged == inputs[: len(logged)]
    assert 0 < len(logged) < STEPS


@pytest.mark.parametrize("content", [b"", b"PK\x03\x04" * 50, b"\x01\x00\x00\x00\x00\x00\x00\x00\x90"])
def test_what_is_no_game_is_refused_with_a_remedy(tmp_path, content):
    path = tmp_path / "x.game"
    path.write_bytes(content)
    with pytest.raises(RecordingError, match="does not hold") as caught:
        read_game(path)
    assert caught.value.remedy
    with pytest.raises(RecordingError, match="cannot be read"):
        read_game(tmp_path / "nowhere.game")


def test_a_disk_that_refuses_is_told_and_stops_nothing(tmp_path):
    log = GameLogWriter(tmp_path / "nowhere" / "x.game", RECORD)
    log.take(GameInput(dt_s=0.01, hand=(0.0, 0.0, 0.0), active=True), 1.0)
    log.close()
    assert "x.game" in log.trouble


def test_no_older_file_is_written_over(game):
    path, *_ = game
    before = path.read_bytes()
    log = GameLogWriter(path, RECORD)
    log.close()
    assert log.trouble
    assert path.read_bytes() == before
