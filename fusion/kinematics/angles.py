"""An arm's angles from its joints, and an arm's joints from its angles.

Everything is computed in limb coordinates (outward, up, back): equal numbers on both sides are mirror images, so a left
arm is a right arm here and no left-handed matrix ever becomes a rotation.
"""

from __future__ import annotations

from math import atan2, cos, hypot, isnan, pi, sin
from typing import Final, NamedTuple

import numpy as np

from fusion.compiled import kernel
from fusion.kinematics.direction_sets import (
    FOREARM_TOLERANCE_M,
    UPPER_ARM_TOLERANCE_M,
    ArmBounds,
    Segment,
    arm_bounds,
    spread,
)
from fusion.kinematics.vectors import Triple, Vector, angle_between, dot, length, step, sum_of, unit
from fusion.messages import ArmLengths, Floats, FusedFrame, JointAngles, TrunkFrame
from fusion.skeleton import Side, TrackingState, arm

HANGING: Final[Vector] = (0.0, -1.0, 0.0)
INWARD: Final[Vector] = (-1.0, 0.0, 0.0)
AHEAD: Final[Vector] = (0.0, 0.0, -1.0)
ARM_JOINTS: Final = {side: arm(side)[:3] for side in Side}
"""Shoulder, elbow, wrist."""
OUTWARD: Final = {Side.RIGHT: 1.0, Side.LEFT: -1.0}
"""Sign of the trunk's x in limb coordinates."""
Joints = tuple[int, int, int]


class Pose(NamedTuple):
    """How an arm is held."""

    upper: Vector
    """Unit vector of the upper arm as (outward, up, back)."""
    plane: float
    elevation: float
    flexion: float
    twist: float


class PerAngle(NamedTuple):
    """One number for each of an arm's three angles, in radians."""

    swing: float
    elbow: float
    turn: float
    """Of the forearm about the upper arm, as an arc: the twist's times the sine of the flexion."""


UNWITNESSED: Final = PerAngle(pi, pi, pi)


def arm_angles(
    frame: FusedFrame, trunk: TrunkFrame, side: Side, lengths: ArmLengths, witnessed: PerAngle = UNWITNESSED
) -> JointAngles:
    """One arm's angles and their bounds.

    ISB (Wu et al. 2005, humerus Y-X-Y): with p, e, t the swing's plane and elevation and the twist, the humerus is
    Y(p) X(−e) Y(−p) · Y(t), so its axial rotation is t − p. [Du2016 §1.3]: α from +y, β of the projection on the
    frontal plane from the axis towards the other shoulder, γ between the segments.

    Args:
        frame: the fused body.
        trunk: its trunk.
        side: which arm.
        lengths: its learnt segment lengths, which turn joint sets into direction sets.
        witnessed: bounds learnt from the sensors (`witnesses`); the less of these and of the joints' sets is told.

    Returns:
        The angles; `valid` is False and the angles NaN where shoulder, elbow or wrist is lost.
    """
    joints = ARM_JOINTS[side]
    positions, rotation = frame.positions_in_room, trunk.rotation_trunk_to_room
    pose = arm_pose(positions, rotation, OUTWARD[side], joints)
    if isnan(pose.flexion) or any(frame.state[joint] == TrackingState.LOST for joint in joints):
        return _unknown(frame.t_s, side)
    known_m = (lengths.upper_arm_m, lengths.forearm_m)
    bounds = _bounds(pose, positions, frame.shape_m2, frame.bound_m, joints, known_m, witnessed)
    return JointAngles(
        t_s=frame.t_s,
        side=side,
        plane_of_elevation_rad=pose.plane,
        elevation_rad=pose.elevation,
        axial_rotation_rad=wrapped(pose.twist - pose.plane),
        elbow_flexion_rad=pose.flexion,
        alpha_rad=pi - pose.elevation,
        beta_rad=atan2(pose.upper[1], -pose.upper[0]),
        gamma_rad=pose.flexion,
        direction_in_limb=np.array(pose.upper),
        twist_rad=pose.twist,
        swing_bound_rad=bounds.swing,
        twist_bound_rad=bounds.twist,
        elbow_bound_rad=bounds.elbow,
        valid=True,
    )


def _unknown(t_s: float, side: Side) -> JointAngles:
    nan = float("nan")
    return JointAngles(
        t_s=t_s,
        side=side,
        plane_of_elevation_rad=nan,
        elevation_rad=nan,
        axial_rotation_rad=nan,
        elbow_flexion_rad=nan,
        alpha_rad=nan,
        beta_rad=nan,
        gamma_rad=nan,
        direction_in_limb=np.full(3, nan),
        twist_rad=nan,
        swing_bound_rad=pi,
        twist_bound_rad=pi,
        elbow_bound_rad=pi,
        valid=False,
    )


@kernel
def arm_pose(positions: Floats, rotation_trunk_to_room: Floats, outward: float, joints: Joints) -> Pose:
    """How the arm of `joints` is held in a trunk; all NaN where a joint is missing or two fall together.

    Args:
        positions: (J, 3) m in the room.
        rotation_trunk_to_room: (3, 3).
        outward: `OUTWARD` of the side.
        joints: shoulder, elbow, wrist.
    """
    shoulder, elbow, wrist = joints
    upper = unit(to_limb(step(positions, shoulder, elbow, 1.0), rotation_trunk_to_room, outward))
    forearm = unit(to_limb(step(positions, elbow, wrist, 1.0), rotation_trunk_to_room, outward))
    return pose_of(upper, forearm)


@kernel
def pose_of(upper: Triple, forearm: Triple) -> Pose:
    """The angles of two unit vectors in limb coordinates."""
    plane, elevation = swing_from_direction(upper)
    direction = (upper[0], upper[1], upper[2])
    twist = twist_from_forearm(upper, forearm)
    return Pose(direction, plane, elevation, angle_between(upper, forearm), twist)


@kernel
def _bounds(
    pose: Pose,
    positions: Floats,
    shape_m2: Floats,
    bound_m: Floats,
    joints: Joints,
    known_m: tuple[float, float],
    witnessed: PerAngle,
) -> ArmBounds:
    """Bounds of swing, twist and elbow: from the joints' sets, or as witnessed."""
    shoulder, elbow, wrist = joints
    upper_m, forearm_m = length(step(positions, shoulder, elbow, 1.0)), length(step(positions, elbow, wrist, 1.0))
    segments = (
        Segment(upper_m, known_m[0], UPPER_ARM_TOLERANCE_M),
        Segment(forearm_m, known_m[1], FOREARM_TOLERANCE_M),
    )
    spreads = (
        spread(positions, shape_m2, bound_m, shoulder, elbow),
        spread(positions, shape_m2, bound_m, elbow, wrist),
        spread(positions, shape_m2, bound_m, shoulder, wrist),
    )
    apart_m = length(step(positions, shoulder, wrist, 1.0))
    sets = arm_bounds(pose.elevation, pose.flexion, segments, spreads, apart_m)
    twist = witnessed.turn / max(sin(pose.flexion), 1e-9)
    return ArmBounds(min(sets.swing, witnessed.swing), min(sets.twist, twist), min(sets.elbow, witnessed.elbow))


def direction_from_swing(plane_rad: float, elevation_rad: float) -> Floats:
    """The upper arm's unit vector (outward, up, back); plane 0 = sideways, π/2 = ahead; elevation 0 = hanging."""
    return np.array([sin(elevation_rad) * cos(plane_rad), -cos(elevation_rad), -sin(elevation_rad) * sin(plane_rad)])


@kernel
def swing_from_direction(direction_in_limb: Triple) -> tuple[float, float]:
    """Plane in (−π, π] and elevation in [0, π] of an upper arm's direction; the plane is 0 where it is undefined."""
    outward, up, back = direction_in_limb[0], direction_in_limb[1], direction_in_limb[2]
    level = hypot(outward, back)
    plane = atan2(-back, outward) if level > 0.0 else 0.0
    return plane, atan2(level, -up)


@kernel
def twist_from_forearm(upper: Triple, forearm: Triple) -> float:
    """The humerus' rotation after the least swing from the hanging arm; internal +; 0 where the forearm does not tell.

    Args:
        upper: (3,) unit vector of the upper arm in limb coordinates.
        forearm: (3,) unit vector of the forearm in limb coordinates.
    """
    hanging = _carried(sum_of(forearm, upper, -dot(forearm, upper)), upper, HANGING)
    return atan2(dot(hanging, INWARD), dot(hanging, AHEAD))


def forearm_from_twist(upper: Floats, twist_rad: float, elbow_rad: float) -> Floats:
    """The forearm's unit vector in limb coordinates; inverse of `twist_from_forearm`."""
    across = _carried((-sin(twist_rad), 0.0, -cos(twist_rad)), HANGING, upper)
    return np.asarray(cos(elbow_rad) * upper + sin(elbow_rad) * np.array(across))


def arm_points_in_trunk(
    plane: float,
    elevation: float,
    rotation: float,
    elbow: float,
    lengths: ArmLengths,
    side: Side,
    shoulder_in_trunk: Floats,
) -> Floats:
    """Shoulder, elbow, wrist and hand of an arm at the joint angles of the exoskeleton (radians).

    Args:
        plane: of the swing, 0 = sideways, π/2 = ahead.
        elevation: of the swing, 0 = hanging.
        rotation: of the humerus after the swing, internal +.
        elbow: flexion, 0 = straight.
        lengths: of the segments.
        side: which arm.
        shoulder_in_trunk: (3,) m.

    Returns:
        (4, 3) m in the trunk frame; the hand continues the forearm.
    """
    upper = direction_from_swing(plane, elevation)
    forearm = forearm_from_twist(upper, rotation, elbow)
    steps = np.array([np.zeros(3), lengths.upper_arm_m * upper, lengths.forearm_m * forearm, lengths.hand_m * forearm])
    return np.asarray(shoulder_in_trunk + np.cumsum(steps, axis=0) * (OUTWARD[side], 1.0, 1.0))


@kernel
def wrapped(angle_rad: float) -> float:
    """The same angle in (−π, π]."""
    return atan2(sin(angle_rad), cos(angle_rad))


@kernel
def to_limb(vector_in_room: Triple, rotation_trunk_to_room: Floats, outward: float) -> Vector:
    """(outward, up, back) of a room vector."""
    x, y, z = vector_in_room
    axes = rotation_trunk_to_room
    return (
        outward * (x * axes[0, 0] + y * axes[1, 0] + z * axes[2, 0]),
        x * axes[0, 1] + y * axes[1, 1] + z * axes[2, 1],
        x * axes[0, 2] + y * axes[1, 2] + z * axes[2, 2],
    )


@kernel
def _carried(across: Triple, start: Triple, end: Triple) -> Vector:
    """A vector perpendicular to `start`, turned by the least rotation that takes `start` to `end` (unit vectors).

    v − (v·end) / (1 + start·end) · (start + end); undefined only where they are opposed (an arm straight overhead).
    """
    together = max(1.0 + dot(start, end), 1e-12)
    return sum_of(across, sum_of(start, end, 1.0), -dot(across, end) / together)
