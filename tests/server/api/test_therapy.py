"""A session from patient to saved metrics, and what becomes of it when something dies."""

import os
import signal
import sqlite3
import time
from pathlib import Path

import pytest


def opened(client, patient, **more):
    """Open a session for a patient whose healthy side is the right one."""
    form = {"patient_id": patient["id"], "confirmed_affected_side": "left", "pain_before": 2, **more}
    return client.post("/api/sessions", json=form)


def control(client, session, action):
    return client.post(f"/api/sessions/{session['id']}/control", json={"action": action})


def end(client, session, **form):
    return client.post(f"/api/sessions/{session['id']}/end", json=form)


def until(condition):
    """Wait for something that happens in another process."""
    for _ in range(400):
        found = condition()
        if found:
            return found
        time.sleep(0.025)
    return pytest.fail("it did not happen")


@pytest.fixture
def open_one(shared, therapist, new_patient, look):
    """Opens a session for a patient of that form, from a page that is connected; ended afterwards if it was not."""
    page = look(therapist)

    def made(**patient):
        session = opened(therapist, new_patient(**patient)).raise_for_status().json()
        return session, page

    yield made
    current = therapist.get("/api/sessions/current").json()
    if current:
        end(therapist, current).raise_for_status()


@pytest.fixture
def session(open_one):
    """An open session, whose page is in charge."""
    return open_one()[0]


def tick_when(page, condition):
    """The first tick that fulfils it."""
    return until(lambda: page.messages and condition(page.messages[-1]["tick"]) and page.messages[-1]["tick"])


def test_a_session_runs_from_patient_to_saved_metrics(shared, therapist, new_patient, look):
    look(therapist)
    patient = new_patient("Qian")
    session = opened(therapist, patient).json()
    assert (session["status"], session["affected_side"], session["pain_before"]) == ("open", "left", 2)
    assert therapist.get("/api/sessions/current").json() == session
    assert control(therapist, session, "start").json()["state"] == "engaged"
    time.sleep(3)
    ended = end(therapist, session, pain_after=1).json()
    assert (ended["status"], ended["pain_after"], ended["measured"]) == ("ended", 1, True)
    figures = {metric["name"] for metric in ended["metrics"]}
    assert {"own_work", "own_effort", "help", "minutes_passive"} <= figures
    assert all(metric["value"] is not None and metric["label"] for metric in ended["metrics"])
    assert therapist.get("/api/sessions/current").json() is None
    assert therapist.get(f"/api/sessions/{session['id']}").json() == ended
    assert therapist.get(f"/api/patients/{patient['id']}/sessions").json() == [ended]
    events = therapist.get(f"/api/sessions/{session['id']}/events").json()
    kinds = [event["kind"] for event in events]
    assert kinds[0] == "opened"
    assert "control" in kinds
    assert {"before": "ready", "after": "engaged"} in [event["data"] for event in events]


def test_curves_come_from_the_recording_and_are_kept(shared, therapist, session):
    control(therapist, session, "start")
    time.sleep(0.5)
    end(therapist, session).raise_for_status()
    path = f"/api/sessions/{session['id']}/curves"
    curves = therapist.get(path).json()
    count = len(curves["t_s"])
    assert 5 < count <= 1500
    assert curves["t_s"] == sorted(curves["t_s"])
    for arm in ("healthy_rad", "affected_rad"):
        assert {len(curve) for curve in curves[arm].values()} == {count}
    assert set(curves["state"]) >= {"ready", "engaged"}
    (recording,) = (shared.data / "recordings").glob(f"*{session['id']:06d}.mcap")
    recording.unlink()
    assert therapist.get(path).json() == curves


def test_a_second_session_is_refused(therapist, session, new_patient):
    answer = opened(therapist, new_patient("Li"))
    assert answer.status_code == 409
    assert "open" in answer.json()["detail"]["what"]


def test_the_wrong_side_is_refused_by_name(therapist, new_patient):
    answer = opened(therapist, new_patient("Zhou"), confirmed_affected_side="right")
    assert answer.status_code == 409
    assert "left" in answer.json()["detail"]["what"]
    assert therapist.get("/api/sessions/current").json() is None


@pytest.mark.parametrize(
    ("form", "status"),
    [
        ({"patient_id": 999}, 404),
        ({"exercises": [{"game": "chess", "minutes": 6}]}, 422),
        ({"exercises": [{"game": "reach", "minutes": 0}]}, 422),
        ({"exercises": []}, 422),
        ({"pain_before": 11}, 422),
        ({"exercises": [{"game": "reach", "minutes": 6, "level": 2}]}, 422),
    ],
)
def test_a_session_that_cannot_be_is_refused(therapist, new_patient, form, status):
    answer = opened(therapist, new_patient("Wu"), **form)
    assert answer.status_code == status
    assert set(answer.json()["detail"]) == {"what", "expected", "remedy"}


def test_a_range_that_the_device_does_not_have_is_refused(therapist, new_patient):
    full = {"min_rad": 0.0, "max_rad": 1.0}
    beyond = {"plane": full, "elevation": full, "rotation": full, "elbow": {"min_rad": 3.0, "max_rad": 3.1}}
    answer = opened(therapist, new_patient("Zheng", passive_range=beyond))
    assert answer.status_code == 409
    assert "elbow" in answer.json()["detail"]["what"]


def test_sr10_without_a_signature_for_the_limits_no_session_opens(therapist):
    patient = therapist.post("/api/patients", json={"name": "Kong", "healthy_side": "right"}).json()
    answer = opened(therapist, patient)
    assert answer.status_code == 409
    assert answer.json()["detail"]["what"] == "nobody has signed for Kong's limits"


def test_the_sessions_limits_say_who_signed_for_them(therapist, session):
    patient = therapist.get(f"/api/patients/{session['patient_id']}").json()
    assert session["limits"]["set_by"] == patient["limits_set_by"] == "Dr. Lin"
    assert session["limits"]["set_at"] == patient["limits_set_at"]
    assert all(joint["torque_nm"] <= 15.0 and joint["resistance_nm"] <= 6.0 for joint in session["limits"]["joints"])


def test_a_session_begins_to_help_as_the_patients_page_says(therapist, open_one):
    session, page = open_one(assistance="assisted", assist_level_most=0.6)
    assert (session["assistance"], session["assist_level"]) == ("assisted", 0.6)
    exo = tick_when(page, lambda tick: tick["session"] == str(session["id"]))["exo"]
    assert (exo["assistance"], exo["level"]) == ("assisted", 0.6)
    shown = until(lambda: page.messages[-1]["session"])
    assert shown["assist_level_most"] == 0.6


def test_a_session_may_begin_to_help_otherwise_but_with_no_more_than_is_allowed(therapist, new_patient, open_one):
    patient = new_patient(assist_level_most=0.6)
    refused = opened(therapist, patient, assist_level=0.7)
    assert refused.status_code == 409
    assert "0.60" in refused.json()["detail"]["what"]
    session = opened(therapist, patient, assistance="free", assist_level=0.2).json()
    assert (session["assistance"], session["assist_level"]) == ("free", 0.2)


def test_another_way_of_helping_reaches_the_arm_within_what_the_patient_is_allowed(therapist, open_one):
    session, page = open_one(assist_level_most=0.6)
    path = f"/api/sessions/{session['id']}/assistance"
    refused = therapist.post(path, json={"mode": "assisted", "level": 0.7})
    assert refused.status_code == 409
    assert "0.60" in refused.json()["detail"]["what"]
    assert therapist.post(path, json={"mode": "assisted", "level": 0.4}).status_code == 200
    assert tick_when(page, lambda tick: tick["exo"]["level"] == 0.4)["exo"]["assistance"] == "assisted"
    end(therapist, session).raise_for_status()
    events = therapist.get(f"/api/sessions/{session['id']}/events").json()
    (noted,) = [event["data"] for event in events if event["kind"] == "assistance"]
    assert noted == {"mode": "assisted", "level": 0.4, "by": "Dr. Lin"}


def test_sr18_the_range_is_measured_while_the_drive_only_carries_the_arm(therapist, session):
    path = f"/api/sessions/{session['id']}"
    assert therapist.get(f"{path}/measured-range").json() == {"ticks": 0, "range": None}
    control(therapist, session, "start").raise_for_status()
    refused = therapist.post(f"{path}/measured-range")
    assert refused.status_code == 409
    assert "free" in refused.json()["detail"]["what"]
    therapist.post(f"{path}/assistance", json={"mode": "free", "level": 0.0}).raise_for_status()
    until(lambda: therapist.post(f"{path}/measured-range").status_code == 200)
    measured = until(lambda: (found := therapist.get(f"{path}/measured-range").json())["ticks"] > 10 and found)
    # The paper arm's rotation and elbow do not move, so there is no whole range.
    assert measured["range"] is None


def test_limits_lie_inside_the_patients_range_and_the_devices(therapist, session):
    patient = therapist.get(f"/api/patients/{session['patient_id']}").json()
    device = {joint["joint"]: joint for joint in therapist.get("/api/station").json()["device"]}
    for joint in session["limits"]["joints"]:
        for outer in (patient["passive_range"][joint["joint"]], device[joint["joint"]]):
            assert outer["min_rad"] <= joint["min_rad"] < joint["max_rad"] <= outer["max_rad"]


def test_a_session_that_the_station_refuses_leaves_nothing(therapist, new_patient):
    patient = new_patient("refused")
    answer = opened(therapist, patient)
    assert answer.status_code == 409
    assert "serviced" in answer.json()["detail"]["what"]
    assert therapist.get(f"/api/patients/{patient['id']}/sessions").json() == []
    assert therapist.get("/api/sessions/current").json() is None


def test_every_control_reaches_the_arm(therapist, session):
    states = [
        control(therapist, session, action).json()["state"]
        for action in ("start", "hold", "resume", "stop", "reset", "start")
    ]
    assert states == ["engaged", "hold", "engaged", "stopped", "ready", "engaged"]


def test_what_the_station_refuses_is_a_409_with_its_reason(therapist, session):
    answer = control(therapist, session, "resume")
    assert answer.status_code == 409
    assert "ready" in answer.json()["detail"]["what"]


def test_a_person_may_say_which_body_is_the_patient(therapist, session):
    answer = therapist.post(f"/api/sessions/{session['id']}/follow", json={"sensor": "left", "body": "3"})
    assert answer.status_code == 200


@pytest.mark.parametrize("route", ["control", "follow", "end"])
def test_a_session_that_is_not_open_cannot_be_controlled(therapist, session, route):
    form = {"control": {"action": "start"}, "follow": {"sensor": "a", "body": "b"}, "end": {}}[route]
    assert therapist.post(f"/api/sessions/{session['id'] + 1}/{route}", json=form).status_code == 409


def test_a_game_runs_while_the_arm_is_engaged(shared, therapist, session):
    assert shared.service.therapy.view().phase == "preparing"
    control(therapist, session, "start")
    picture = until(lambda: shared.service.therapy.opened(session["id"]).picture)
    assert picture.game == "reach"
    until(lambda: shared.service.therapy.opened(session["id"]).picture.time_left_s < picture.time_left_s)
    assert shared.service.therapy.view().phase == "running"


def test_sr7_a_stop_goes_through_whatever_session_a_page_names(therapist, session):
    control(therapist, session, "start")
    answer = therapist.post(f"/api/sessions/{session['id'] + 1}/control", json={"action": "stop"})
    assert answer.json()["state"] == "stopped"


def test_sr8_a_stop_waits_for_no_database(alone, person, enrol, look):
    look(person)
    session = opened(person, enrol(person)).json()
    control(person, session, "start")
    other = sqlite3.connect(alone.data / "mirrorlimb.sqlite", isolation_level=None)
    other.execute("BEGIN EXCLUSIVE")
    assert control(person, session, "stop").json()["state"] == "stopped"
    assert person.get("/api/patients").status_code == 503, "the database was locked all the while"
    other.execute("ROLLBACK")
    other.close()


# ---------------------------------------------------------------- when something dies


def test_a_station_that_dies_interrupts_the_session_and_enables_nothing(alone, person, enrol):
    session = opened(person, enrol(person, "dies")).json()
    answer = control(person, session, "start")
    assert answer.status_code == 409
    station = until(lambda: (found := person.get("/api/station").json())["up"] and found)
    assert (station["restarts"], station["state"]) == (1, "off")
    again = control(person, session, "start")
    assert again.status_code == 409
    assert "restarted" in again.json()["detail"]["what"]
    ended = end(person, session).json()
    assert (ended["status"], ended["measured"]) == ("interrupted", True)
    events = person.get(f"/api/sessions/{session['id']}/events").json()
    assert any(event["kind"] == "interrupted" and "caught fire" in event["text"] for event in events)


def test_a_station_that_is_killed_comes_back_off(alone, person, enrol):
    first = alone.service.link.station_pid
    os.kill(first, signal.SIGKILL)
    until(lambda: alone.service.link.station_pid not in (None, first))
    until(lambda: person.get("/api/station").json()["up"])
    assert person.get("/api/station").json()["state"] == "off"
    assert opened(person, enrol(person)).status_code == 201


def test_a_station_that_does_not_answer_is_reported(alone, person, enrol, monkeypatch):
    monkeypatch.setattr("server.api.station_link.ANSWER_WITHIN_S", 0.1)
    monkeypatch.setattr("server.api.therapy.CLOSED_WITHIN_S", 0.1)
    session = opened(person, enrol(person, "mute")).json()
    answer = control(person, session, "start")
    assert answer.status_code == 409
    assert "answer" in answer.json()["detail"]["what"]
    assert end(person, session).json()["status"] == "ended"


@pytest.fixture
def left_open(tmp_path, serving, logged_in, enrol, look):
    """A session in mid-game whose service was ended."""
    with serving(tmp_path) as first, logged_in(first) as person:
        page = look(person)
        session = opened(person, enrol(person)).json()
        control(person, session, "start")
        until(lambda: page.post(f"/api/sessions/{session['id']}/game", wish="start").is_success)
        time.sleep(0.5)
        page.close()
    return session


def spoil(games):
    games.write_bytes(b"no games")


@pytest.mark.parametrize("spoilt", [None, spoil, Path.unlink], ids=["whole", "spoilt games", "no games"])
def test_a_session_that_a_crash_left_open_is_measured_at_the_next_start(
    tmp_path, serving, logged_in, left_open, spoilt
):
    session = left_open
    if spoilt is not None:
        spoilt(tmp_path / "recordings" / f"session-{session['id']:06d}.game")
    with serving(tmp_path) as second, logged_in(second) as person:
        recovered = until(lambda: (found := person.get(f"/api/sessions/{session['id']}").json())["measured"] and found)
        assert recovered["status"] == "interrupted"
        assert recovered["ended_at"] > recovered["started_at"]
        assert recovered["metrics"]
        assert [one["game"] for one in recovered["played"]] == (["reach"] if spoilt is None else [])
        assert person.get("/api/sessions/current").json() is None


def test_a_game_that_fails_when_it_is_played_again_costs_its_own_figures_alone(
    tmp_path, serving, logged_in, left_open, monkeypatch
):
    def mistaken(*_, **__):
        raise ZeroDivisionError("a game's own")

    monkeypatch.setattr("games.programme.Programme.step", mistaken)
    with serving(tmp_path) as second, logged_in(second) as person:
        path = f"/api/sessions/{left_open['id']}"
        recovered = until(lambda: (found := person.get(path).json())["measured"] and found)
        assert recovered["metrics"]
        assert recovered["played"] == []


@pytest.fixture
def impatient(monkeypatch):
    """A database that waits for nobody."""
    monkeypatch.setattr("db.sqlite._PRAGMAS", ("PRAGMA busy_timeout = 20", "PRAGMA journal_mode = WAL"))


def test_a_database_that_refuses_the_end_loses_nothing(impatient, alone, person, enrol):
    session = opened(person, enrol(person)).json()
    control(person, session, "start")
    other = sqlite3.connect(alone.data / "mirrorlimb.sqlite", isolation_level=None)
    other.execute("BEGIN EXCLUSIVE")
    answer = end(person, session)
    other.execute("ROLLBACK")
    other.close()
    assert answer.status_code == 503
    assert person.get("/api/sessions/current").json()["id"] == session["id"]
    ended = end(person, session, pain_after=4).json()
    assert (ended["status"], ended["measured"], ended["pain_after"]) == ("ended", True, 4)


def test_a_recording_that_cannot_be_read_is_said_and_the_session_kept(alone, person, enrol):
    session = opened(person, enrol(person)).json()
    (recording,) = (alone.data / "recordings").glob("*.mcap")
    recording.unlink()
    ended = end(person, session).json()
    assert (ended["status"], ended["measured"]) == ("ended", False)
    kinds = until(lambda: [event["kind"] for event in person.get(f"/api/sessions/{session['id']}/events").json()])
    assert "ended" in kinds
    answer = person.get(f"/api/sessions/{session['id']}/curves")
    assert answer.status_code == 422
    assert str(recording.name) in answer.json()["detail"]["what"]


def test_an_error_of_ours_in_measuring_still_ends_the_session(monkeypatch, alone, person, enrol):
    session = opened(person, enrol(person)).json()

    def broken(*_):
        raise ZeroDivisionError("a mean of nothing")

    monkeypatch.setattr("server.api.figures.measure", broken)
    answer = end(person, session)
    assert (answer.status_code, answer.json()["status"], answer.json()["measured"]) == (200, "ended", False)
