"""Set-points begin where the joints stand and never step."""

from __future__ import annotations

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from server.station.exo.cia402.setpoint import JOIN_RAD_S, LEAD_RAD, SetPoint
from server.station.exo.driver import DriveMode

angles = st.lists(st.floats(-3, 3), min_size=3, max_size=3).map(np.array)
HERE, THERE = np.array([0.1, 0.2, 0.3]), np.array([1.0, 0.2, -1.0])


def test_sr6_a_hold_after_power_is_where_the_joint_stands_whatever_the_gate_remembers() -> None:
    assert SetPoint.standing(HERE).towards(DriveMode.HOLD, THERE, HERE, 0.01).joints_rad == pytest.approx(HERE)


@given(angles, angles)
def test_sr6_the_first_command_moves_no_joint_further_than_the_joining_speed(
    here: np.ndarray, there: np.ndarray
) -> None:
    point = SetPoint.standing(here).towards(DriveMode.FOLLOW, there, here, 0.01)
    assert np.abs(point.joints_rad - here).max() <= JOIN_RAD_S * 0.01 + 1e-12


def test_in_the_end_the_command_is_followed_exactly_and_in_a_hold_too() -> None:
    point = SetPoint.standing(HERE).towards(DriveMode.FOLLOW, THERE, HERE, 0.01)
    for _ in range(700):
        point = point.towards(DriveMode.HOLD, THERE, point.joints_rad, 0.01)
    assert point.joints_rad == pytest.approx(THERE)


def test_sr2_a_command_that_is_no_number_moves_nothing() -> None:
    point = SetPoint.standing(HERE).towards(DriveMode.FOLLOW, np.array([np.nan, 0.2, 0.3]), HERE, 0.01)
    assert point.joints_rad == pytest.approx(HERE)


def test_sr18_a_joint_that_gives_way_takes_its_set_point_along_and_does_not_snap_back() -> None:
    point = SetPoint.standing(HERE).towards(DriveMode.FOLLOW, HERE, HERE, 0.01)
    pushed = HERE + np.array([0.8, 0.0, 0.0])
    soft = point.yielding(np.array([True, True, False]), pushed)
    assert soft.joints_rad == pytest.approx([0.1 + 0.8 - LEAD_RAD, 0.2, 0.3])
    stiff = soft.towards(DriveMode.FOLLOW, HERE, pushed, 0.01)
    assert abs(stiff.joints_rad[0] - soft.joints_rad[0]) <= JOIN_RAD_S * 0.01 + 1e-12


def test_sr5_a_joint_that_gave_way_does_not_run_away_from_a_command_that_begins_anew_where_it_stands() -> None:
    joint = HERE - np.array([0.3, 0.0, 0.0])
    soft = np.array([True, False, False])
    point = SetPoint.standing(HERE).towards(DriveMode.FOLLOW, HERE, HERE, 0.01).yielding(soft, joint)
    wanted, stood = joint, joint.copy()
    for tick in range(100):
        if np.abs(joint - wanted).max() > 0.05:
            wanted = joint  # as the gate does for an arm that waits
        point = point.towards(DriveMode.HOLD, wanted, joint, 0.01).yielding(soft & (tick < 25), joint)
        joint = joint + np.clip(point.joints_rad - joint, -0.02, 0.02)
    assert np.abs(joint - stood).max() <= LEAD_RAD + 1e-9
