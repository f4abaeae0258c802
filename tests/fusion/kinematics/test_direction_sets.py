"""The bounds of the angles hold for every body inside the joints' sets."""

from __future__ import annotations

from dataclasses import replace
from itertools import pairwise
from math import pi

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from fusion.kinematics.angles import arm_angles, arm_points_in_trunk, wrapped
from fusion.kinematics.direction_sets import FOREARM_TOLERANCE_M, UPPER_ARM_TOLERANCE_M, spread
from fusion.messages import ArmLengths, Floats, FusedFrame, JointAngles, TrunkFrame
from fusion.skeleton import JOINT_COUNT, Side, arm

LENGTHS = ArmLengths(0.28, 0.25, 0.08)
HERE = TrunkFrame(np.zeros(3), np.eye(3))
JOINTS = list(arm(Side.RIGHT))


def frame_of(points: Floats, shapes: Floats) -> FusedFrame:
    positions = np.full((JOINT_COUNT, 3), np.nan)
    positions[JOINTS] = points
    shape = np.full((JOINT_COUNT, 3, 3), np.nan)
    shape[JOINTS] = shapes
    bound = np.full(JOINT_COUNT, np.nan)
    bound[JOINTS] = np.sqrt(np.linalg.eigvalsh(shapes)[:, -1])
    return FusedFrame(0.0, positions, shape, bound, np.full(JOINT_COUNT, 2, dtype=np.uint8))


def ball(bound_m: float) -> Floats:
    return np.broadcast_to(np.eye(3) * bound_m**2, (4, 3, 3))


def random_sets(rng: np.random.Generator, size_m: float) -> Floats:
    axes = np.linalg.qr(rng.normal(size=(4, 3, 3)))[0]
    widths = size_m * rng.uniform(0.2, 1.0, size=(4, 3))
    return np.einsum("nij,nj,nkj->nik", axes, widths**2, axes)


def inside(rng: np.random.Generator, shapes: Floats) -> Floats:
    """A point on or in each set, as an offset."""
    ways = rng.normal(size=(4, 3))
    ways *= (rng.uniform(0.5, 1.0, size=(4, 1)) ** 0.5) / np.linalg.norm(ways, axis=1, keepdims=True)
    return np.einsum("nij,nj->ni", np.linalg.cholesky(shapes), ways)


def bounds_hold(truth: JointAngles, found: JointAngles) -> None:
    swing = np.arccos(np.clip(truth.direction_in_limb @ found.direction_in_limb, -1, 1))
    assert swing <= found.swing_bound_rad + 1e-9
    assert abs(wrapped(truth.twist_rad - found.twist_rad)) <= found.twist_bound_rad + 1e-9
    assert abs(truth.elbow_flexion_rad - found.elbow_flexion_rad) <= found.elbow_bound_rad + 1e-9


@given(
    pose=st.tuples(st.floats(-3, 3), st.floats(0, 2.9), st.floats(-3, 3), st.floats(0.0, 2.9)),
    size_m=st.floats(0.005, 0.15),
    seed=st.integers(0, 10_000),
)
def test_the_truth_is_within_every_bound(pose: tuple[float, float, float, float], size_m: float, seed: int) -> None:
    rng = np.random.default_rng(seed)
    points = arm_points_in_trunk(*pose, LENGTHS, Side.RIGHT, np.zeros(3))
    truth = arm_angles(frame_of(points, ball(0.01)), HERE, Side.RIGHT, LENGTHS)
    for _ in range(10):
        shapes = random_sets(rng, size_m)
        seen = frame_of(points + inside(rng, shapes), shapes)
        bounds_hold(truth, arm_angles(seen, HERE, Side.RIGHT, LENGTHS))


@given(
    pose=st.tuples(st.floats(-1, 2), st.floats(0.1, 2), st.floats(-1, 1), st.floats(0.8, 2)), seed=st.integers(0, 999)
)
def test_a_learnt_length_that_is_a_little_wrong_breaks_no_bound(
    pose: tuple[float, float, float, float], seed: int
) -> None:
    rng = np.random.default_rng(seed)
    points = arm_points_in_trunk(*pose, LENGTHS, Side.RIGHT, np.zeros(3))
    truth = arm_angles(frame_of(points, ball(0.01)), HERE, Side.RIGHT, LENGTHS)
    learnt = ArmLengths(
        0.28 + rng.uniform(-UPPER_ARM_TOLERANCE_M, UPPER_ARM_TOLERANCE_M),
        0.25 + rng.uniform(-FOREARM_TOLERANCE_M, FOREARM_TOLERANCE_M),
        0.08,
    )
    shapes = random_sets(rng, 0.08)
    bounds_hold(truth, arm_angles(frame_of(points + inside(rng, shapes), shapes), HERE, Side.RIGHT, learnt))


def angles_with(shapes: Floats, elbow_rad: float = pi / 2) -> JointAngles:
    points = arm_points_in_trunk(0.8, 1.0, 0.2, elbow_rad, LENGTHS, Side.RIGHT, np.zeros(3))
    return arm_angles(frame_of(points, shapes), HERE, Side.RIGHT, LENGTHS)


def test_bounds_of_two_centimetres_let_the_arm_be_driven() -> None:
    found = angles_with(ball(0.02))
    assert found.swing_bound_rad < 0.35
    assert found.elbow_bound_rad < 0.6


def test_bounds_grow_with_the_sets() -> None:
    sizes = [angles_with(ball(b)) for b in (0.0, 0.02, 0.05, 0.1, 0.3)]
    for small, large in pairwise(sizes):
        assert small.swing_bound_rad < large.swing_bound_rad
        assert small.twist_bound_rad <= large.twist_bound_rad
        assert small.elbow_bound_rad <= large.elbow_bound_rad
    assert sizes[-1].swing_bound_rad == pi


def test_a_straight_elbow_leaves_the_twist_unknown() -> None:
    assert angles_with(ball(0.01), elbow_rad=0.02).twist_bound_rad == pi
    assert angles_with(ball(0.01)).twist_bound_rad < 0.6


def test_a_badly_seen_elbow_leaves_the_flexion_bounded_by_shoulder_and_wrist() -> None:
    shapes = np.array(ball(0.02))
    shapes[1] = np.eye(3) * 0.3**2
    found = angles_with(shapes)
    assert found.swing_bound_rad > 1.3
    assert found.elbow_bound_rad < 1.0


def test_uncertainty_along_the_segment_costs_less_than_across() -> None:
    thin, wide = 0.01, 0.08
    points = np.array([[0, 0, 0], [0.28, 0, 0], [0.28, 0, -0.25], [0.28, 0, -0.33]], dtype=float)
    along, across = (np.array([np.diag(d) for _ in range(4)]) ** 2 for d in ((wide, thin, thin), (thin, wide, thin)))
    swing = [arm_angles(frame_of(points, s), HERE, Side.RIGHT, LENGTHS).swing_bound_rad for s in (along, across)]
    assert swing[0] < 0.5 * swing[1]


def test_sets_that_are_not_known_claim_nothing() -> None:
    points = arm_points_in_trunk(0.8, 1.0, 0.2, 1.0, LENGTHS, Side.RIGHT, np.zeros(3))
    frame = replace(frame_of(points, ball(0.02)), shape_m2=np.full((JOINT_COUNT, 3, 3), np.nan))
    unknown = replace(frame, bound_m=np.full(JOINT_COUNT, np.inf))
    assert arm_angles(unknown, HERE, Side.RIGHT, LENGTHS).swing_bound_rad == pi
    assert arm_angles(unknown, HERE, Side.RIGHT, LENGTHS).twist_bound_rad == pi
    only_balls = arm_angles(frame, HERE, Side.RIGHT, LENGTHS)
    assert 0.04 / 0.28 < only_balls.swing_bound_rad < 0.3


@given(seed=st.integers(0, 9999))
def test_the_widths_of_a_set_are_those_of_its_shadow(seed: int) -> None:
    rng = np.random.default_rng(seed)
    shapes = random_sets(rng, 0.1)
    points = arm_points_in_trunk(0.8, 1.0, 0.2, 1.4, LENGTHS, Side.RIGHT, np.zeros(3))
    axis = (points[1] - points[0]) / 0.28
    plane = np.eye(3) - np.outer(axis, axis)
    frame = frame_of(points, shapes)
    found = spread(frame.positions_in_room, frame.shape_m2, frame.bound_m, JOINTS[0], JOINTS[1])
    assert found.along_m == pytest.approx(sum(np.sqrt(axis @ shape @ axis) for shape in shapes[:2]))
    assert found.across_m == pytest.approx(
        sum(np.sqrt(np.linalg.eigvalsh(plane @ shape @ plane)[-1]) for shape in shapes[:2])
    )
