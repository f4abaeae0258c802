"""The service with the real station, the virtual patient and real datagrams: a session as a newcomer sees it."""

import time

import pytest

from server.api.station_link import STATION
from server.config import Config, SensorsConfig, StationConfig

FREE_PORTS = dict.fromkeys(SensorsConfig().ports, 0)
DEMO = Config(demo=True, station=StationConfig(sensors=SensorsConfig(ports=FREE_PORTS)))
START_WITHIN_S, PLAY_S = 60.0, 4.0


@pytest.fixture
def demonstration(tmp_path, serving):
    with serving(tmp_path, station=STATION, config=DEMO) as service:
        yield service


@pytest.fixture
def newcomer(demonstration):
    with demonstration.client() as client:
        yield client


@pytest.fixture
def page(demonstration, newcomer, look):
    """The demonstration's page, in charge of a session whose arm may be enabled."""
    patient = newcomer.post("/api/demo").raise_for_status().json()["patient"]
    opened = look(newcomer)
    form = {"patient_id": patient["id"], "confirmed_affected_side": "left"}
    session = opened.post("/api/sessions", **form).raise_for_status().json()
    opened.path = f"/api/sessions/{session['id']}"
    until(opened, lambda tick: tick["may_enable"])
    return opened


def until(page, condition):
    """The first tick from now on that fulfils it."""
    seen, end_s = len(page.messages), time.monotonic() + START_WITHIN_S
    while time.monotonic() < end_s:
        for message in page.messages[seen:]:
            if condition(message["tick"]):
                return message["tick"]
        time.sleep(0.02)
    tick = page.messages[-1]["tick"]
    return pytest.fail(f"it did not happen; {tick['state']}: {tick['reason']} {tick['blockers']}")


def press(page, action):
    return page.post(f"{page.path}/control", action=action)


def play(page):
    """The arm moves for a while; whatever a busy machine holds is resumed."""
    press(page, "start").raise_for_status()
    moved_s = before_s = 0.0
    while moved_s < PLAY_S:
        tick = until(page, lambda tick, seen_s=before_s: tick["t_s"] > seen_s)
        if tick["state"] == "hold":
            press(page, "resume")
        moved_s += min(tick["t_s"] - before_s, 0.1) * (tick["state"] == "engaged")
        before_s = tick["t_s"]


def test_a_newcomer_plays_and_the_figures_stay(page):
    play(page)
    assert press(page, "stop").json()["state"] == "stopped"
    played = [message for message in page.messages if message["game"]]
    assert {"waiting"} <= {message["game"]["phase"] for message in played} <= {"waiting", "playing"}
    assert len({message["tick"]["affected"]["elbow_rad"] for message in played}) > 10
    assert {view["sensor"] for message in played for view in message["tick"]["sensors"]} >= {"127.0.1.1", "127.0.1.2"}
    ended = page.post(f"{page.path}/end", pain_after=0).json()
    assert ended["measured"] is True
    figures = {metric["name"]: metric["value"] for metric in ended["metrics"] if not metric["joint"]}
    assert figures["time_engaged"] > PLAY_S / 2
    curves = page.client.get(f"{page.path}/curves").json()
    assert "engaged" in curves["state"]


def test_sr11_the_therapists_pulled_page_is_a_hold_until_another_has_taken_over(page, demonstration, newcomer, look):
    other = look(newcomer, "second")
    other.path = page.path
    press(page, "start").raise_for_status()
    page.pull()
    until(other, lambda tick: tick["state"] == "hold" and not tick["authority"])
    refused = press(other, "resume")
    assert refused.status_code == 409
    assert "another page of yours is in charge" in refused.json()["detail"]["what"]
    other.post(f"{page.path}/authority").raise_for_status()
    held = until(other, lambda tick: tick["authority"] == "demo")
    assert held["state"] == "hold"
    until(other, lambda tick: press(other, "resume").is_success)


def test_a_sender_alone_moves_nothing(demonstration, newcomer, look):
    newcomer.post("/api/demo").raise_for_status()
    looking = look(newcomer)
    until(looking, lambda tick: tick["timing"]["datagrams"])
    seen = len(looking.messages)
    until(looking, lambda tick: len(looking.messages) > seen + 50)
    assert {message["tick"]["state"] for message in looking.messages} == {"off"}


def test_a_session_without_sensors_cannot_begin_says_why_and_ends_with_nothing_lost(
    serving, tmp_path, enrol, logged_in, look
):
    silent = Config(station=StationConfig(sensors=SensorsConfig(ports=FREE_PORTS)))
    with serving(tmp_path, station=STATION, config=silent) as service, logged_in(service) as therapist:
        page = look(therapist)
        form = {"patient_id": enrol(therapist)["id"], "confirmed_affected_side": "left", "pain_before": 3}
        session = page.post("/api/sessions", **form).raise_for_status().json()
        page.path = f"/api/sessions/{session['id']}"
        blockers = until(page, lambda tick: tick["blockers"])["blockers"]
        assert any("sensor" in blocker for blocker in blockers), blockers
        refused = press(page, "start")
        assert refused.status_code == 409
        assert "sensor" in refused.json()["detail"]["what"]
        assert page.post(f"{page.path}/game", wish="start").status_code == 409
        shown = therapist.get(f"{page.path}/workspace").json()
        assert (shown["seen_s"], shown["enough"]) == (0.0, False)
        ended = page.post(f"{page.path}/end", pain_after=3).raise_for_status().json()
        page.close()
    assert (ended["status"], ended["played"], ended["pain_before"], ended["measured"]) == ("ended", [], 3, True)
