"""The law that matters most: the truth stays in the set for every noise and motion that respect their bounds."""

from __future__ import annotations

import numpy as np
from hypothesis import given, settings
from hypothesis import strategies as st

from fusion.compiled import Records, record
from fusion.estimation import motion_set
from fusion.estimation.motion_set import ACCELERATION_MAX, SPEED_MAX
from fusion.skeleton import JOINT_COUNT

from .scene import extents

SEEDS = st.integers(0, 2**32 - 1)
JOINT = record(motion_set.FIELDS)
ALL = np.ones(JOINT_COUNT, bool)


def anywhere() -> Records:
    joints = np.zeros(JOINT_COUNT, JOINT)
    for joint in joints:
        motion_set.forget(joint)
    return joints


def begun(positions: np.ndarray, half: np.ndarray) -> Records:
    joints = anywhere()
    for joint, row, width in zip(joints, positions.tolist(), half.tolist(), strict=True):
        motion_set.begin(joint, tuple(row), tuple(width))
    return joints


def moved(joints: Records, dt: float) -> Records:
    joints = joints.copy()
    for joint in joints:
        motion_set.move(joint, float(dt))
    return joints


def taken(joints: Records, positions: np.ndarray, half: np.ndarray, used: np.ndarray) -> tuple[Records, np.ndarray]:
    """The joints cut with their measurements where `used`, and which of those met."""
    joints, met = joints.copy(), np.zeros(JOINT_COUNT, bool)
    for j in np.flatnonzero(used):
        met[j] = motion_set.take(joints[j], tuple(positions[j].tolist()), tuple(half[j].tolist()))
    return joints, met


def shapes(joints: Records) -> np.ndarray:
    """(J, 3, 2, 2)."""
    on = joints["on"]
    return np.stack([on["pp"], on["pv"], on["pv"], on["vv"]], axis=-1).reshape(JOINT_COUNT, 3, 2, 2)


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


def holds(joints: Records, position: np.ndarray, velocity: np.ndarray) -> np.ndarray:
    """(J,) whether the state is in the set."""
    on = joints["on"]
    away = np.stack([position - on["p"], velocity - on["v"]], axis=-1)
    inside = np.einsum("...i,...i", away, np.linalg.solve(shapes(joints), away[..., None])[..., 0]) <= 1 + 1e-6
    between = (on["low"] - 1e-9 <= position) & (position <= on["high"] + 1e-9)
    return (inside & between).all(axis=1)


@settings(derandomize=True, max_examples=40, deadline=None)
@given(seed=SEEDS)
def test_the_truth_stays_in_the_set(seed: int) -> None:
    rng = np.random.default_rng(seed)
    times_s = np.cumsum(np.where(rng.uniform(size=60) < 0.05, 0.7, rng.uniform(0.001, 0.05, 60)))  # with silences
    positions, velocities = a_motion(rng, times_s)
    for k, t_s in enumerate(times_s):
        half = rng.uniform(0.02, 0.3, (JOINT_COUNT, 3))
        measured = positions[k] + half * np.sign(rng.normal(size=half.shape)) * rng.choice([0.0, 0.5, 1.0], half.shape)
        if k == 0:
            joints = begun(measured, half)
        else:
            joints = moved(joints, t_s - times_s[k - 1])
            joints, _ = taken(joints, measured, half, rng.uniform(size=JOINT_COUNT) < 0.7)
        assert holds(joints, positions[k], velocities[k]).all()
        low, high = extents(joints)
        assert (low <= positions[k] + 1e-9).all()
        assert (positions[k] <= high + 1e-9).all()


@settings(derandomize=True, max_examples=30, deadline=None)
@given(seed=SEEDS)
def test_what_is_in_the_set_and_in_the_box_is_in_the_cut_set_in_either_order(seed: int) -> None:
    rng = np.random.default_rng(seed)
    start = rng.normal(size=(JOINT_COUNT, 3))
    half = rng.uniform(0.05, 0.3, (3, JOINT_COUNT, 3))
    joints = moved(begun(start, half[0]), 0.03)
    true = start + rng.uniform(-0.05, 0.05, start.shape)
    boxes = [(true + rng.uniform(-1, 1, start.shape) * h, h) for h in half[1:]]
    for order in (boxes, boxes[::-1]):
        after = joints
        for middle, h in order:
            after, met = taken(after, middle, h, ALL)
            assert met.all()
        assert holds(after, true, np.zeros_like(true)).all()
        low, high = extents(after)
        for middle, h in boxes:
            assert (low >= middle - h - 1e-9).all()
            assert (high <= middle + h + 1e-9).all()


def test_a_measurement_elsewhere_does_not_meet_and_changes_nothing() -> None:
    half = np.full((JOINT_COUNT, 3), 0.2)
    joints = begun(np.zeros((JOINT_COUNT, 3)), half)
    after, met = taken(joints, np.full((JOINT_COUNT, 3), 1.0), half, ALL)
    assert not met.any()
    np.testing.assert_array_equal(after, joints)


def test_shapes_stay_positive_definite_through_an_hour_of_silence_and_back() -> None:
    rng = np.random.default_rng(5)
    half = np.full((JOINT_COUNT, 3), 0.2)
    joints = begun(np.zeros((JOINT_COUNT, 3)), half)
    times_s = [0.0, *np.arange(1, 600) / 30, 3600.0, *(3600 + np.arange(1, 300) / 30)]
    for dt in np.diff(times_s):
        joints = moved(joints, dt)
        joints, met = taken(joints, rng.uniform(-0.1, 0.1, (JOINT_COUNT, 3)), half, ALL)
        assert met.all()
        assert (np.linalg.eigvalsh(shapes(joints)) > 0).all()


def test_in_silence_the_set_grows_no_faster_than_a_limb() -> None:
    half = np.full((JOINT_COUNT, 3), 0.1)
    low, high = extents(moved(begun(np.zeros((JOINT_COUNT, 3)), half), 1.0))
    assert (high - low <= 2 * (0.1 + SPEED_MAX * 1.0) + 1e-9).all()


def test_a_limb_at_full_acceleration_from_a_known_state_stays_in_the_set() -> None:
    exact = np.zeros(JOINT_COUNT, JOINT)
    exact["on"]["pp"] = exact["on"]["vv"] = 1e-12
    for dt in (0.005, 0.03, 0.2):
        joints = moved(exact, dt)
        position = np.full((JOINT_COUNT, 3), ACCELERATION_MAX * dt**2 / 2)
        velocity = np.full((JOINT_COUNT, 3), ACCELERATION_MAX * dt)
        assert holds(joints, position, velocity).all()
        assert holds(joints, -position, -velocity).all()
