"""Laws of the arm's angles: forward and backward, sides, ISB, rigid motion, known poses."""

from __future__ import annotations

from math import pi

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from scipy.spatial.transform import Rotation

from fusion.kinematics.angles import (
    arm_angles,
    arm_points_in_trunk,
    direction_from_swing,
    forearm_from_twist,
    swing_from_direction,
    twist_from_forearm,
    wrapped,
)
from fusion.messages import ArmLengths, Floats, FusedFrame, JointAngles, TrunkFrame
from fusion.skeleton import JOINT_COUNT, SIDES_SWAPPED, Side, arm

LENGTHS = ArmLengths(0.28, 0.25, 0.08)
SHOULDER = np.array([0.18, 0.0, 0.0])
BOTH = pytest.mark.parametrize("side", list(Side))

planes = st.floats(-3.1, 3.1)
elevations = st.floats(0.05, 3.0)
twists = st.floats(-3.1, 3.1)
elbows = st.floats(0.05, 3.0)
poses = st.tuples(planes, elevations, twists, elbows)
rotations = st.tuples(*[st.floats(-3, 3)] * 3).map(lambda v: Rotation.from_rotvec(v).as_matrix())

HERE = TrunkFrame(np.zeros(3), np.eye(3))


def shoulder_of(side: Side) -> Floats:
    return SHOULDER * ([1, 1, 1] if side is Side.RIGHT else [-1, 1, 1])


def frame_of(points: Floats, side: Side, bound_m: float = 0.01) -> FusedFrame:
    positions = np.full((JOINT_COUNT, 3), np.nan)
    positions[list(arm(side))] = points
    state = np.where(np.isnan(positions[:, 0]), 0, 2).astype(np.uint8)
    shape = np.broadcast_to(np.eye(3) * bound_m**2, (JOINT_COUNT, 3, 3))
    return FusedFrame(1.5, positions, shape, np.full(JOINT_COUNT, bound_m), state)


def posed(pose: tuple[float, float, float, float], side: Side) -> FusedFrame:
    return frame_of(arm_points_in_trunk(*pose, LENGTHS, side, shoulder_of(side)), side)


def angles_of(points: Floats, side: Side = Side.RIGHT) -> JointAngles:
    return arm_angles(frame_of(points, side), HERE, side, LENGTHS)


def close(a: float, b: float, within: float = 1e-6) -> bool:
    return abs(wrapped(a - b)) < within


@BOTH
@given(pose=poses)
def test_angles_of_an_arm_built_from_angles_are_those_angles(
    side: Side, pose: tuple[float, float, float, float]
) -> None:
    found = arm_angles(posed(pose, side), HERE, side, LENGTHS)
    plane, elevation = swing_from_direction(found.direction_in_limb)
    assert found.valid
    assert close(plane, pose[0])
    assert close(elevation, pose[1])
    assert close(found.twist_rad, pose[2])
    assert close(found.elbow_flexion_rad, pose[3])


@BOTH
@given(pose=poses)
def test_an_arm_built_from_an_arms_angles_is_that_arm(side: Side, pose: tuple[float, float, float, float]) -> None:
    points = arm_points_in_trunk(*pose, LENGTHS, side, shoulder_of(side))
    found = angles_of(points, side)
    again = arm_points_in_trunk(
        found.plane_of_elevation_rad,
        found.elevation_rad,
        found.twist_rad,
        found.elbow_flexion_rad,
        LENGTHS,
        side,
        shoulder_of(side),
    )
    np.testing.assert_allclose(again, points, atol=1e-9)


@given(pose=poses)
def test_a_mirrored_skeletons_other_arm_has_equal_angles(pose: tuple[float, float, float, float]) -> None:
    right = posed(pose, Side.RIGHT)
    mirrored = right.positions_in_room[SIDES_SWAPPED] * [-1, 1, 1]
    left = angles_of(mirrored[list(arm(Side.LEFT))], Side.LEFT)
    original = arm_angles(right, HERE, Side.RIGHT, LENGTHS)
    for name in (
        "plane_of_elevation",
        "elevation",
        "axial_rotation",
        "elbow_flexion",
        "alpha",
        "beta",
        "gamma",
        "twist",
    ):
        assert close(getattr(left, f"{name}_rad"), getattr(original, f"{name}_rad")), name


@given(pose=poses, turn=rotations, shift=st.tuples(*[st.floats(-3, 3)] * 3))
def test_moving_the_whole_body_changes_no_angle(
    pose: tuple[float, float, float, float], turn: Floats, shift: tuple[float, float, float]
) -> None:
    points = arm_points_in_trunk(*pose, LENGTHS, Side.LEFT, shoulder_of(Side.LEFT))
    moved = frame_of(points @ turn.T + shift, Side.LEFT)
    found = arm_angles(moved, TrunkFrame(np.asarray(shift), turn), Side.LEFT, LENGTHS)
    still = angles_of(points, Side.LEFT)
    np.testing.assert_allclose(found.direction_in_limb, still.direction_in_limb, atol=1e-9)
    assert close(found.twist_rad, still.twist_rad)
    assert close(found.elbow_flexion_rad, still.elbow_flexion_rad)


@given(pose=poses)
def test_isb_angles_are_the_euler_angles_of_the_humerus(pose: tuple[float, float, float, float]) -> None:
    # ISB axes X ahead, Y up, Z right = limb's (-back, up, outward); the humerus' Y points to the shoulder and its
    # X is where a bent forearm points (Wu 2005, second option).
    points = arm_points_in_trunk(*pose, LENGTHS, Side.RIGHT, SHOULDER)
    upper, forearm = (points[1] - points[0]) / 0.28, (points[2] - points[1]) / 0.25
    ahead = forearm - (forearm @ upper) * upper
    ahead /= np.linalg.norm(ahead)
    to_isb = np.array([[0, 0, -1], [0, 1, 0], [1, 0, 0]], dtype=float)
    x, y = to_isb @ ahead, to_isb @ -upper
    humerus = Rotation.from_matrix(np.column_stack([x, y, np.cross(x, y)]))
    found = angles_of(points)
    expected = Rotation.from_euler(
        "YXY", [found.plane_of_elevation_rad, -found.elevation_rad, found.axial_rotation_rad]
    )
    np.testing.assert_allclose(humerus.as_matrix(), expected.as_matrix(), atol=1e-6)


@BOTH
@pytest.mark.parametrize(
    ("outward_up_back", "plane_deg", "elevation_deg", "alpha_deg"),
    [
        ((0, -1, 0), 0, 0, 180),
        ((1, 0, 0), 0, 90, 90),
        ((0, 0, -1), 90, 90, 90),
        ((0, 0, 1), -90, 90, 90),
        ((0, 1, 0), 0, 180, 0),
    ],
    ids=["hanging", "sideways", "ahead", "behind", "overhead"],
)
def test_known_poses(
    side: Side, outward_up_back: tuple[int, int, int], plane_deg: float, elevation_deg: float, alpha_deg: float
) -> None:
    direction = np.array(outward_up_back, dtype=float) * ([1, 1, 1] if side is Side.RIGHT else [-1, 1, 1])
    points = np.array([0.0, 0.28, 0.53, 0.61])[:, None] * direction
    found = angles_of(points, side)
    assert np.rad2deg(found.plane_of_elevation_rad) == pytest.approx(plane_deg)
    assert np.rad2deg(found.elevation_rad) == pytest.approx(elevation_deg)
    assert np.rad2deg(found.alpha_rad) == pytest.approx(alpha_deg)
    assert found.elbow_flexion_rad == pytest.approx(0, abs=1e-7)


@BOTH
def test_a_hanging_arm_with_the_elbow_at_a_right_angle_points_ahead_at_twist_zero_and_inward_at_internal_rotation(
    side: Side,
) -> None:
    inward = -1.0 if side is Side.RIGHT else 1.0
    down = np.array([[0, 0, 0], [0, -0.28, 0]], dtype=float)
    for forearm, twist in (((0, 0, -1), 0.0), ((inward, 0, 0), pi / 2), ((-inward, 0, 0), -pi / 2)):
        wrist = down[1] + 0.25 * np.array(forearm, dtype=float)
        found = angles_of(np.vstack([down, wrist, wrist]), side)
        assert found.elbow_flexion_rad == pytest.approx(pi / 2)
        assert found.twist_rad == pytest.approx(twist)
        assert found.axial_rotation_rad == pytest.approx(twist)
        assert found.gamma_rad == pytest.approx(pi / 2)


def test_beta_is_measured_from_the_axis_towards_the_other_shoulder() -> None:
    out, up = angles_of(np.array([[0, 0, 0], [0.28, 0, 0], [0.5, 0, 0], [0.6, 0, 0]])), Side.LEFT
    assert out.beta_rad == pytest.approx(pi)
    across = angles_of(np.array([[0, 0, 0], [0.28, 0, 0], [0.5, 0, 0], [0.6, 0, 0]]), up)
    assert across.beta_rad == pytest.approx(0)


@given(pose=poses, direction=st.tuples(*[st.floats(-1, 1)] * 3))
def test_the_twist_moves_little_when_the_arm_moves_little(
    pose: tuple[float, float, float, float], direction: tuple[float, float, float]
) -> None:
    plane, elevation, twist, _ = pose
    upper = direction_from_swing(plane, min(elevation, 2.5))
    step = 1e-4
    moved = upper + step * np.array(direction)
    moved /= np.linalg.norm(moved)
    forearm = forearm_from_twist(upper, twist, 1.2)
    assert close(twist_from_forearm(upper, forearm), twist_from_forearm(moved, forearm), 20 * step)


H = 1e-6
moves = st.lists(st.floats(-1, 1), min_size=9, max_size=9).map(lambda parts: H * np.reshape(parts, (3, 3)) / np.sqrt(3))
TURNED = 1.01 * (2 * H / LENGTHS.upper_arm_m + 2 * H / LENGTHS.forearm_m)
"""Joints that move by H turn the two segments by no more than this."""


def before_and_after(pose: tuple[float, float, float, float], move: Floats, side: Side) -> list[JointAngles]:
    points = arm_points_in_trunk(*pose, LENGTHS, side, shoulder_of(side))
    return [angles_of(points + np.vstack([step, np.zeros(3)]), side) for step in (0 * move, move)]


@BOTH
@given(pose=st.tuples(planes, st.floats(0.0, pi), twists, st.floats(0.0, pi)), move=moves)
def test_swing_and_flexion_are_continuous_through_the_workspace(
    side: Side, pose: tuple[float, float, float, float], move: Floats
) -> None:
    """Also where the arm hangs or points up, and where the elbow is straight."""
    before, after = before_and_after(pose, move, side)
    assert np.linalg.norm(after.direction_in_limb - before.direction_in_limb) <= TURNED
    assert abs(after.elbow_flexion_rad - before.elbow_flexion_rad) <= TURNED


@BOTH
@given(pose=st.tuples(planes, st.floats(0.0, 2.6), twists, st.floats(0.01, 3.1)), move=moves)
def test_the_twist_is_continuous_but_for_straight_elbows_and_arms_overhead(
    side: Side, pose: tuple[float, float, float, float], move: Floats
) -> None:
    """It turns with the segments over the sine of the bend, and with the swing by the tangent of half the elevation."""
    before, after = before_and_after(pose, move, side)
    about = abs(wrapped(after.twist_rad - before.twist_rad)) * np.sin(before.elbow_flexion_rad)
    assert about <= TURNED * (1 + np.tan(0.5 * before.elevation_rad))


def test_a_lost_elbow_gives_no_angles() -> None:
    frame = posed((0.3, 1.0, 0.2, 1.0), Side.LEFT)
    frame.state[arm(Side.LEFT)[1]] = 0
    found = arm_angles(frame, HERE, Side.LEFT, LENGTHS)
    assert not found.valid
    assert np.isnan(found.elevation_rad)
    assert found.swing_bound_rad == pi
