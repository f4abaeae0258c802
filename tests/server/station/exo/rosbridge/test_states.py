"""Joint states of a robot with a clock of its own: what is old is seen to be old."""

from __future__ import annotations

import pytest

from server.station.exo.rosbridge.states import JointStates
from server.station.exo.rosbridge.wire import Header, JointState, time_of

AHEAD_S = 5_000.0


def _state(sent_s: float, **lists) -> JointState:
    filled = {"name": ("a",), "position": (0.5,), "velocity": (0.1,), "effort": (2.0,)} | lists
    return JointState(header=Header(time_of(sent_s + AHEAD_S)), **filled)


def _heard(*messages: tuple[float, float]) -> JointStates:
    """Messages as (sent, received)."""
    states = JointStates()
    for sent_s, received_s in messages:
        states = states.heard(_state(sent_s), received_s)
    return states


def test_a_steady_way_is_no_age() -> None:
    states = _heard(*[(t / 100, t / 100 + 0.03) for t in range(100)])
    assert states.joints["a"].t_s == pytest.approx(1.02, abs=1e-3)


def test_a_message_that_was_held_up_is_as_old_as_it_is() -> None:
    states = _heard(*[(t / 100, t / 100 + 0.01) for t in range(100)], (1.0, 1.26))
    assert 1.26 - states.joints["a"].t_s == pytest.approx(0.25, abs=1e-3)


def test_a_state_that_is_repeated_grows_old() -> None:
    states = _heard((1.0, 1.01), *[(1.0, 1.01 + t / 100) for t in range(1, 31)])
    assert 1.31 - states.joints["a"].t_s == pytest.approx(0.3, abs=1e-3)


def test_clocks_that_drift_apart_are_no_age() -> None:
    states = _heard(*[(t * 0.9999, float(t)) for t in range(3600)])
    assert 3599.0 - states.joints["a"].t_s < 0.02


def test_a_robot_that_does_not_stamp_is_taken_at_its_word() -> None:
    states = JointStates().heard(JointState(name=("a",), position=(0.5,)), 7.0)
    assert states.joints["a"].t_s == 7.0


def test_without_velocities_they_are_differences() -> None:
    states = JointStates().heard(_state(1.0, velocity=()), 1.0)
    assert states.joints["a"].velocity_rad_s == 0.0
    states = states.heard(_state(1.01, position=(0.52,), velocity=()), 1.01)
    assert states.joints["a"].velocity_rad_s == pytest.approx(2.0, rel=1e-4)


@pytest.mark.parametrize("position", [(), (None,), (float("nan"),), (float("inf"),)])
def test_sr2_a_position_that_is_no_number_is_not_taken(position) -> None:
    assert JointStates().heard(_state(1.0, position=position), 1.0).missing(("a",)) == ("a",)


def test_efforts_that_are_not_measured_are_none() -> None:
    assert JointStates().heard(_state(1.0, effort=(None,)), 1.0).joints["a"].torque_nm == 0.0


def test_joints_of_two_publishers_come_together() -> None:
    states = JointStates().heard(_state(1.0), 1.0)
    states = states.heard(_state(1.0, name=("b", "c"), position=(1.0, 2.0)), 1.0)
    assert states.missing(("a", "b", "c", "d")) == ("d",)
