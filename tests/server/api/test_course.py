"""The open session: limits, phases, the game's clock, and the demonstration's goal."""

from datetime import UTC, datetime

import msgspec
import pytest
from hypothesis import given
from hypothesis import strategies as st

from db.exercise import Exercise
from db.limits import ForceLimits, JointForce, JointRange, PassiveRange, PatientLimits
from db.workspace import SessionWorkspace
from fusion.errors import RefusedError
from fusion.skeleton import Side
from games.game import Wish
from server.api.course import Course, Opening
from server.api.demo_goal import goal
from server.api.exercises import FIRST_LEVEL
from server.api.game_log import read_game
from server.api.limits import session_limits
from server.api.workspace import inside
from server.config import StationConfig
from server.messages import DriveState

DEVICE = StationConfig().device
angles = st.floats(-3.1, 3.1)
torques = st.floats(0.1, 60.0)


@pytest.fixture
def tick(paper_tick):
    """Makes ticks."""

    def made(t_s, state, hand=None):
        points = paper_tick.affected.points_in_trunk
        affected = msgspec.structs.replace(paper_tick.affected, points_in_trunk=(*points[:3], hand or points[3]))
        return msgspec.structs.replace(paper_tick, t_s=t_s, state=state, affected=affected)

    return made


@pytest.fixture
def course(tmp_path):
    limits = session_limits(PatientLimits(), DEVICE)
    allowed = inside(limits, 0.1)
    made = Course(
        Opening(
            id=1,
            patient="Wang",
            affected_side=Side.LEFT,
            exercises=(Exercise(game="reach", minutes=2.0, level=0.3), Exercise(game="reach", minutes=1.0)),
            seed=3,
            limits=limits,
            assist_level_most=0.8,
            allowed=allowed,
            workspace=SessionWorkspace(source="limits", used=allowed),
            game_log=tmp_path / "session.game",
            started=datetime(2026, 3, 1, tzinfo=UTC),
            t_started_s=10.0,
        )
    )
    yield made
    if made.playing is not None:
        made.playing.log.close()


@pytest.fixture
def begin(tick):
    """Opens the games, as the service does when the arm is first engaged."""

    def begun(course):
        engaged = tick(10.1, DriveState.ENGAGED)
        course.step(engaged)
        assert course.lacks_games
        course.games_asked, course.playing = True, course.open_games(engaged)
        return course.picture

    return begun


@given(angles, angles)
def test_limits_are_inside_both_ranges_or_refused(one, other):
    low, high = sorted((one, other))
    if low == high:
        return
    patient = PatientLimits(passive_range=PassiveRange(elbow=JointRange(min_rad=low, max_rad=high)))
    device = DEVICE[-1]
    if max(low, device.min_rad) >= min(high, device.max_rad):
        with pytest.raises(RefusedError, match="elbow"):
            session_limits(patient, DEVICE)
        return
    elbow = session_limits(patient, DEVICE)[-1]
    assert (elbow.min_rad, elbow.max_rad) == (max(low, device.min_rad), min(high, device.max_rad))
    assert elbow.velocity_rad_s == device.velocity_rad_s


@given(torques, torques)
def test_sr2_torques_are_the_lesser_of_the_patients_and_the_devices(torque_nm, resistance_nm):
    force = JointForce(torque_nm=torque_nm, resistance_nm=resistance_nm)
    elbow = session_limits(PatientLimits(force_limits=ForceLimits(elbow=force)), DEVICE)[-1]
    assert elbow.torque_nm == min(torque_nm, DEVICE[-1].torque_nm)
    assert elbow.resistance_nm == min(resistance_nm, DEVICE[-1].resistance_nm)


@pytest.mark.parametrize(
    ("state", "phase"),
    [
        (DriveState.OFF, "preparing"),
        (DriveState.READY, "preparing"),
        (DriveState.ENGAGED, "running"),
        (DriveState.HOLD, "held"),
        (DriveState.FAULT, "stopped"),
        (DriveState.STOPPED, "stopped"),
    ],
)
def test_every_state_of_the_arm_has_a_phase(course, state, phase, tick):
    course.step(tick(11.0, state))
    assert course.view(None).phase == phase
    assert course.view(None).elapsed_s == pytest.approx(1.0)


def test_there_is_no_game_before_the_arm_was_first_engaged(course, tick, begin):
    assert course.step(tick(10.1, DriveState.READY)) is None
    assert not course.lacks_games
    assert begin(course).game == "reach"


def test_the_games_clock_stands_still_while_the_arm_is_held(course, tick, begin):
    before = begin(course)
    for k in range(20):
        held = course.step(tick(10.2 + k / 10, DriveState.HOLD))
    assert held.time_left_s == before.time_left_s
    assert course.step(tick(12.2, DriveState.ENGAGED)).time_left_s < before.time_left_s


def test_while_the_arm_is_held_nobody_is_said_to_have_played(course, tick, begin):
    begin(course)
    course.playing.wish(Wish.START)
    for k in range(20):
        course.step(tick(10.2 + k / 20, DriveState.ENGAGED))
    (before,) = course.played
    for k in range(20):
        course.step(tick(11.2 + k / 10, DriveState.HOLD))
    assert course.played == (before,)
    assert before.played_s == pytest.approx(1.0, abs=0.2)


def test_the_goal_is_the_mirror_image_of_the_target_or_of_the_held_arm_and_rest_otherwise(course, tick, begin):
    assert goal(course, tick(10.0, DriveState.READY)).hand_in_trunk is None
    begin(course)
    for k in range(20):
        engaged = tick(10.2 + k / 50, DriveState.ENGAGED)
        picture = course.step(engaged)
    target = picture.aim
    assert goal(course, engaged).hand_in_trunk == (-target[0], target[1], target[2])
    assert goal(course, engaged).healthy_side is Side.RIGHT
    held = tick(11.0, DriveState.HOLD)
    x, y, z = held.affected.points_in_trunk[-1]
    assert goal(course, held).hand_in_trunk == (-x, y, z)
    assert goal(None, engaged).hand_in_trunk is None


def test_a_screen_that_goes_pauses_the_game_until_it_is_back_and_somebody_goes_on(course, tick, begin):
    begin(course)
    course.playing.wish(Wish.START)
    course.see_screens(1)
    assert course.step(tick(10.2, DriveState.ENGAGED)).phase == "playing"
    assert course.see_screens(0)
    gone = course.step(tick(10.3, DriveState.ENGAGED))
    assert (gone.phase, course.view(None).screen_lost, course.view(None).patient_screens) == ("paused", True, 0)
    assert not course.see_screens(0)
    course.see_screens(2)
    back = course.step(tick(10.4, DriveState.ENGAGED))
    assert (back.phase, course.view(None).screen_lost, course.view(None).patient_screens) == ("paused", False, 2)
    assert "go_on" in {choice.id for choice in back.choices}
    assert not course.see_screens(1), "one of two screens may go"
    course.playing.wish(Wish.GO_ON)
    assert course.step(tick(10.5, DriveState.ENGAGED)).phase == "playing"


def test_no_gesture_goes_on_with_a_game_that_has_lost_its_screen(course, tick, begin):
    begin(course)
    course.playing.wish(Wish.START)
    course.see_screens(1)
    course.step(tick(10.2, DriveState.ENGAGED))
    course.see_screens(0)
    paused = course.step(tick(10.3, DriveState.ENGAGED))
    (spot,) = [choice.position for choice in paused.choices if choice.id == "go_on"]
    for k in range(100):
        assert course.step(tick(10.4 + k / 10, DriveState.ENGAGED, hand=spot)).phase == "paused"
    course.screens.go_on_without()
    course.playing.wish(Wish.GO_ON)
    assert course.step(tick(20.5, DriveState.ENGAGED)).phase == "playing"


def test_the_exercises_begin_with_their_levels_and_minutes(course, begin):
    assert begin(course).level == 0.3
    course.playing.log.close()
    settings = [one.settings for one in read_game(course.opening.game_log).record.exercises]
    assert [one.round_s * one.rounds for one in settings] == [120.0, 60.0]
    assert [one.start_level for one in settings] == [0.3, FIRST_LEVEL]


def test_the_virtual_patient_shows_how_far_it_can_go_while_somebody_looks(course, tick):
    course.step(tick(11.0, DriveState.READY))
    course.ask_to_show()
    shown = {goal(course, tick(11.0 + k / 2, DriveState.READY)).hand_in_trunk for k in range(30)}
    assert len(shown) > 5
    assert None not in shown
    course.step(tick(15.0, DriveState.READY))
    assert goal(course, tick(15.0, DriveState.READY)).hand_in_trunk is None
