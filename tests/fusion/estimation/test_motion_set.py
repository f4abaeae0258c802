"""The law that matters most: the truth stays in the set for every noise and motion that respect their bounds."""

from __future__ import annotations

import numpy as np
from hypothesis import given, settings
from hypothesis import strategies as st

from fusion.estimation import motion_set
from fusion.estimation.ellipsoid import Ellipsoids
from fusion.estimation.motion_set import ACCELERATION_MAX, SPEED_MAX, MotionSet
from fusion.skeleton import JOINT_COUNT

SEEDS = st.integers(0, 2**32 - 1)
ALL = np.ones(JOINT_COUNT, bool)


def a_motion(rng: np.random.Generator, times_s: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Positions and velocities (T, J, 3) of limbs that use their bounds to the full, changing at every instant."""
    position, velocity = rng.normal(size=(JOINT_COUNT, 3)), rng.uniform(-1, 1, (JOINT_COUNT, 3))
    positions, velocities = [position], [velocity]
    for dt in np.diff(times_s):
        push = ACCELERATION_MAX * np.sign(rng.normal(size=velocity.shape)) * rng.choice([0.2, 1.0])
        # An axis at its greatest speed goes on at that speed.
        push = np.where(np.abs(velocity + push * dt) > SPEED_MAX, 0.0, push)
        position, velocity = position + velocity * dt + push * dt**2 / 2, velocity + push * dt
        positions.append(position)
        velocities.append(velocity)
    return np.array(positions), np.array(velocities)


def holds(motion: MotionSet, position: np.ndarray, velocity: np.ndarray) -> np.ndarray:
    """(J,) whether the state is in the set."""
    away = np.stack([position, velocity], axis=-1) - motion.body.centre
    inside = np.einsum("...i,...i", away, np.linalg.solve(motion.body.shape, away[..., None])[..., 0]) <= 1 + 1e-6
    between = (motion.low - 1e-9 <= position) & (position <= motion.high + 1e-9)
    return (inside & between).all(axis=1)


@settings(derandomize=True, max_examples=40, deadline=None)
@given(seed=SEEDS)
def test_the_truth_stays_in_the_set(seed: int) -> None:
    rng = np.random.default_rng(seed)
    times_s = np.cumsum(np.where(rng.uniform(size=60) < 0.05, 0.7, rng.uniform(0.001, 0.05, 60)))  # with silences
    positions, velocities = a_motion(rng, times_s)
    motion = motion_set.anywhere(-np.inf)
    for k, t_s in enumerate(times_s):
        half = rng.uniform(0.02, 0.3, (JOINT_COUNT, 3))
        measured = positions[k] + half * np.sign(rng.normal(size=half.shape)) * rng.choice([0.0, 0.5, 1.0], half.shape)
        motion = motion_set.move(motion, t_s)
        if k == 0:
            motion = motion_set.begin(motion, measured, half, ALL)
        else:
            motion, _ = motion_set.take(motion, measured, half, rng.uniform(size=JOINT_COUNT) < 0.7)
        assert holds(motion, positions[k], velocities[k]).all()
        low, high = motion_set.extent(motion)
        assert (low <= positions[k] + 1e-9).all()
        assert (positions[k] <= high + 1e-9).all()


@settings(derandomize=True, max_examples=30, deadline=None)
@given(seed=SEEDS)
def test_what_is_in_the_set_and_in_the_box_is_in_the_cut_set_in_either_order(seed: int) -> None:
    rng = np.random.default_rng(seed)
    start = rng.normal(size=(JOINT_COUNT, 3))
    half = rng.uniform(0.05, 0.3, (3, JOINT_COUNT, 3))
    motion = motion_set.begin(motion_set.anywhere(0.0), start, half[0], ALL)
    motion = motion_set.move(motion, 0.03)
    true = start + rng.uniform(-0.05, 0.05, start.shape)
    boxes = [(true + rng.uniform(-1, 1, start.shape) * h, h) for h in half[1:]]
    for order in (boxes, boxes[::-1]):
        after = motion
        for middle, h in order:
            after, met = motion_set.take(after, middle, h, ALL)
            assert met.all()
        assert holds(after, true, np.zeros_like(true)).all()
        low, high = motion_set.extent(after)
        for middle, h in boxes:
            assert (low >= middle - h - 1e-9).all()
            assert (high <= middle + h + 1e-9).all()


def test_a_measurement_elsewhere_does_not_meet_and_changes_nothing() -> None:
    half = np.full((JOINT_COUNT, 3), 0.2)
    motion = motion_set.begin(motion_set.anywhere(0.0), np.zeros((JOINT_COUNT, 3)), half, ALL)
    after, met = motion_set.take(motion, np.full((JOINT_COUNT, 3), 1.0), half, ALL)
    assert not met.any()
    np.testing.assert_array_equal(after.body.shape, motion.body.shape)
    np.testing.assert_array_equal(after.low, motion.low)


def test_shapes_stay_symmetric_and_positive_definite_through_an_hour_of_silence_and_back() -> None:
    rng = np.random.default_rng(5)
    half = np.full((JOINT_COUNT, 3), 0.2)
    motion = motion_set.begin(motion_set.anywhere(0.0), np.zeros((JOINT_COUNT, 3)), half, ALL)
    times_s = [*np.arange(1, 600) / 30, 3600.0, *(3600 + np.arange(1, 300) / 30)]
    for t_s in times_s:
        motion = motion_set.move(motion, t_s)
        motion, met = motion_set.take(motion, rng.uniform(-0.1, 0.1, (JOINT_COUNT, 3)), half, ALL)
        assert met.all()
        np.testing.assert_allclose(motion.body.shape, motion.body.shape.swapaxes(-1, -2), rtol=1e-9)
        assert (np.linalg.eigvalsh(motion.body.shape) > 0).all()


def test_in_silence_the_set_grows_no_faster_than_a_limb() -> None:
    half = np.full((JOINT_COUNT, 3), 0.1)
    motion = motion_set.begin(motion_set.anywhere(0.0), np.zeros((JOINT_COUNT, 3)), half, ALL)
    low, high = motion_set.extent(motion_set.move(motion, 1.0))
    assert (high - low <= 2 * (0.1 + SPEED_MAX * 1.0) + 1e-9).all()


def test_a_limb_at_full_acceleration_from_a_known_state_stays_in_the_set() -> None:
    exact = Ellipsoids(np.zeros((JOINT_COUNT, 3, 2)), np.broadcast_to(np.eye(2) * 1e-12, (JOINT_COUNT, 3, 2, 2)))
    nowhere = np.zeros((JOINT_COUNT, 3))
    for dt in (0.005, 0.03, 0.2):
        motion = motion_set.move(MotionSet(0.0, exact, nowhere, nowhere), dt)
        position = np.full((JOINT_COUNT, 3), ACCELERATION_MAX * dt**2 / 2)
        velocity = np.full((JOINT_COUNT, 3), ACCELERATION_MAX * dt)
        assert holds(motion, position, velocity).all()
        assert holds(motion, -position, -velocity).all()
