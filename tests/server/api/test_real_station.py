"""The service with the real station, the virtual patient and real datagrams: a session as a newcomer sees it."""

import json
import time

import pytest
from websockets.sync.client import connect

from server.api.auth import COOKIE
from server.api.station_link import STATION
from server.config import Config, SensorsConfig, StationConfig

FREE_PORTS = dict.fromkeys(SensorsConfig().ports, 0)
DEMO = Config(demo=True, station=StationConfig(sensors=SensorsConfig(ports=FREE_PORTS)))
START_WITHIN_S, PLAY_S = 40.0, 4.0


@pytest.fixture
def demonstration(tmp_path, serving):
    with serving(tmp_path, station=STATION, config=DEMO) as service:
        yield service


@pytest.fixture
def newcomer(demonstration):
    with demonstration.client() as client:
        yield client


def messages(service, client):
    """Live messages, each acknowledged as soon as it is read."""
    headers = {"Cookie": f"{COOKIE}={client.cookies[COOKIE]}"}
    with connect(f"{service.ws_url}/api/stream", additional_headers=headers, origin=service.url) as socket:
        while True:
            message = json.loads(socket.recv(timeout=10))
            socket.send(json.dumps({"ack": message["tick"]["index"]}))
            yield message


def test_a_newcomer_plays_and_the_figures_stay(demonstration, newcomer):
    patient = newcomer.post("/api/demo").raise_for_status().json()["patient"]
    form = {"patient_id": patient["id"], "confirmed_affected_side": "left"}
    session = newcomer.post("/api/sessions", json=form).raise_for_status().json()
    stream, began_s = messages(demonstration, newcomer), time.monotonic()
    for message in stream:
        if message["tick"]["may_enable"]:
            break
        assert time.monotonic() - began_s < START_WITHIN_S, message["tick"]["blockers"]
    control = f"/api/sessions/{session['id']}/control"
    assert newcomer.post(control, json={"action": "start"}).json()["state"] == "engaged"
    played = play(stream)
    assert newcomer.post(control, json={"action": "stop"}).json()["state"] == "stopped"
    stream.close()
    assert {message["game"]["phase"] for message in played} == {"playing"}
    assert len({message["tick"]["affected"]["elbow_rad"] for message in played}) > 10
    assert {view["sensor"] for message in played for view in message["tick"]["sensors"]} >= {"127.0.1.1", "127.0.1.2"}
    ended = newcomer.post(f"/api/sessions/{session['id']}/end", json={"pain_after": 0}).json()
    assert ended["measured"] is True
    figures = {metric["name"]: metric["value"] for metric in ended["metrics"] if not metric["joint"]}
    assert figures["time_engaged"] > PLAY_S / 2
    curves = newcomer.get(f"/api/sessions/{session['id']}/curves").json()
    assert "engaged" in curves["state"]


def play(stream):
    played = [next(message for message in stream if message["game"])]
    end_s = played[0]["tick"]["t_s"] + PLAY_S
    while played[-1]["tick"]["t_s"] < end_s:
        played.append(next(stream))
    return played


def test_a_sender_alone_moves_nothing(demonstration, newcomer):
    newcomer.post("/api/demo").raise_for_status()
    stream = messages(demonstration, newcomer)
    for message in stream:
        if message["tick"]["timing"]["datagrams"]:
            break
    states = {next(stream)["tick"]["state"] for _ in range(50)}
    stream.close()
    assert states == {"off"}
