"""A robot that is not where it is told to be is noticed, and not commanded from afar."""

from __future__ import annotations

import numpy as np
import pytest

from server.station.exo.rosbridge.following import Following

NAMES = ("a", "b")
HERE = np.array([0.0, 1.0])


def _after(steps, moving=True, following=None):
    following = following or Following()
    for tick, measured in enumerate(steps):
        following = following.step(NAMES, HERE, np.asarray(measured), moving, 0.35, tick * 0.01)
    return following


def test_a_robot_near_what_it_is_told_is_joined() -> None:
    assert _after([(0.05, 0.95)]).joined


def test_sr6_a_robot_elsewhere_is_not_joined() -> None:
    assert not _after([(0.0, 1.2)]).joined


def test_one_that_stays_elsewhere_is_named_after_its_time() -> None:
    joined = _after([HERE])
    assert not _after([HERE] + [(0.0, 0.6)] * 25, following=joined).fault
    fault = _after([HERE] + [(0.0, 0.6)] * 40, following=joined).fault
    assert "'b'" in fault
    assert "0.40 rad" in fault


def test_a_robot_that_only_holds_may_be_moved_by_hand() -> None:
    assert not _after([HERE] + [(0.0, 0.2)] * 100, moving=False).fault


def test_it_is_well_again_when_it_is_near_again() -> None:
    assert not _after([HERE] + [(0.0, 0.5)] * 60 + [HERE]).fault


def test_sr6_what_lies_between_is_closed_slowly_and_never_jumped() -> None:
    following, told = Following(), []
    for tick in range(120):
        following = following.step(NAMES, HERE, np.array([0.0, 0.92]), False, 0.35, tick * 0.01)
        told.append(HERE + following.gap_rad)
    assert told[0] == pytest.approx([0.0, 0.92])
    assert np.abs(np.diff(told, axis=0)).max() <= 0.1 * 0.01 + 1e-12
    assert told[-1] == pytest.approx(HERE)
    assert not following.closing_rad_s.any()


@pytest.mark.parametrize("apart_rad", [0.06, 0.08, 0.09])
def test_sr5_a_robot_does_not_run_away_from_a_command_that_begins_anew_where_it_stands(apart_rad: float) -> None:
    following, wanted, robot = Following(), HERE, HERE + np.array([0.0, apart_rad])
    stood = robot.copy()
    for tick in range(100):
        if tick >= 5 and np.abs(robot - wanted).max() > 0.05:
            wanted = robot  # as the gate does for an arm that waits
        following = following.step(NAMES, wanted, robot, False, 0.35, tick * 0.01)
        robot = robot + np.clip(wanted + following.gap_rad - robot, -0.02, 0.02)
    assert np.abs(robot - stood).max() < 0.05
