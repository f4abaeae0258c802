"""Which pose brings the hand to a place: closed-form inverse kinematics of the arm inside human ranges."""

from __future__ import annotations

from math import acos, cos, pi, sin
from typing import Final

import numpy as np

from fusion.kinematics.angles import swing_from_direction, twist_from_forearm
from fusion.messages import ArmLengths, Floats
from fusion.virtual_patient.anatomy import ArmPose

RANGES_RAD: Final[Floats] = np.array([[-0.25, 1.95], [0.05, 1.6], [-0.9, 1.25], [0.1, 2.2]])
"""(4, 2) lowest and highest plane, elevation, rotation and elbow that the patient uses: inside the cautious default of
a patient's passive range, so that the mirrored arm may follow."""
_SWIVELS: Final = 72
_OUT_OF_RANGE_COST: Final = 100.0
_RAISED_ELBOW_COST: Final = 0.5
_MARGIN_M: Final = 1e-3


def pose_for_hand(hand_in_limb: Floats, lengths: ArmLengths, current: ArmPose) -> ArmPose:
    """The pose that brings the hand to a place, or as near as arm and ranges allow.

    The distance from the shoulder gives the elbow's flexion (law of cosines). The elbow may then be anywhere on a
    circle about the line from shoulder to hand; of its places the one is taken that keeps every joint in its range,
    the elbow low and the way from the current pose short.

    Args:
        hand_in_limb: (3,) m from the shoulder, as (outward, up, back).
        lengths: of the segments; the hand continues the forearm.
        current: where the arm is now.
    """
    upper_m, lower_m = lengths.upper_arm_m, lengths.forearm_m + lengths.hand_m
    wanted_m = float(np.linalg.norm(hand_in_limb))
    if wanted_m < _MARGIN_M:
        return current
    distance_m = float(np.clip(wanted_m, abs(upper_m - lower_m) + _MARGIN_M, upper_m + lower_m - _MARGIN_M))
    along = hand_in_limb / wanted_m
    candidates = [
        _pose(upper, (distance_m * along - upper_m * upper) / lower_m)
        for upper in _elbow_circle(along, upper_m, lower_m, distance_m)
    ]
    best = min(candidates, key=lambda pose: _cost(pose, current.as_array()))
    return clipped(ArmPose(*best.tolist()))


def clipped(pose: ArmPose) -> ArmPose:
    """The pose with every joint inside its range."""
    return ArmPose(*np.clip(pose.as_array(), RANGES_RAD[:, 0], RANGES_RAD[:, 1]).tolist())


def _elbow_circle(along: Floats, upper_m: float, lower_m: float, distance_m: float) -> list[Floats]:
    """Unit vectors of the upper arm for which the hand lies `distance_m` along `along`."""
    off = acos(float(np.clip((upper_m**2 + distance_m**2 - lower_m**2) / (2 * upper_m * distance_m), -1.0, 1.0)))
    first = np.cross(along, np.eye(3)[int(np.argmin(np.abs(along)))])
    first /= np.linalg.norm(first)
    second = np.cross(along, first)
    swivels = np.arange(_SWIVELS) * (2 * pi / _SWIVELS)
    return [cos(off) * along + sin(off) * (cos(swivel) * first + sin(swivel) * second) for swivel in swivels.tolist()]


def _pose(upper: Floats, forearm: Floats) -> Floats:  # (4,) rad
    plane, elevation = swing_from_direction(upper)
    elbow = acos(float(np.clip(upper @ forearm, -1.0, 1.0)))
    return np.array([plane, elevation, twist_from_forearm(upper, forearm), elbow])


def _cost(pose: Floats, current: Floats) -> float:
    outside = np.maximum(RANGES_RAD[:, 0] - pose, 0.0) + np.maximum(pose - RANGES_RAD[:, 1], 0.0)
    way = float(np.abs(pose - current).sum())
    return _OUT_OF_RANGE_COST * float(outside.sum()) + _RAISED_ELBOW_COST * float(pose[1]) ** 2 + 0.2 * way
