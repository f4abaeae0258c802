"""Mirrored twice, an arm is itself; mirrored once, it is its own image in the sagittal plane."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from fusion.kinematics.angles import arm_angles, arm_points_in_trunk, swing_from_direction
from fusion.kinematics.mirror import mirror
from fusion.messages import ArmLengths, FusedFrame, MirrorTarget, TrunkFrame
from fusion.skeleton import JOINT_COUNT, Side, arm

LENGTHS = ArmLengths(0.28, 0.25, 0.08)
SHOULDER = {Side.RIGHT: np.array([0.18, 0.0, 0.0]), Side.LEFT: np.array([-0.18, 0.0, 0.0])}
TRUNK = TrunkFrame(np.zeros(3), np.eye(3))
IMAGE = np.array([-1.0, 1.0, 1.0])
poses = st.tuples(st.floats(-3.1, 3.1), st.floats(0.0, 3.1), st.floats(-3.1, 3.1), st.floats(0.5, 2.6))


def settled(points: np.ndarray, side: Side) -> MirrorTarget:
    """The target once an arm has been held still for two seconds."""
    positions = np.full((JOINT_COUNT, 3), np.nan)
    positions[list(arm(side))] = points
    shape, bound_m = np.tile(1e-4 * np.eye(3), (JOINT_COUNT, 1, 1)), np.full(JOINT_COUNT, 0.01)
    frame = FusedFrame(0.0, positions, shape, bound_m, np.full(JOINT_COUNT, 2, np.uint8))
    target = None
    for k in range(200):
        target = mirror(arm_angles(replace(frame, t_s=0.01 * k), TRUNK, side, LENGTHS), target)
    assert target is not None
    return target


def commanded(target: MirrorTarget) -> np.ndarray:
    """(4, 3) shoulder, elbow, wrist and hand of the arm that obeys."""
    plane, elevation = swing_from_direction(target.direction_in_limb)
    side = target.side
    return arm_points_in_trunk(plane, elevation, target.twist_rad, target.elbow_rad, LENGTHS, side, SHOULDER[side])


@pytest.mark.parametrize("side", list(Side))
@settings(max_examples=25)
@given(pose=poses)
def test_an_arm_that_obeys_is_the_image_and_its_image_is_the_arm(
    side: Side, pose: tuple[float, float, float, float]
) -> None:
    healthy = arm_points_in_trunk(*pose, LENGTHS, side, SHOULDER[side])
    image = commanded(settled(healthy, side))
    np.testing.assert_allclose(image, healthy * IMAGE, atol=1e-6)
    np.testing.assert_allclose(commanded(settled(image, side.other)), healthy, atol=1e-6)
