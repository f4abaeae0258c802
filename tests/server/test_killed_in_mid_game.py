"""A service that is killed while somebody plays: nothing is lost, and the score replays to the same."""

import time
from contextlib import contextmanager

import httpx
import pytest

from server.api.game_log import game_log_of, played
from server.api.tally import play_again

PAGE = {"Mirrorlimb-Client": "dashboard"}
EXERCISES = [{"game": "reach", "minutes": 2, "level": 0.0, "pinned": True}]
WITHIN_S = 90.0


@contextmanager
def entered(service):
    """A client that is logged in to the demonstration, and its patient."""
    with httpx.Client(base_url=service.address, timeout=20, trust_env=False, headers=PAGE) as client:
        yield client, client.post("/api/demo").raise_for_status().json()["patient"]


def until(condition):
    end_s = time.monotonic() + WITHIN_S
    while time.monotonic() < end_s:
        found = condition()
        if found:
            return found
        time.sleep(0.1)
    return pytest.fail("it did not happen")


def play_until_something_is_won(client, path, page):
    """Start as soon as that is accepted, and resume after a hold, as a person would."""
    wishes = {"ready": "start", "hold": "resume"}

    def won():
        message = page.messages[-1]
        if message["tick"]["state"] in wishes:
            client.post(f"{path}/control", json={"action": wishes[message["tick"]["state"]]})
        game = message["game"]
        if game and game["phase"] == "waiting":
            client.post(f"{path}/game", json={"wish": "start"})
        return game and game["hits"] > 0

    until(lambda: page.messages and won())


def test_a_service_killed_in_mid_game_loses_nothing_of_what_was_played(start_service, look):
    first = start_service("--demo")
    with entered(first) as (client, patient):
        page = look(client)
        form = {"patient_id": patient["id"], "confirmed_affected_side": "left", "exercises": EXERCISES}
        session = client.post("/api/sessions", json=form).raise_for_status().json()["id"]
        play_until_something_is_won(client, f"/api/sessions/{session}", page)
        time.sleep(0.5)
        first.process.kill()
        first.process.wait(timeout=20)
    file = game_log_of(first.data / "recordings" / f"session-{session:06d}.mcap")
    (kept,) = play_again(file).exercises
    assert kept.hits >= 1
    assert played(file).outcomes[0].score == kept.score > 0

    with entered(start_service("--demo")) as (client, _):
        path = f"/api/sessions/{session}"
        found = until(lambda: (told := client.get(path).json())["measured"] and told)
        assert client.get("/api/sessions/current").json() is None
    assert found["status"] == "interrupted"
    assert found["played"] == [kept.model_dump()]
