"""An arm's angles from its joints, and an arm's joints from its angles.

Everything is computed in limb coordinates (outward, up, back): equal numbers on both sides are mirror images, so a left
arm is a right arm here and no left-handed matrix ever becomes a rotation.
"""

from __future__ import annotations

from math import atan2, cos, pi, sin
from typing import Final

import numpy as np

from fusion.kinematics import direction_sets
from fusion.messages import ArmLengths, Floats, FusedFrame, JointAngles, TrunkFrame
from fusion.skeleton import Side, TrackingState, arm

HANGING: Final[Floats] = np.array([0.0, -1.0, 0.0])
INWARD: Final[Floats] = np.array([-1.0, 0.0, 0.0])
AHEAD: Final[Floats] = np.array([0.0, 0.0, -1.0])


def arm_angles(frame: FusedFrame, trunk: TrunkFrame, side: Side, lengths: ArmLengths) -> JointAngles:
    """One arm's angles and their bounds.

    ISB (Wu et al. 2005, humerus Y-X-Y): with p, e, t the swing's plane and elevation and the twist, the humerus is
    Y(p) X(−e) Y(−p) · Y(t), so its axial rotation is t − p. [Du2016 §1.3]: α from +y, β of the projection on the
    frontal plane from the axis towards the other shoulder, γ between the segments.

    Args:
        frame: the fused body.
        trunk: its trunk.
        side: which arm.
        lengths: its learnt segment lengths, which turn joint sets into direction sets.

    Returns:
        The angles; `valid` is False and the angles NaN where shoulder, elbow or wrist is lost.
    """
    shoulder, elbow, wrist, _ = arm(side)
    upper, forearm = (
        _to_limb(frame.positions_in_room[b] - frame.positions_in_room[a], trunk, side)
        for a, b in ((shoulder, elbow), (elbow, wrist))
    )
    seen = bool((frame.state[[shoulder, elbow, wrist]] > TrackingState.LOST).all())
    upper_m, forearm_m = float(np.linalg.norm(upper)), float(np.linalg.norm(forearm))
    if not (seen and upper_m > 0 and forearm_m > 0):
        return _unknown(frame.t_s, side)
    return _known(frame, side, lengths, upper / upper_m, forearm / forearm_m)


def _known(frame: FusedFrame, side: Side, lengths: ArmLengths, upper: Floats, forearm: Floats) -> JointAngles:
    plane, elevation = swing_from_direction(upper)
    flexion = _angle_between(upper, forearm)
    twist = twist_from_forearm(upper, forearm)
    swing_bound, twist_bound, elbow_bound = _bounds(frame, side, lengths, elevation, flexion)
    return JointAngles(
        t_s=frame.t_s,
        side=side,
        plane_of_elevation_rad=plane,
        elevation_rad=elevation,
        axial_rotation_rad=wrapped(twist - plane),
        elbow_flexion_rad=flexion,
        alpha_rad=pi - elevation,
        beta_rad=atan2(upper[1], -upper[0]),
        gamma_rad=flexion,
        direction_in_limb=upper,
        twist_rad=twist,
        swing_bound_rad=swing_bound,
        twist_bound_rad=twist_bound,
        elbow_bound_rad=elbow_bound,
        valid=True,
    )


def _bounds(
    frame: FusedFrame, side: Side, lengths: ArmLengths, elevation: float, flexion: float
) -> tuple[float, float, float]:
    """Bounds of swing, twist and elbow."""
    shoulder, elbow, wrist, _ = arm(side)
    swing = _segment_bound(frame, shoulder, elbow, lengths.upper_arm_m, lengths.upper_arm_share)
    forearm = _segment_bound(frame, elbow, wrist, lengths.forearm_m, lengths.forearm_share)
    distance_m = direction_sets.distance_m(frame, shoulder, wrist)
    expected_m = direction_sets.hinge_distance_m(flexion, lengths.upper_arm_m, lengths.forearm_m)
    share = max(lengths.upper_arm_share, lengths.forearm_share)
    ends = direction_sets.believed(direction_sets.spread(frame, shoulder, wrist), distance_m, expected_m, share)
    hinge = direction_sets.hinge_bound(flexion, lengths.upper_arm_m, lengths.forearm_m, distance_m, ends)
    return (
        swing,
        direction_sets.twist_bound(elevation, flexion, swing, forearm),
        direction_sets.elbow_bound(flexion, swing, forearm, hinge),
    )


def _segment_bound(frame: FusedFrame, start: int, end: int, known_m: float, share: float) -> float:
    estimated_m = direction_sets.distance_m(frame, start, end)
    spread = direction_sets.believed(direction_sets.spread(frame, start, end), estimated_m, known_m, share)
    return direction_sets.direction_bound(estimated_m, known_m, spread)


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


def direction_from_swing(plane_rad: float, elevation_rad: float) -> Floats:
    """The upper arm's unit vector (outward, up, back); plane 0 = sideways, π/2 = ahead; elevation 0 = hanging."""
    return np.array([sin(elevation_rad) * cos(plane_rad), -cos(elevation_rad), -sin(elevation_rad) * sin(plane_rad)])


def swing_from_direction(direction_in_limb: Floats) -> tuple[float, float]:
    """Plane in (−π, π] and elevation in [0, π] of an upper arm's direction; the plane is 0 where it is undefined."""
    outward, up, back = (float(part) for part in direction_in_limb)
    level = float(np.hypot(outward, back))
    plane = atan2(-back, outward) if level > 0 else 0.0
    return plane, atan2(level, -up)


def twist_from_forearm(upper: Floats, forearm: Floats) -> float:
    """The humerus' rotation after the least swing from the hanging arm; internal +; 0 where the forearm does not tell.

    Args:
        upper: (3,) unit vector of the upper arm in limb coordinates.
        forearm: (3,) unit vector of the forearm in limb coordinates.
    """
    across = forearm - (forearm @ upper) * upper
    hanging = _carried(across, upper, HANGING)
    return atan2(float(hanging @ INWARD), float(hanging @ AHEAD))


def forearm_from_twist(upper: Floats, twist_rad: float, elbow_rad: float) -> Floats:
    """The forearm's unit vector in limb coordinates; inverse of `twist_from_forearm`."""
    across = _carried(cos(twist_rad) * AHEAD + sin(twist_rad) * INWARD, HANGING, upper)
    return cos(elbow_rad) * upper + sin(elbow_rad) * across


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
    return shoulder_in_trunk + np.cumsum(steps, axis=0) * _signs(side)


def wrapped(angle_rad: float) -> float:
    """The same angle in (−π, π]."""
    return atan2(sin(angle_rad), cos(angle_rad))


def _to_limb(vector_in_room: Floats, trunk: TrunkFrame, side: Side) -> Floats:
    """(outward, up, back) of a room vector."""
    in_trunk: Floats = vector_in_room @ trunk.rotation_trunk_to_room
    return in_trunk * _signs(side)


def _signs(side: Side) -> Floats:
    return np.array([1.0 if side is Side.RIGHT else -1.0, 1.0, 1.0])


def _carried(across: Floats, start: Floats, end: Floats) -> Floats:
    """A vector perpendicular to `start`, turned by the least rotation that takes `start` to `end` (unit vectors).

    v − (v·end) / (1 + start·end) · (start + end); undefined only where they are opposed (an arm straight overhead).
    """
    together = max(1.0 + float(start @ end), 1e-12)
    return across - (float(across @ end) / together) * (start + end)


def _angle_between(a: Floats, b: Floats) -> float:
    """Angle of two unit vectors, exact near 0 and π too."""
    return 2.0 * atan2(float(np.linalg.norm(a - b)), float(np.linalg.norm(a + b)))
