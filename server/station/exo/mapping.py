"""From a mirror target to this exoskeleton's joints: the swing as plane and elevation, rotation, elbow.

The plane is singular for a hanging arm, which is where patients rest: there its direction is noise. Inside a cone it
is held, and on the way out it may only turn slowly; the error this makes in the hand's place is the sine of a small
elevation times the plane's error, so it vanishes where the plane is worst.
"""

from __future__ import annotations

from dataclasses import dataclass
from math import isfinite, pi, sin
from typing import Final

from fusion.kinematics.angles import swing_from_direction
from fusion.messages import MirrorTarget
from server.station.exo.driver import ZERO, Joints

CONE_RAD: Final = (0.12, 0.40)
"""Elevation below which the plane is held, and above which it is free."""


@dataclass(frozen=True, slots=True)
class JointTarget:
    """Where the exoskeleton's joints should go, before any limit."""

    angle_rad: Joints
    velocity_rad_s: Joints
    """How fast they are to be taken to move; none until `smoothing` has observed it."""
    bound_rad: Joints
    """How uncertain each is."""
    freedom: Joints
    """0..1 of each joint's speed; below 1 for the plane inside the cone."""


def joint_target(target: MirrorTarget | None, commanded_rad: Joints) -> JointTarget | None:
    """A mirror target in joints; None where there is none to follow.

    Args:
        target: the mirrored arm.
        commanded_rad: what is commanded now. The plane keeps it inside the cone; plane and rotation are unwrapped
            around it, so that a target beyond the range that passes ±π does not send the joint to the other end.
    """
    if target is None or not target.valid or not _is_number(target):
        return None
    plane, elevation = swing_from_direction(target.direction_in_limb)
    freedom = cone_freedom(elevation)
    angles = (
        _unwrapped(plane, commanded_rad[0]) if freedom else commanded_rad[0],
        elevation,
        _unwrapped(target.twist_rad, commanded_rad[2]),
        target.elbow_rad,
    )
    bounds = (target.swing_bound_rad, target.swing_bound_rad, target.twist_bound_rad, target.elbow_bound_rad)
    return JointTarget(angles, ZERO, bounds, (freedom, 1.0, 1.0, 1.0))


def _is_number(target: MirrorTarget) -> bool:
    values = (
        *target.direction_in_limb,
        target.twist_rad,
        target.elbow_rad,
        target.swing_bound_rad,
        target.twist_bound_rad,
        target.elbow_bound_rad,
    )
    return all(map(isfinite, values))


def cone_freedom(elevation_rad: float) -> float:
    """0 inside the cone, 1 outside, the sine of the elevation's share between: the hand's own speed decides."""
    inner, outer = (sin(limit) for limit in CONE_RAD)
    height = sin(min(max(elevation_rad, 0.0), pi / 2))
    return min(max((height - inner) / (outer - inner), 0.0), 1.0)


def _unwrapped(angle_rad: float, around_rad: float) -> float:
    return angle_rad - 2 * pi * round((angle_rad - around_rad) / (2 * pi))
