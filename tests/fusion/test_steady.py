"""What is told of a joint never steps further than a limb could move, and still holds what it must."""

from __future__ import annotations

import numpy as np
from hypothesis import given, settings
from hypothesis import strategies as st

from fusion.estimation.average import Average
from fusion.messages import AlignedSample, FusedFrame
from fusion.rewind import RewindingEstimator
from fusion.skeleton import JOINT_COUNT
from fusion.steady import SPEED_MAX, follow

TICK_S = 0.01


def frame(t_s: float, positions: np.ndarray, bound_m: float = 0.1) -> FusedFrame:
    bounds = np.full(JOINT_COUNT, bound_m)
    shape = np.broadcast_to(bound_m**2 * np.eye(3), (JOINT_COUNT, 3, 3))
    return FusedFrame(t_s, positions, shape, bounds, np.full(JOINT_COUNT, 2, np.uint8))


@settings(derandomize=True, max_examples=50, deadline=None)
@given(seed=st.integers(0, 2**32 - 1), spread_m=st.floats(0.0, 2.0))
def test_no_joint_steps_further_than_a_limb_can_move(seed: int, spread_m: float) -> None:
    rng = np.random.default_rng(seed)
    told = frame(0.0, rng.normal(size=(JOINT_COUNT, 3)))
    for _ in range(20):
        dt = rng.uniform(0, 0.05)
        target = frame(told.t_s + dt, told.positions_in_room + rng.normal(0, spread_m, (JOINT_COUNT, 3)))
        after = follow(told, target)
        steps = np.linalg.norm(after.positions_in_room - told.positions_in_room, axis=1)
        assert (steps <= SPEED_MAX * dt + 1e-12).all()
        left = np.linalg.norm(after.positions_in_room - target.positions_in_room, axis=1)
        assert (left + target.bound_m <= after.bound_m + 1e-12).all()  # all of the target's set is in the one told
        told = after


def test_half_a_metre_is_caught_up_within_three_frames_of_a_sensor() -> None:
    told, home = frame(0.0, np.zeros((JOINT_COUNT, 3))), np.full((JOINT_COUNT, 3), 0.5 / np.sqrt(3))
    for k in range(1, 11):
        told = follow(told, frame(k * TICK_S, home))
    np.testing.assert_allclose(told.positions_in_room, home)


def test_what_is_near_is_told_as_it_is() -> None:
    target = frame(TICK_S, np.full((JOINT_COUNT, 3), 0.02))
    assert follow(frame(0.0, np.zeros((JOINT_COUNT, 3))), target) is target


def test_a_joint_seen_for_the_first_time_is_told_where_it_is() -> None:
    unknown = np.full((JOINT_COUNT, 3), np.nan)
    target = frame(TICK_S, np.ones((JOINT_COUNT, 3)))
    assert follow(frame(0.0, unknown), target) is target


def test_a_late_sample_changes_the_past_without_a_step_now() -> None:
    estimator = RewindingEstimator(Average)
    near, far = np.zeros((JOINT_COUNT, 3)), np.full((JOINT_COUNT, 3), 0.4)
    for sensor, t_s, positions in (("a", 1.0, near), ("b", 0.95, far)):
        state = np.full(JOINT_COUNT, 2, np.uint8)
        estimator.take(AlignedSample(sensor, t_s, t_s, positions, state, np.zeros(3), np.eye(3)))
        told = estimator.frame(1.0 + (TICK_S if sensor == "b" else 0.0))
    assert 0 < np.linalg.norm(told.positions_in_room, axis=1).max() <= SPEED_MAX * TICK_S + 1e-12
