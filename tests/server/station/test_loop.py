"""The loop, cranked by hand with a virtual patient: what a session does from opening to closing."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace
from pathlib import Path
from time import monotonic, sleep

import numpy as np
import pytest
from hand_cranked import DT_S, HandCranked
from station_samples import patient_limits

from fusion.messages import Packet
from fusion.recording.reader import read_recording
from fusion.skeleton import Side
from fusion.virtual_patient.anatomy import ArmPose
from fusion.virtual_patient.patient import PoseGoal, VirtualPatient
from fusion.virtual_patient.trial import sensors_for
from server.messages import (
    Assistance,
    CloseSession,
    DriveState,
    Enable,
    FollowBody,
    Hold,
    LiveTick,
    OpenSession,
    Pain,
    Reset,
    Resume,
    SessionClosed,
    SetAssistance,
    StateChanged,
    Stop,
    Warned,
    Wish,
    WishAnswer,
)
from server.station.demonstration import Demonstration

RAISED = PoseGoal(ArmPose(plane_rad=1.1, elevation_rad=1.0, rotation_rad=0.3, elbow_rad=1.2))
PATIENCE_S = 30.0


def engaged() -> HandCranked:
    rig = HandCranked()
    assert rig.open().accepted
    rig.run(4.0)
    assert rig.ask(Enable).accepted, rig.last.blockers
    return rig


def tick_until(rig: HandCranked, done: Callable[[], bool]) -> None:
    """Turn the crank until something is done, no faster than life: the recorder's thread needs its turns."""
    ends_s = monotonic() + PATIENCE_S
    while not done() and monotonic() < ends_s:
        rig.tick()
        sleep(DT_S)


@pytest.fixture(scope="module")
def session() -> HandCranked:
    """Five seconds engaged, with the healthy arm raised after two."""
    rig = engaged()
    rig.run(2.0)
    rig.goal = RAISED
    rig.run(3.5)
    return rig


def _joints(tick: LiveTick) -> np.ndarray:
    assert tick.target is not None
    return np.array([tick.target.plane_rad, tick.target.elevation_rad, tick.target.elbow_rad])


def test_the_exoskeleton_goes_where_the_mirrored_healthy_arm_is(session: HandCranked) -> None:
    assert session.last.state is DriveState.ENGAGED
    measured = np.array([tick.exo.angle_rad for tick in session.ticks[-100:]])[:, [0, 1, 3]]
    wanted = np.array([_joints(tick) for tick in session.ticks[-100:]])
    assert np.abs((wanted - measured).mean(axis=0)).max() < 0.1
    assert session.last.exo.angle_rad[1] > 0.8


def test_the_affected_arm_is_the_mirror_image_of_the_healthy_one(session: HandCranked) -> None:
    assert session.last.healthy is not None
    healthy, affected = (np.array(arm.points_in_trunk) for arm in (session.last.healthy, session.last.affected))
    assert np.abs(affected[3] * [-1, 1, 1] - healthy[3]).max() < 0.12


def test_every_tick_says_how_old_its_newest_datagram_was(session: HandCranked) -> None:
    ages = [t for tick in session.ticks if (t := tick.timing.datagram_to_command_s) is not None]
    assert ages
    assert all(0 < age < 0.05 for age in ages)


def test_sensors_body_and_arms_are_shown(session: HandCranked) -> None:
    tick = session.last
    assert {(sensor.sensor, sensor.dialect, sensor.aligned) for sensor in tick.sensors} == {
        ("s1", "kinectv2-osc", True),
        ("s2", "kinectv2-osc", True),
    }
    assert all(len(sensor.joints_in_room) == 25 for sensor in tick.sensors)
    assert tick.body is not None
    assert len(tick.body.joints_in_room) == len(tick.body.bound_m) == len(tick.body.shape_m2) == 25


def test_state_changes_are_told_in_order(session: HandCranked) -> None:
    changes = [(change.before, change.after) for change in session.told(StateChanged)]
    assert changes[:2] == [(DriveState.OFF, DriveState.READY), (DriveState.READY, DriveState.ENGAGED)]


def test_sr4_sr5_a_silence_of_both_sensors_holds_and_a_short_one_ends_by_itself() -> None:
    rig = engaged()
    rig.run(1.0)
    rig.seeing = [False, False]
    assert rig.run(0.12).state is DriveState.HOLD
    assert "No sensor" in rig.last.reason
    rig.run(0.5)
    rig.seeing = [True, True]
    assert rig.run(0.6).state is DriveState.ENGAGED


def test_sr5_after_a_long_silence_a_person_resumes() -> None:
    rig = engaged()
    rig.seeing = [False, False]
    rig.run(4.0)
    rig.seeing = [True, True]
    assert rig.run(2.0).state is DriveState.HOLD
    assert rig.ask(Resume).accepted, rig.last.blockers
    assert rig.last.state is DriveState.ENGAGED


def test_sr4_one_silent_sensor_does_not_stop_the_session() -> None:
    rig = engaged()
    rig.seeing = [False, True]
    states = {rig.tick().state for _ in range(150)}
    assert states == {DriveState.ENGAGED}


def test_sr9_a_silent_service_holds_within_its_time() -> None:
    rig = engaged()
    rig.beating = False
    rig.run(0.24)
    assert rig.last.state is DriveState.ENGAGED
    rig.run(0.03)
    assert rig.last.state is DriveState.HOLD
    rig.beating = True
    assert rig.run(1.0).state is DriveState.HOLD


def test_sr11_an_arm_whose_person_in_charge_is_gone_holds_until_a_person_resumes() -> None:
    rig = engaged()
    assert rig.last.authority == "therapist"
    rig.authority = ""
    assert rig.tick().state is DriveState.HOLD
    assert (rig.last.authority, rig.last.reason) == ("", "Nobody who is in charge is connected.")
    rig.run(1.0)
    assert "in charge" in rig.ask(Resume).reason
    rig.authority = "another"
    assert rig.run(1.0).state is DriveState.HOLD
    assert rig.ask(Resume).accepted, rig.last.blockers


def test_sr11_nobody_in_charge_enables_nothing() -> None:
    rig = HandCranked()
    rig.authority = ""
    rig.open()
    rig.run(4.0)
    assert rig.last.blockers == ("Nobody who is in charge is connected.",)
    assert not rig.ask(Enable).accepted


def test_sr18_pain_holds_softly_in_its_own_tick_and_outdates_what_was_wished_before_it() -> None:
    rig = engaged()
    assert rig.ask(Pain, reason="my shoulder").state is DriveState.HOLD
    assert (rig.last.reason, rig.last.exo.compliant) == ("my shoulder", True)
    assert max(rig.last.exo.share) < 1.0
    rig.run(1.0)
    rig.mailbox.wanted += [Resume(number=100), Pain(number=101, reason="")]
    assert rig.tick().state is DriveState.HOLD
    rig.mailbox.wanted.append(Resume(number=99))
    rig.tick()
    assert "pain" in rig.told(WishAnswer)[-1].reason
    rig.run(1.0)
    rig.mailbox.wanted.append(Resume(number=102))
    assert rig.tick().state is DriveState.ENGAGED


def test_the_therapist_chooses_how_much_the_drive_helps_and_the_tick_tells() -> None:
    rig = engaged()
    assert (rig.last.exo.assistance, rig.last.exo.level, rig.last.exo.share) == (Assistance.PASSIVE, 1.0, (1.0,) * 4)
    assert rig.ask(SetAssistance, mode=Assistance.ASSISTED, level=0.5).accepted
    rig.run(1.5)
    assert (rig.last.exo.assistance, rig.last.exo.level) == (Assistance.ASSISTED, 0.5)
    assert max(rig.last.exo.share) <= 0.5
    assert len(rig.last.exo.interaction_nm) == 4
    assert not rig.last.exo.compliant
    assert not rig.ask(SetAssistance, mode=Assistance.ASSISTED, level=1.5).accepted


def test_sr5_stop_is_answered_in_its_own_tick_and_latched_until_reset() -> None:
    rig = engaged()
    assert rig.ask(Stop, reason="pain").state is DriveState.STOPPED
    assert not rig.ask(Resume).accepted
    assert not rig.ask(Enable).accepted
    assert rig.ask(Reset).state is DriveState.READY
    assert rig.run(1.0).state is DriveState.READY


@pytest.mark.parametrize(
    ("change", "blocker"),
    [
        ({"patient": " "}, "names no patient"),
        ({"side_confirmed": False}, "side has not been confirmed"),
        ({"limits": ()}, "No limits"),
        ({"limits_set_by": ""}, "Nobody has signed"),
    ],
)
def test_sr10_no_motion_without_patient_side_and_signed_limits(change: dict[str, object], blocker: str) -> None:
    rig = HandCranked()
    rig.seeing = [False, False]
    assert rig.open(**change).accepted
    assert any(blocker in words for words in rig.last.blockers)
    answer = rig.ask(Enable)
    assert not answer.accepted
    assert blocker in answer.reason


def test_sr10_no_motion_without_an_aligned_sensor() -> None:
    rig = HandCranked()
    rig.seeing = [False, False]
    rig.open()
    assert "No sensor is aligned yet." in rig.ask(Enable).reason


def test_sr1_limits_that_cannot_be_used_refuse_the_session() -> None:
    answer = HandCranked().open(limits=patient_limits()[:2])
    assert not answer.accepted
    assert "plane, elevation, rotation, elbow" in answer.reason


def test_a_second_session_is_refused_while_one_is_open() -> None:
    rig = HandCranked()
    rig.open()
    assert not rig.open().accepted


def test_a_recording_that_cannot_be_made_refuses_the_session_in_words(tmp_path: Path) -> None:
    rig = HandCranked()
    answer = rig.open(tmp_path / "missing" / "r.mcap")
    assert not answer.accepted
    assert "r.mcap" in answer.reason
    assert rig.last.state is DriveState.OFF


def test_closing_brings_the_arm_to_rest_and_finishes_a_readable_recording(tmp_path: Path) -> None:
    rig = HandCranked()
    rig.open(tmp_path / "r.mcap")
    rig.run(4.0)
    assert rig.ask(Enable).accepted
    rig.goal = RAISED
    rig.run(1.5)
    assert rig.ask(CloseSession).accepted
    tick_until(rig, lambda: bool(rig.told(SessionClosed)))
    rig.tick()
    assert rig.told(SessionClosed)[0].recording == str(tmp_path / "r.mcap")
    assert rig.last.session == ""
    assert rig.last.state is DriveState.OFF
    assert all(speed == 0 for speed in rig.last.exo.command_velocity_rad_s)
    recorded = read_recording(tmp_path / "r.mcap")
    assert {stream.sensor for stream in recorded.skeleton_streams} == {"s1", "s2"}
    assert rig.open().accepted


def test_sr15_garbage_is_counted_and_told_once_and_changes_nothing() -> None:
    rig = engaged()
    refused = rig.last.timing.datagrams_refused
    for datagram in (
        b"",
        b"\x00",
        b"/bodies",
        b"#bundle\x00garbage!",
        b"\xff" * 500,
        b"/unknown\x00\x00\x00\x00,f\x00\x00",
    ):
        for _ in range(20):
            rig.source.waiting.append(Packet("s1", rig.now_s, datagram))
    rig.run(0.3)
    assert rig.last.timing.datagrams_refused >= refused + 100
    assert rig.last.state is DriveState.ENGAGED
    assert len([warned for warned in rig.told(Warned) if warned.code == "garbage"]) == 1


def test_sr8_an_error_in_perception_costs_the_view_and_never_the_loop(monkeypatch: pytest.MonkeyPatch) -> None:
    rig = engaged()

    def broken(*_: object) -> None:
        raise ZeroDivisionError

    with monkeypatch.context() as patched:
        patched.setattr("fusion.pipeline.Pipeline.step", broken)
        assert rig.run(0.2).state is DriveState.HOLD
    assert rig.told(Warned)[0].code == "perception"
    assert rig.run(3.0).body is not None


def test_sr5_after_an_error_in_perception_whoever_is_found_is_not_followed_by_itself(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    rig = engaged()

    def fails(*_: object) -> None:
        raise RuntimeError("a bug")

    with monkeypatch.context() as patched:
        patched.setattr("fusion.pipeline.Pipeline.step", fails)
        assert "found anew" in rig.tick().reason
    rig.run(3.0)
    assert rig.last.target is not None
    assert rig.last.state is DriveState.HOLD
    assert rig.ask(Resume).accepted


def test_following_a_body_is_answered() -> None:
    rig = HandCranked()
    assert rig.ask(FollowBody, sensor="s1", body="1").accepted


def beside(rig: HandCranked, seconds: float) -> LiveTick:
    """Run with a visitor who stands nearly a metre beside the patient, number 9 in both sensors."""
    visitor, sensors = VirtualPatient(Side.RIGHT, 5), sensors_for(Side.RIGHT, 5)
    for _ in range(round(seconds / DT_S)):
        positions = visitor.step(DT_S) + np.array([0.9, 0.0, 0.0])
        for address, sensor in zip(rig.addresses, sensors, strict=True):
            sample = sensor.see(positions, visitor.t_s)
            if sample is not None:
                rig.send(address, replace(sample, body="9"))
        rig.tick()
    return rig.last


def test_everybody_in_view_is_told_and_confirming_the_patient_holds_nothing() -> None:
    rig = engaged()
    told = {(one.sensor, one.body): one for one in beside(rig, 1.0).people}
    assert {key: one.is_patient for key, one in told.items()} == {
        ("s1", "1"): True,
        ("s2", "2"): True,
        ("s1", "9"): False,
        ("s2", "9"): False,
    }
    assert not any(one.confirmed for one in told.values())
    assert told["s1", "9"].reason == "another person: seen beside the patient"
    places = [np.array(told[key].place_in_room) for key in (("s1", "1"), ("s2", "2"), ("s1", "9"))]
    assert np.linalg.norm(places[0] - places[1]) < 0.15
    assert np.linalg.norm(places[0] - places[2]) > 0.6
    assert rig.ask(FollowBody, sensor="s1", body="1").state is DriveState.ENGAGED
    assert [one.body for one in rig.last.people if one.confirmed] == ["1"]


def test_sr5_choosing_another_body_holds_until_a_person_resumes() -> None:
    rig = engaged()
    beside(rig, 1.0)
    assert rig.ask(FollowBody, sensor="s1", body="9").state is DriveState.HOLD
    assert "followed" in rig.last.reason
    assert beside(rig, 6.0).state is DriveState.HOLD
    assert {one.body for one in rig.last.people if one.is_patient} == {"9"}
    assert rig.ask(Resume).accepted, rig.last.blockers


def test_sr5_a_stop_wins_over_everything_that_was_wished_before_it_and_read_in_the_same_tick() -> None:
    rig = engaged()
    before = [Hold(number=99, reason="a pause"), Reset(number=100), Enable(number=101)]
    rig.mailbox.wanted += [*before, Stop(number=102, reason="pain")]
    assert rig.tick().state is DriveState.STOPPED
    assert rig.told(StateChanged)[-1].before is DriveState.ENGAGED  # no other wish was looked at before it
    rig.mailbox.wanted.append(Reset(number=99))
    assert rig.tick().state is DriveState.STOPPED
    assert "stop" in rig.told(WishAnswer)[-1].reason
    rig.mailbox.wanted.append(Reset(number=103))
    assert rig.tick().state is DriveState.READY


@pytest.mark.parametrize("change", [{"side_confirmed": False}, {"limits": ()}])
def test_sr10_a_session_is_not_enabled_by_what_was_known_of_the_one_before(change: dict[str, object]) -> None:
    rig = engaged()
    rig.ask(Hold, reason="a pause")
    rig.run(1.0)
    rig.ask(CloseSession)
    while not rig.told(SessionClosed):
        rig.tick()
    opening = OpenSession(number=50, **{**rig.opening(), **change})
    rig.mailbox.wanted += [opening, Enable(number=51)]
    assert rig.tick().state is DriveState.READY
    assert [answer.accepted for answer in rig.told(WishAnswer)[-2:]] == [True, False]


@pytest.mark.parametrize("wishes", [(Hold, Resume), (Stop, Reset, Enable)])
def test_sr6_nothing_is_resumed_in_the_very_tick_that_held_it(wishes: tuple[type[Wish], ...]) -> None:
    rig = engaged()
    fields = {Hold: {"reason": "a pause"}, Stop: {"reason": "pain"}}
    rig.mailbox.wanted += [kind(number=50 + i, **fields.get(kind, {})) for i, kind in enumerate(wishes)]
    assert rig.tick().state is not DriveState.ENGAGED


def test_sr5_after_a_stop_the_next_session_opens_stopped_and_takes_a_reset_and_a_start() -> None:
    rig = engaged()
    rig.ask(Stop, reason="pain")
    rig.ask(CloseSession)
    rig.run(0.5)
    assert rig.last.state is DriveState.STOPPED
    assert rig.open(limits=patient_limits()).state is DriveState.STOPPED
    assert rig.last.reason == "pain"
    assert not rig.ask(Enable).accepted
    assert rig.ask(Reset).state is DriveState.READY
    rig.run(4.0)
    assert rig.ask(Enable).accepted, rig.last.blockers


def test_sr4_somebody_else_in_view_does_not_keep_a_patient_who_is_hidden_alive() -> None:
    rig = engaged()
    rig.run(1.0)
    rig.seeing = [False, False]
    aside = np.array([1.5, 0.0, 0.0])
    for _ in range(15):
        positions = rig.patient.step(0.01, None, ArmPose(*rig.last.exo.angle_rad)) + aside
        for address, sensor in zip(rig.addresses, rig.sensors, strict=True):
            sample = sensor.see(positions, rig.patient.t_s)
            if sample is not None:
                rig.send(address, replace(sample, body="77"))
        rig.tick()
    assert rig.last.state is DriveState.HOLD


def test_the_trunks_lean_is_measured_from_where_it_was_at_enable(session: HandCranked) -> None:
    assert 0.0 < session.last.trunk_lean_m < 0.3
    assert HandCranked().tick().trunk_lean_m == 0.0


def test_opening_for_the_other_side_keeps_what_is_known_of_the_sensors() -> None:
    rig = HandCranked()
    rig.run(3.0)
    assert any(sensor.aligned for sensor in rig.last.sensors)
    rig.open(healthy_side=Side.LEFT)
    assert any(sensor.aligned for sensor in rig.last.sensors)
    assert rig.last.healthy_side is Side.LEFT


def test_the_demonstration_is_silent_while_others_send_and_comes_back_after_them() -> None:
    rig = HandCranked(Demonstration(), addresses=("127.0.1.1", "127.0.1.2"))
    rig.run(1.0)
    assert {sensor.sensor for sensor in rig.last.sensors} == {"127.0.1.1", "127.0.1.2"}
    rig.addresses = ("127.0.0.1", "127.0.0.2")
    rig.run(1.0)
    assert rig.mailbox.paused
    assert {sensor.sensor for sensor in rig.last.sensors} == {"127.0.0.1", "127.0.0.2"}
    rig.addresses = ("127.0.1.1", "127.0.1.2")
    rig.run(1.0)
    assert {sensor.sensor for sensor in rig.last.sensors} == {"127.0.0.1", "127.0.0.2"}
    rig.seeing = [False, False]
    rig.run(31.0)
    assert not rig.mailbox.paused


def test_a_persons_hold_is_told_with_its_reason() -> None:
    rig = engaged()
    assert rig.ask(Hold, reason="a sip of water").state is DriveState.HOLD
    assert rig.last.reason == "a sip of water"


def test_leaving_brings_everything_to_an_end(tmp_path: Path) -> None:
    rig = HandCranked()
    rig.open(tmp_path / "r.mcap")
    rig.run(0.5)
    assert not rig.loop.may_end
    rig.loop.leave(rig.now_s)
    tick_until(rig, lambda: rig.loop.may_end)
    assert rig.loop.may_end
    assert read_recording(tmp_path / "r.mcap").skeleton_streams


def test_perception_forgets_sensors_after_a_minute_of_silence() -> None:
    rig = HandCranked()
    rig.run(2.0)
    rig.seeing = [False, False]
    rig.run(1.0)
    rig.now_s += 61.0
    rig.seeing = [True, True]
    rig.run(0.2)
    assert not any(sensor.aligned for sensor in rig.last.sensors)
