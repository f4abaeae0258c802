"""Replay: any instant of a recorded session in a view of its own, and never while somebody is treated."""

import time
from datetime import UTC, datetime, timedelta

import msgspec
import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from websockets.exceptions import InvalidStatus

from db.account import Role
from db.queries import accounts
from db.therapy_session import Event
from fusion.errors import RefusedError
from fusion.recording.log import LogAbout, LogWriter
from server.api import replay3d
from server.api.auth import COOKIE
from server.api.replay3d_clock import ReplayClock
from server.api.replay3d_forms import StateSpan
from server.api.replay3d_frames import KEPT_EVERY_S, LONGEST_GAP_S, Frames, SensorFrames, read_frames
from server.api.replay3d_marks import marks_of, spans_of
from server.messages import DriveState

SOME_S = 0.6
"""Of therapy, so that there is something to see."""
START = datetime(2026, 5, 4, 9, 0, tzinfo=UTC)

# ---------------------------------------------------------------- the clock


moments = st.floats(0, 1000)


@given(moments, moments, st.floats(0.1, 8), st.booleans())
def test_a_clock_never_leaves_the_session(position_s, later_s, speed, playing):
    clock = ReplayClock(60.0, 0.0).changed(5.0, position_s, playing, speed)
    assert 0.0 <= clock.at(5.0 + later_s) <= 60.0


@given(st.floats(0, 60), st.floats(0, 10), st.floats(0.1, 8), st.floats(0.1, 8))
def test_another_speed_does_not_jump(position_s, later_s, before, after):
    clock = ReplayClock(60.0, 0.0).changed(0.0, position_s, True, before)
    assert clock.changed(later_s, None, True, after).at(later_s) == pytest.approx(clock.at(later_s))


def test_a_paused_clock_stands_and_one_at_the_end_plays_no_more():
    paused = ReplayClock(60.0, 0.0).changed(0.0, 12.0, False, 1.0)
    assert (paused.at(100.0), paused.plays(100.0)) == (12.0, False)
    running = paused.changed(0.0, None, True, 2.0)
    assert (running.at(10.0), running.plays(10.0)) == (32.0, True)
    assert (running.at(30.0), running.plays(30.0)) == (60.0, False)


# ---------------------------------------------------------------- pictures and marks


def frames(t_s, states=None, x_m=None):
    """A body that is at x_m in all its joints."""
    x_m = np.zeros(len(t_s)) if x_m is None else np.array(x_m)
    place = np.zeros((len(t_s), 1, 3), np.float32)
    place[:, 0, 0] = x_m
    return Frames(
        t_s=np.array(t_s, float),
        state=tuple(states or [DriveState.ENGAGED] * len(t_s)),
        sensors=(SensorFrames("left", np.repeat(place, 25, axis=1), place[:, 0]),),
        body=np.repeat(place, 25, axis=1),
        mirrored=np.repeat(place, 4, axis=1),
        exo=np.repeat(place, 4, axis=1),
    )


@given(st.floats(0, 0.12))
def test_between_two_pictures_the_body_is_on_the_straight_line(t_s):
    moving = frames([0.0, 0.04, 0.08, 0.12], x_m=[0.0, 0.04, 0.08, 0.12])
    assert moving.at(t_s).body[:, 0] == pytest.approx(t_s, abs=1e-6)
    assert moving.at(t_s).sensors[0].joints[:, 0] == pytest.approx(t_s, abs=1e-6)


def test_across_a_hole_nothing_is_made_up():
    torn = frames([0.0, 3 * LONGEST_GAP_S], x_m=[0.0, 1.0])
    assert torn.at(2 * LONGEST_GAP_S).body[0, 0] == 0.0
    assert torn.at(3 * LONGEST_GAP_S).body[0, 0] == 1.0


def test_a_joint_that_one_picture_lacks_is_not_drawn_from_half_of_it():
    half = frames([0.0, 0.04], x_m=[0.0, np.nan])
    assert np.isnan(half.at(0.02).body[0, 0])
    assert half.at(0.0).body[0, 0] == 0.0


def written(folder, ticks):
    """A recording of ticks that hold what is drawn and no more."""
    path = folder / "some.mcap"
    with LogWriter(path, LogAbout(name="some")) as log:
        for tick in ticks:
            log.tick(msgspec.msgpack.encode(tick), tick["t_s"])
    return path


def tick_at(t_s, *sensors):
    seen = [{"sensor": name, "position_in_room": None, "joints_in_room": [(t_s, 0.0, 0.0)] * 25} for name in sensors]
    arm = {"valid": False, "points_in_room": None}
    return {"t_s": t_s, "state": "ready", "sensors": seen, "body": None, "target": None, "affected": arm}


def test_a_sensor_that_comes_later_or_goes_is_nowhere_until_then_and_after(tmp_path):
    ticks = [tick_at(1.0, "left"), tick_at(1.1, "left", "right"), tick_at(1.2, "right")]
    frames = read_frames(written(tmp_path, ticks), lambda: True)
    left, right = frames.sensors
    assert left.joints[:, 0, 0] == pytest.approx([1.0, 1.1, np.nan], nan_ok=True)
    assert right.joints[:, 0, 0] == pytest.approx([np.nan, 1.1, 1.2], nan_ok=True)
    assert frames.t_s == pytest.approx([0.0, 0.1, 0.2])
    assert np.isnan(frames.at(0.1).exo).all()


def test_a_recording_is_thinned_evenly(tmp_path):
    frames = read_frames(written(tmp_path, [tick_at(k / 100, "left") for k in range(1000)]), lambda: True)
    assert np.diff(frames.t_s) == pytest.approx(KEPT_EVERY_S, abs=0.011)


READY, ENGAGED, HOLD = DriveState.READY, DriveState.ENGAGED, DriveState.HOLD


def test_the_states_fill_the_session_without_a_hole():
    spans = spans_of(frames([0.0, 1.0, 2.0, 3.0, 4.0], [READY, READY, ENGAGED, HOLD, HOLD]))
    assert [(span.state, span.from_s, span.to_s) for span in spans] == [
        (READY, 0.0, 2.0),
        (ENGAGED, 2.0, 3.0),
        (HOLD, 3.0, 4.0),
    ]


def event(seconds, kind, text="", **data):
    return Event(session_id=1, t=START + timedelta(seconds=seconds), kind=kind, text=text, data=data)


def test_hits_misses_and_pain_lie_where_the_recording_has_them():
    """The recording began 3 s after the session was stored; the change of state that both tell of says so."""
    spans = [StateSpan(state=READY, from_s=0.0, to_s=2.0), StateSpan(state=ENGAGED, from_s=2.0, to_s=20.0)]
    events = [
        event(5.0, "state", before="ready", after="engaged"),
        event(6.0, "score", "hit", hits=1, misses=0),
        event(9.0, "score", "missed", hits=1, misses=1),
        event(10.0, "control", "pain"),
        event(11.0, "control", "hold"),
        event(99.0, "score", "hit", hits=2, misses=1),
    ]
    marks = marks_of(events, spans, START)
    assert [(mark.kind, mark.t_s) for mark in marks] == [("hit", 3.0), ("missed", 6.0), ("pain", 7.0)]


def test_every_exercise_counts_anew_and_its_beginning_is_no_attempt():
    spans = [StateSpan(state=READY, from_s=0.0, to_s=20.0)]
    events = [
        event(1.0, "score", "hit", exercise=1, hits=1, misses=0),
        event(2.0, "score", "hit", exercise=1, hits=2, misses=0),
        event(3.0, "score", "", exercise=2, hits=0, misses=0),
        event(4.0, "score", "hit", exercise=2, hits=1, misses=0),
        event(5.0, "score", "missed", exercise=2, hits=1, misses=1),
    ]
    marks = marks_of(events, spans, START)
    assert [(mark.kind, mark.t_s) for mark in marks] == [("hit", 1.0), ("hit", 2.0), ("hit", 4.0), ("missed", 5.0)]


def test_without_a_change_of_state_the_opening_counts():
    spans = [StateSpan(state=READY, from_s=0.0, to_s=20.0)]
    marks = marks_of([event(6.0, "control", "pain")], spans, START)
    assert [mark.t_s for mark in marks] == [6.0]


# ---------------------------------------------------------------- the real thing


def until(condition):
    """Wait for something that happens in another process."""
    for _ in range(400):
        found = condition()
        if found:
            return found
        time.sleep(0.025)
    return pytest.fail("it did not happen")


@pytest.fixture
def open_session(shared, therapist, new_patient, look):
    """Opens a session with the arm engaged; ended afterwards if it was not."""
    page = look(therapist)

    def opened():
        form = {"patient_id": new_patient("Replayed")["id"], "confirmed_affected_side": "left"}
        number = therapist.post("/api/sessions", json=form).raise_for_status().json()["id"]
        control(therapist, number, "start")
        until(lambda: page.messages and page.messages[-1]["tick"]["state"] == "engaged")
        return number

    yield opened
    current = therapist.get("/api/sessions/current").json()
    if current:
        end(therapist, current["id"])


def control(client, number, action):
    client.post(f"/api/sessions/{number}/control", json={"action": action}).raise_for_status()


def end(client, number):
    client.post(f"/api/sessions/{number}/end", json={}).raise_for_status()


@pytest.fixture
def treated(shared, therapist, open_session):
    """The number of a session that has ended, and in which it hurt."""
    number = open_session()
    time.sleep(SOME_S)
    control(therapist, number, "pain")
    until(lambda: therapist.get("/api/station").json()["state"] == "hold")
    time.sleep(SOME_S)
    end(therapist, number)
    return number


def play(client, number, **more):
    return client.put("/api/replay", json={"session_id": number, **more})


def test_a_past_session_is_shown_as_it_was(shared, therapist, treated, visers_page):
    shown = play(therapist, treated, t_s=0.0, speed=0.5).raise_for_status().json()
    assert (shown["session_id"], shown["playing"], shown["speed"]) == (treated, True, 0.5)
    assert shown["duration_s"] >= SOME_S
    with visers_page(shared, therapist, "/replay3d") as page:
        page.look()
        page.wait_until_moved({"/fused/bones", "/exoskeleton", "/sensors/0/bones"})
    assert "<title>Viser</title>" in therapist.get("/replay3d/").text


def test_every_sensor_has_a_place_in_every_picture(shared, treated):
    frames = read_frames(shared.data / f"recordings/session-{treated:06d}.mcap", lambda: True)
    assert [one.sensor for one in frames.sensors] == ["left"]
    assert frames.sensors[0].joints.shape == frames.body.shape == (len(frames.t_s), 25, 3)
    assert frames.sensors[0].place.shape == (len(frames.t_s), 3)
    assert np.diff(frames.t_s).min() > KEPT_EVERY_S / 2
    assert np.isfinite(frames.body).all()


def test_its_time_line_says_when_the_arm_moved_was_held_and_hurt(therapist, treated):
    play(therapist, treated, playing=False).raise_for_status()
    line = therapist.get("/api/replay/timeline").json()
    states = [span["state"] for span in line["spans"]]
    assert states[states.index("engaged") + 1] == "hold"
    held = line["spans"][states.index("hold")]
    assert held["to_s"] - held["from_s"] >= SOME_S / 2
    pain = [mark["t_s"] for mark in line["marks"] if mark["kind"] == "pain"]
    assert pain == pytest.approx([held["from_s"]], abs=0.3)


def test_a_person_scrubs_and_pauses(therapist, treated):
    play(therapist, treated, t_s=0.3, playing=False).raise_for_status()
    standing = therapist.get("/api/replay").json()
    assert (standing["t_s"], standing["playing"]) == (0.3, False)
    beyond = play(therapist, treated, t_s=1e6, playing=True).json()
    assert (beyond["t_s"], beyond["playing"]) == (beyond["duration_s"], False)


def test_while_a_session_is_open_nothing_is_replayed(therapist, treated, open_session):
    play(therapist, treated).raise_for_status()
    open_session()
    refused = play(therapist, treated)
    assert refused.status_code == 409
    assert "needed for the arm" in refused.json()["detail"]["what"]
    assert until(lambda: therapist.get("/api/replay").json() is None)
    assert therapist.get("/api/replay/timeline").json() is None
    assert therapist.get("/replay3d/").status_code == 502


def test_the_patients_screen_sees_no_past_session(shared, therapist, treated, visers_page):
    play(therapist, treated).raise_for_status()
    with shared.client(cookies={COOKIE: log_in_of(shared.service, Role.SCREEN)}) as screen:
        paths = ["/api/replay", "/api/replay/timeline", "/replay3d", "/replay3d/"]
        assert {path: screen.get(path).status_code for path in paths} == dict.fromkeys(paths, 403)
        with pytest.raises(InvalidStatus) as refused, visers_page(shared, screen, "/replay3d"):
            pass
        assert refused.value.response.status_code == 403
        with visers_page(shared, screen, "/view3d") as live:
            assert live.socket.subprotocol


def log_in_of(service, role):
    with service.database.session() as session:
        account = accounts.find_account(session, role) or accounts.add_account(session, role, None, role)
    return service.auth.open_login(account)


def test_a_session_that_opens_while_a_recording_is_read_ends_the_reading(shared, treated):
    recording = shared.data / f"recordings/session-{treated:06d}.mcap"
    with pytest.raises(RefusedError, match="put away"):
        read_frames(recording, lambda: False)


def test_what_nobody_looks_at_is_put_away(shared, therapist, treated, monkeypatch):
    monkeypatch.setattr(replay3d, "UNUSED_S", 0.2)
    play(therapist, treated).raise_for_status()
    assert until(lambda: therapist.get("/api/replay").json() is None)
    assert shared.service.replay.port == 0


def test_another_session_takes_the_place_of_the_first(therapist, treated, open_session):
    play(therapist, treated).raise_for_status()
    other = open_session()
    time.sleep(SOME_S)
    end(therapist, other)
    assert play(therapist, other).raise_for_status().json()["session_id"] == other
    assert therapist.get("/api/replay/timeline").json()["session_id"] == other


def test_what_cannot_be_shown_is_refused_in_words(shared, therapist, treated):
    assert play(therapist, 999_999).status_code == 404
    assert play(therapist, treated, speed=100).status_code == 422
    (shared.data / f"recordings/session-{treated:06d}.mcap").write_bytes(b"not a recording")
    broken = play(therapist, treated)
    assert broken.status_code == 422
    assert broken.json()["detail"]["remedy"]
