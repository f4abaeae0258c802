"""The games of a session over REST: what may be wished by whom, screens that go, the workspace, and what is kept."""

import json
import time

import pytest

from db.account import Role
from db.queries import accounts, sessions
from server.api.auth import COOKIE
from server.api.game_log import game_log_of, played
from server.api.plan_forms import Adherence

REACH = {"game": "reach", "minutes": 6.0, "level": 0.3, "pinned": False}


def until(condition):
    """Wait for something that happens in another process."""
    for _ in range(400):
        found = condition()
        if found:
            return found
        time.sleep(0.025)
    return pytest.fail("it did not happen")


@pytest.fixture
def opened(shared, therapist, new_patient, look):
    """Opens a session from a connected page that is in charge of it; ended afterwards if it was not."""
    page = look(therapist)

    def made(patient=None, **more):
        patient = patient or new_patient("Player")
        form = {"patient_id": patient["id"], "confirmed_affected_side": "left", **more}
        page.session = therapist.post("/api/sessions", json=form).raise_for_status().json()
        page.path = f"/api/sessions/{page.session['id']}"
        return page

    yield made
    current = therapist.get("/api/sessions/current").json()
    if current:
        therapist.post(f"/api/sessions/{current['id']}/end", json={}).raise_for_status()


@pytest.fixture
def in_play(opened):
    """A session of two exercises whose first game is being played."""
    page = opened(exercises=[REACH, REACH | {"level": 0.6, "pinned": True}])
    page.post(f"{page.path}/control", action="start").raise_for_status()
    until(lambda: view(page))
    wish(page, "start").raise_for_status()
    until(lambda: view(page)["phase"] == "playing")
    return page


def view(page):
    return page.messages and page.messages[-1]["game"]


def line(page):
    return page.messages[-1]["session"]


def wish(page, what, **more):
    return page.post(f"{page.path}/game", wish=what, **more)


@pytest.fixture
def screen_account(shared):
    """The account of the patient's screen."""
    service = shared.service
    with service.database.session() as session:
        account = accounts.find_account(session, "screen") or accounts.add_account(session, "screen", None, Role.SCREEN)
    with shared.client(cookies={COOKIE: service.auth.open_login(account)}) as client:
        yield client


def test_a_session_says_its_exercises_in_every_message(opened):
    page = opened(exercises=[REACH])
    until(lambda: page.messages and line(page))
    assert line(page)["exercises"] == [REACH]
    assert (line(page)["patient_screens"], line(page)["screen_lost"]) == (0, False)


def test_without_a_plan_it_is_six_minutes_of_reach(opened):
    assert opened().session["exercises"] == [REACH | {"level": 0.2}]


def test_a_session_is_opened_with_the_plan_unless_it_says_otherwise(therapist, opened, new_patient):
    patient = new_patient("Planned")
    exercises = [REACH | {"minutes": 3.0}, REACH | {"level": None, "pinned": True}]
    plan = {"exercises": exercises, "sessions_per_week": 3, "weeks": 4, "starts_on": "2026-03-02"}
    therapist.put(f"/api/patients/{patient['id']}/plan", json=plan).raise_for_status()
    page = opened(patient)
    assert page.session["exercises"] == [exercises[0], exercises[1] | {"level": 0.2}]
    page.post(f"{page.path}/end").raise_for_status()
    assert opened(patient, exercises=[REACH]).session["exercises"] == [REACH]


def test_a_plan_that_names_a_game_that_is_gone_is_refused_with_what_to_do(shared, therapist, new_patient):
    patient = new_patient("Old plan")
    plan = {"exercises": [REACH], "sessions_per_week": 3, "weeks": 4, "starts_on": "2026-03-02"}
    therapist.put(f"/api/patients/{patient['id']}/plan", json=plan).raise_for_status()
    gone = json.dumps([REACH | {"game": "skittles"}])
    with shared.service.database.engine.begin() as connection:
        connection.exec_driver_sql("UPDATE plan SET exercises = ? WHERE patient_id = ?", (gone, patient["id"]))
    form = {"patient_id": patient["id"], "confirmed_affected_side": "left"}
    answer = therapist.post("/api/sessions", json=form, headers={"Mirrorlimb-Client": "dashboard"})
    assert answer.status_code == 422
    detail = answer.json()["detail"]
    assert "skittles" in detail["what"]
    assert "change the plan" in detail["remedy"]
    assert therapist.get("/api/sessions/current").json() is None


def test_the_games_do_as_they_are_wished(in_play):
    expected = {"pause": "paused", "go_on": "playing", "rest": "rest"}
    for what, phase in expected.items():
        assert wish(in_play, what).status_code == 200
        until(lambda phase=phase: view(in_play)["phase"] == phase)
    wish(in_play, "pin", level=0.9).raise_for_status()
    until(lambda: (view(in_play)["level"], view(in_play)["pinned"]) == (0.9, True))
    wish(in_play, "adapt").raise_for_status()
    until(lambda: not view(in_play)["pinned"])
    wish(in_play, "next").raise_for_status()
    until(lambda: view(in_play)["exercise"] == 2)
    assert (view(in_play)["level"], view(in_play)["pinned"]) == (0.6, True)
    refused = wish(in_play, "next")
    assert refused.status_code == 409
    assert "no further exercise" in refused.json()["detail"]["what"]
    wish(in_play, "quit").raise_for_status()
    until(lambda: view(in_play)["phase"] == "over")
    refused = wish(in_play, "pause")
    assert refused.status_code == 409
    assert "over" in refused.json()["detail"]["what"]
    events = in_play.client.get(f"{in_play.path}/events").json()
    assert [event["text"] for event in events if event["kind"] == "game"][-2:] == ["next", "quit"]


def test_before_the_arm_was_engaged_there_is_no_game_to_steer(opened):
    refused = wish(opened(), "pause")
    assert refused.status_code == 409
    assert "not begun" in refused.json()["detail"]["what"]


@pytest.mark.parametrize("form", [{"wish": "dance"}, {}, {"wish": "pin", "level": 2}])
def test_a_wish_that_there_is_not_is_refused(in_play, form):
    assert in_play.post(f"{in_play.path}/game", **form).status_code == 422


def test_sr11_everybody_may_pause_and_the_patients_screen_goes_on_but_steers_nothing_else(
    in_play, therapist, screen_account, look
):
    other = look(therapist, "second")
    screen = look(screen_account, "screen", "patient")
    for page in (other, screen):
        page.path = in_play.path
    until(lambda: line(in_play)["patient_screens"] == 1)
    assert wish(other, "pause").status_code == 200
    until(lambda: view(in_play)["phase"] == "paused")
    assert wish(other, "go_on").status_code == 409
    for what in ("next", "quit", "pin", "rest", "start"):
        for page in (other, screen):
            refused = wish(page, what)
            assert (refused.status_code, "in charge" in refused.json()["detail"]["what"]) == (409, True)
    assert wish(screen, "go_on").status_code == 200
    until(lambda: view(in_play)["phase"] == "playing")


def test_a_game_whose_screen_is_closed_waits_and_loses_nothing(in_play, therapist, look):
    first = look(therapist, "first", "patient")
    until(lambda: line(in_play)["patient_screens"] == 1)
    second = look(therapist, "other", "patient")
    until(lambda: line(in_play)["patient_screens"] == 2)
    first.close()
    until(lambda: line(in_play)["patient_screens"] == 1)
    assert view(in_play)["phase"] == "playing", "one of two screens may go"
    second.close()
    until(lambda: view(in_play)["phase"] == "paused")
    until(lambda: line(in_play)["screen_lost"])
    score = view(in_play)["score"]
    back = look(therapist, "back", "patient")
    until(lambda: not line(in_play)["screen_lost"])
    assert (view(back)["phase"], view(back)["score"]) == ("paused", score)
    assert "go_on" in {choice["id"] for choice in view(back)["choices"]}
    back.path = in_play.path
    wish(back, "go_on").raise_for_status()
    until(lambda: view(in_play)["phase"] == "playing")
    events = in_play.client.get(f"{in_play.path}/events").json()
    assert [event["data"]["screens"] for event in events if event["kind"] == "screen"] == [1, 2, 1, 0, 1]


def test_a_screen_that_goes_before_the_first_game_may_be_done_without(opened, therapist, look):
    page = opened()
    screen = look(therapist, "screen", "patient")
    until(lambda: page.messages and line(page) and line(page)["patient_screens"] == 1)
    screen.close()
    until(lambda: line(page)["screen_lost"])
    assert wish(page, "go_on").json() == {"game": "reach", "phase": "waiting"}
    until(lambda: not line(page)["screen_lost"])
    assert wish(page, "go_on").status_code == 409


def test_a_screen_whose_cable_is_pulled_is_missed_as_well(in_play, therapist, look, monkeypatch):
    monkeypatch.setattr("server.api.authority.SCREEN_LOST_AFTER_S", 0.3)
    screen = look(therapist, "screen", "patient")
    until(lambda: line(in_play)["patient_screens"] == 1)
    screen.pull()
    until(lambda: view(in_play)["phase"] == "paused")
    wish(in_play, "go_on").raise_for_status()
    until(lambda: view(in_play)["phase"] == "playing")


def test_a_mistake_in_a_game_costs_the_games_and_nothing_else(in_play, therapist, monkeypatch, caplog):
    def mistaken(*_, **__):
        raise ZeroDivisionError("a game's own")

    monkeypatch.setattr("games.programme.Programme.step", mistaken)
    events = f"{in_play.path}/events"
    until(lambda: "no games" in [event["kind"] for event in therapist.get(events).json()])
    seen = len(in_play.messages)
    until(lambda: len(in_play.messages) > seen + 5)
    assert in_play.messages[-1]["tick"]["state"] == "engaged"
    assert view(in_play)["phase"] == "playing"
    ended = in_play.post(f"{in_play.path}/end").raise_for_status().json()
    assert [one["game"] for one in ended["played"]] == ["reach"]
    assert [record.levelname for record in caplog.records if "by a mistake" in record.message] == ["ERROR"]


def test_what_was_played_is_kept_and_replays_to_the_same(shared, in_play, therapist):
    time.sleep(0.5)
    wish(in_play, "pin", level=0.8).raise_for_status()
    until(lambda: view(in_play)["level"] == 0.8)
    ended = in_play.post(f"{in_play.path}/end", pain_after=2).raise_for_status().json()
    (kept,) = ended["played"]
    assert (kept["game"], kept["level"]) == ("reach", 0.8)
    assert kept["played_s"] > 0.4
    with shared.service.database.session() as session:
        recording = sessions.find_session(session, ended["id"]).recording
    again = played(game_log_of(shared.data / recording))
    assert (again.outcomes[0].score, again.outcomes[0].level) == (kept["score"], 0.8)


def test_the_next_session_begins_at_the_level_that_was_reached(in_play, opened):
    wish(in_play, "pin", level=0.75).raise_for_status()
    until(lambda: view(in_play)["level"] == 0.75)
    in_play.post(f"{in_play.path}/end").raise_for_status()
    again = opened({"id": in_play.session["patient_id"]}, exercises=[REACH | {"level": None}, REACH])
    assert [one["level"] for one in again.session["exercises"]] == [0.75, 0.3]


def test_a_played_session_counts_for_the_plan(in_play, therapist, monkeypatch):
    monkeypatch.setattr("server.api.adherence.LEAST_PLAYED_S", 0.2)
    time.sleep(0.3)
    in_play.post(f"{in_play.path}/end").raise_for_status()
    path = f"/api/patients/{in_play.session['patient_id']}/adherence?weeks=1"
    found = Adherence.model_validate(therapist.get(path).json())
    assert [week.done for week in found.weeks] == [1]
    assert sum(day.minutes for day in found.days) > 0


def test_the_workspace_is_what_the_healthy_arm_has_shown(opened, monkeypatch):
    monkeypatch.setattr("server.api.workspace_meter.ENOUGH_S", 0.5)
    page = opened()
    path = f"{page.path}/workspace"
    assert page.session["workspace"]["source"] == "limits"
    early = page.post(path)
    assert early.status_code == 409
    assert "not shown enough" in early.json()["detail"]["what"]
    shown = until(lambda: (found := page.client.get(path).json())["seen_s"] > 3.2 and found)
    assert (shown["missing"], shown["enough"]) == (list(shown["shown"]), False), "the paper arm moves by 23° at most"
    monkeypatch.setattr("server.api.workspace_meter.ENOUGH_RAD", dict.fromkeys(shown["shown"], 0.01))
    taken = page.post(path).raise_for_status().json()
    assert taken["workspace"]["source"] == "shown"
    elbow = taken["workspace"]["shown"]["elbow"]
    assert elbow["min_rad"] == pytest.approx(0.5, abs=0.15)
    stored = page.client.get(page.path).json()["workspace"]
    assert stored == taken["workspace"]
    page.post(f"{page.path}/control", action="start").raise_for_status()
    until(lambda: view(page))
    late = page.post(path)
    assert (late.status_code, late.json()["detail"]["what"]) == (409, "the games have begun")
    page.post(f"{page.path}/end").raise_for_status()
    again = opened({"id": page.session["patient_id"]})
    assert again.session["workspace"] == {**stored, "source": "last", "shown": None}


def test_notes_are_kept_during_a_session_and_afterwards(opened, therapist):
    page = opened()
    assert therapist.patch(page.path, json={"notes": "slowly today"}).json()["notes"] == "slowly today"
    page.post(f"{page.path}/end", pain_after=3).raise_for_status()
    changed = therapist.patch(page.path, json={"pain_after": 1}).json()
    assert (changed["notes"], changed["pain_after"]) == ("slowly today", 1)
    assert therapist.patch("/api/sessions/99999", json={"notes": "x"}).status_code == 404
    assert therapist.patch(page.path, json={"pain_after": 11}).status_code == 422
    assert "notes" not in page.session


def test_a_dashboard_that_is_lost_in_mid_game_holds_arm_and_game_and_both_go_on_where_they_were(
    in_play, therapist, look
):
    other = look(therapist, "second")
    in_play.pull()
    until(lambda: other.messages and other.messages[-1]["tick"]["state"] == "hold")
    held = view(other)
    time.sleep(0.3)
    assert view(other) | {"hand": None} == held | {"hand": None}
    back = look(therapist, "dashboard")
    until(lambda: therapist.get("/api/sessions/current/authority").json()["connected"])
    until(lambda: back.post(f"{in_play.path}/control", action="resume").is_success)
    until(lambda: view(other)["time_left_s"] < held["time_left_s"])
    assert (view(other)["phase"], view(other)["exercise"]) == ("playing", 1)
