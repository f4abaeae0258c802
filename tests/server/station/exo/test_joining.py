"""A gap is added to a command, but not to one that begins anew where the joint stands."""

from __future__ import annotations

import numpy as np
from hypothesis import given
from hypothesis import strategies as st

from server.station.exo.joining import STEP_RAD, gap_rad

angle = st.floats(-2, 2)
BEFORE, GAP = np.array([0.5]), np.array([0.08])


def told_rad(wanted_rad: float, measured_rad: float) -> float:
    return float(wanted_rad + gap_rad(BEFORE, GAP, np.array([wanted_rad]), np.array([measured_rad]))[0])


def test_a_command_that_goes_on_keeps_its_gap() -> None:
    assert told_rad(0.5 + 0.9 * STEP_RAD, measured_rad=0.5) == 0.5 + 0.9 * STEP_RAD + 0.08


def test_sr5_a_command_that_begins_anew_where_the_joint_stands_tells_it_what_it_was_told() -> None:
    assert np.isclose(told_rad(0.59, measured_rad=0.59), 0.58)


def test_a_joint_that_was_moved_by_hand_is_not_told_to_go_back() -> None:
    assert np.isclose(told_rad(1.5, measured_rad=1.5), 1.58)


@given(angle, angle)
def test_a_joint_without_a_gap_is_told_the_command(wanted: float, measured: float) -> None:
    assert not gap_rad(BEFORE, np.zeros(1), np.array([wanted]), np.array([measured])).any()


@given(angle, angle)
def test_a_joint_is_told_to_go_on_or_to_stay_whichever_is_nearer_to_it(wanted: float, measured: float) -> None:
    told = told_rad(wanted, measured)
    on, stay = wanted + 0.08, 0.58
    if abs(wanted - 0.5) <= STEP_RAD:
        assert np.isclose(told, on)
    else:
        assert np.isclose(abs(told - measured), min(abs(on - measured), abs(stay - measured)))
