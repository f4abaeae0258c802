"""The command is continuous through the workspace: a body that moves little in a tick moves the target little."""

from __future__ import annotations

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from scipy.interpolate import CubicSpline
from scipy.spatial.transform import Rotation

from fusion.kinematics.angles import arm_angles, arm_points_in_trunk, wrapped
from fusion.kinematics.body_frame import trunk_frame
from fusion.kinematics.mirror import TWIST_RATE_RAD_S, mirror
from fusion.messages import ArmLengths, FusedFrame
from fusion.skeleton import INDEX, JOINT_COUNT, Side, arm

LENGTHS = ArmLengths(0.28, 0.25, 0.08)
TICK_S = 0.01
STATIONS = 6
SINGULAR = {"hanging": (0.0, None), "overhead": (np.pi, None), "straight": (None, 0.0), "anywhere": (None, None)}
SHOULDER_M = 0.18
SHAPE, BOUND_M = np.tile(1e-4 * np.eye(3), (JOINT_COUNT, 1, 1)), np.full(JOINT_COUNT, 0.01)


def a_path(rng: np.random.Generator, where: str) -> np.ndarray:
    """(T, 4) plane, elevation, twist, elbow: a smooth way through a few poses, each near the singular one asked for."""
    low, high = np.array([-1.0, 0.0, -1.5, 0.0]), np.array([2.3, np.pi, 1.5, 2.6])
    stations = rng.uniform(low, high, (STATIONS, 4))
    elevation, elbow = SINGULAR[where]
    if elevation is not None:
        stations[1:-1:2, 1] = elevation + rng.normal(0, 0.02, len(stations[1:-1:2]))
    if elbow is not None:
        stations[1:-1:2, 3] = np.abs(rng.normal(0, 0.02, len(stations[1:-1:2])))
    return CubicSpline(np.arange(STATIONS), stations)(np.arange(0, STATIONS - 1, TICK_S / 0.6))


def body(pose: np.ndarray, side: Side, lean: Rotation) -> np.ndarray:
    """(25, 3) m: a trunk that leans, and the arm."""
    positions = np.full((JOINT_COUNT, 3), np.nan)
    for name, place in (("SpineBase", (0, -0.5, 0)), ("SpineShoulder", (0, 0, 0)), ("Neck", (0, 0.08, 0))):
        positions[INDEX[name]] = place
    for each, x in ((Side.RIGHT, SHOULDER_M), (Side.LEFT, -SHOULDER_M)):
        positions[arm(each)[0]] = (x, 0, 0)
    outward = SHOULDER_M if side is Side.RIGHT else -SHOULDER_M
    positions[list(arm(side))] = arm_points_in_trunk(*pose.tolist(), LENGTHS, side, np.array([outward, 0.0, 0.0]))
    return lean.apply(positions) + np.array([0.1, 0.2, 2.5])


@pytest.mark.parametrize("side", list(Side))
@settings(max_examples=24)
@given(seed=st.integers(0, 2**32 - 1), where=st.sampled_from(list(SINGULAR)))
def test_a_body_that_moves_little_moves_the_target_little(side: Side, seed: int, where: str) -> None:
    rng = np.random.default_rng(seed)
    lean_to = rng.uniform(-0.5, 0.5, 3)
    path = a_path(rng, where)
    positions, target, angles = None, None, None
    for k, pose in enumerate(path):
        before, told, known = positions, target, angles
        positions = body(pose, side, Rotation.from_rotvec(lean_to * np.sin(k / 40)))
        frame = FusedFrame(k * TICK_S, positions, SHAPE, BOUND_M, np.full(JOINT_COUNT, 2, np.uint8))
        trunk = trunk_frame(positions)
        assert trunk is not None
        angles = arm_angles(frame, trunk, side, LENGTHS)
        target = mirror(angles, told)
        if before is None or told is None or known is None:
            continue
        step_m = float(np.nanmax(np.linalg.norm(positions - before, axis=1)))
        turned = 1.01 * step_m * (2 / LENGTHS.upper_arm_m + 2 / LENGTHS.forearm_m + 2 / SHOULDER_M + 2 / 0.5)
        assert np.linalg.norm(target.direction_in_limb - told.direction_in_limb) <= turned
        assert abs(target.elbow_rad - told.elbow_rad) <= turned
        assert abs(wrapped(target.twist_rad - told.twist_rad)) <= TWIST_RATE_RAD_S * TICK_S + 1e-9
        if 0.3 < angles.elevation_rad < np.pi - 0.3 and 0.3 < known.elevation_rad < np.pi - 0.3:
            plane = wrapped(angles.plane_of_elevation_rad - known.plane_of_elevation_rad)
            assert abs(plane) <= turned / np.sin(0.3)
            assert abs(angles.elevation_rad - known.elevation_rad) <= turned
            if angles.elbow_flexion_rad > 0.3 and known.elbow_flexion_rad > 0.3:
                assert (
                    abs(wrapped(angles.axial_rotation_rad - known.axial_rotation_rad)) <= 3 * turned / np.sin(0.3) ** 2
                )
