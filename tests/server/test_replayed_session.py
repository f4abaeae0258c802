"""Real Kinect skeletons, as real OSC over real UDP in real time, through a whole session into the database."""

from __future__ import annotations

import sqlite3
import subprocess
import sys
import time
from contextlib import closing
from pathlib import Path
from typing import Any

import httpx
import pytest

from fusion.recording.reader import read_recording

pytestmark = pytest.mark.recordings

NAME, PASSWORD = "Dr. Lin", "three quiet herons"


def replay(recording: Path, port: int) -> subprocess.Popen[bytes]:
    command = [str(Path(sys.executable).with_name("mirrorlimb")), "replay", recording, "--to", f"127.0.0.1:{port}"]
    return subprocess.Popen([*command, "--dialect", "kinectv2-osc"], stdout=subprocess.DEVNULL)


def enrolled(client: httpx.Client) -> dict[str, Any]:
    client.post("/api/setup", json={"name": NAME, "password": PASSWORD}).raise_for_status()
    return client.post("/api/patients", json={"name": "P-01", "healthy_side": "left"}).raise_for_status().json()


def opened_session(client: httpx.Client, patient: dict[str, Any]) -> int:
    form = {"patient_id": patient["id"], "confirmed_affected_side": "right", "pain_before": 1}
    return client.post("/api/sessions", json=form).raise_for_status().json()["id"]


def attend(client: httpx.Client, session: int, sender: subprocess.Popen[bytes]) -> set[str]:
    """Press start as soon as it is accepted, and resume after a hold, as a therapist would; returns the states seen."""
    wanted = {"ready": "start", "hold": "resume"}
    seen = set()
    while sender.poll() is None:
        state = client.get("/api/station").raise_for_status().json()["state"]
        seen.add(state)
        if state in wanted:
            answer = client.post(f"/api/sessions/{session}/control", json={"action": wanted[state]})
            assert answer.status_code in (200, 409), answer.text
        time.sleep(0.2)
    return seen


def test_a_real_recording_becomes_a_stored_session(start_service, recordings: Path, look, sign) -> None:
    service = start_service()
    page = {"Mirrorlimb-Client": "dashboard"}
    with httpx.Client(base_url=service.address, timeout=20, trust_env=False, headers=page) as client:
        patient = sign(client, enrolled(client))
        look(client, "dashboard")
        session = opened_session(client, patient)
        port = client.get("/api/station").raise_for_status().json()["ports"]["kinectv2-osc"]
        sender = replay(recordings / "dual-kinect-study01-obstacle", port)
        seen = attend(client, session, sender)
        assert sender.returncode == 0
        assert "engaged" in seen, seen
        detail = client.post(f"/api/sessions/{session}/end", json={"pain_after": 1}).raise_for_status().json()
        curves = client.get(f"/api/sessions/{session}/curves").raise_for_status().json()

    assert detail["status"] == "ended"
    names = {metric["name"] for metric in detail["metrics"]}
    assert {"range_of_movement", "time_engaged", "trunk_displacement"} <= names, sorted(names)
    assert any(state == "engaged" for state in curves["state"])
    assert sum(angle is not None for angle in curves["healthy_rad"]["elevation"]) > 50

    with closing(sqlite3.connect(service.data / "mirrorlimb.sqlite")) as database:
        stored = database.execute("SELECT count(*) FROM metric WHERE session_id = ?", (session,)).fetchone()[0]
    assert stored == len(detail["metrics"]) > 0

    kept = read_recording(next(service.data.rglob("*.mcap")))
    assert {len(stream.samples) > 300 for stream in kept.skeleton_streams} == {True}
    assert len(kept.skeleton_streams) == 2
