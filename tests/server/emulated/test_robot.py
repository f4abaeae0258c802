"""The emulated robot is as strict as a joint trajectory controller, and has inertia and limits."""

from __future__ import annotations

import numpy as np
import pytest

from server.emulated.robot import EmulatedRobot
from server.exoskeleton import BUILT_IN


@pytest.fixture
def robot() -> EmulatedRobot:
    made = EmulatedRobot(BUILT_IN)
    made.step(0.0)
    return made


def _follow(robot: EmulatedRobot, angles, times=(1.0,), speeds=None, names=None) -> str:
    angles = np.atleast_2d(angles)
    return robot.follow(names or robot.names, times, angles, np.zeros_like(angles) if speeds is None else speeds, 0.0)


def test_it_goes_where_it_is_told_and_stays(robot) -> None:
    goal = robot.angle_rad + 0.2
    assert _follow(robot, goal) == ""
    for t_s in (0.4, 0.8, 1.2, 1.6, 2.0):
        robot.step(t_s)
    assert robot.angle_rad == pytest.approx(goal, abs=1e-3)
    assert robot.velocity_rad_s == pytest.approx(np.zeros(7), abs=1e-3)


def test_joints_may_be_named_in_any_order(robot) -> None:
    goal = robot.angle_rad + np.arange(7) * 0.02
    assert _follow(robot, goal[::-1], names=robot.names[::-1]) == ""
    for t_s in (0.5, 1.0, 1.5):
        robot.step(t_s)
    assert robot.angle_rad == pytest.approx(goal, abs=1e-3)


def test_a_jump_is_followed_at_the_motors_own_speed_and_ends_at_the_stops(robot) -> None:
    before = robot.angle_rad.copy()
    _follow(robot, robot.angle_rad + 9.0, times=(0.01,))
    robot.step(0.1)
    fastest = np.array([joint.velocity_rad_s for joint in BUILT_IN.joints])
    assert (robot.angle_rad - before <= fastest * 0.1 + 1e-9).all()
    for tick in range(1, 100):
        robot.step(0.1 + tick * 0.1)
    assert robot.angle_rad == pytest.approx([joint.max_rad for joint in BUILT_IN.joints])


def test_one_that_moves_at_the_end_is_refused_as_ros_2_refuses_it(robot) -> None:
    assert "not zero" in _follow(robot, robot.angle_rad, speeds=np.full((1, 7), 0.1))


@pytest.mark.parametrize(
    ("changed", "said"),
    [
        ({"names": ("a", "b", "c", "d", "e", "f", "g")}, "joint_names"),
        ({"times": (0.2, 0.1)}, "does not grow"),
        ({"times": (-0.1, 0.1)}, "does not grow"),
        ({"speeds": np.zeros((1, 7))}, "for each joint"),
    ],
)
def test_a_trajectory_of_the_wrong_form_is_refused(robot, changed, said) -> None:
    arguments = {"times": (0.1, 0.2)} | changed
    assert said in _follow(robot, np.vstack((robot.angle_rad, robot.angle_rad)), **arguments)


def test_numbers_that_are_none_are_refused(robot) -> None:
    assert "no numbers" in _follow(robot, np.full(7, np.nan))
