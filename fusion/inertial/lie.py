"""Rigid motions as exponentials of twists [Liu2017 §2, eqs. 5–12].

A twist is (v, ω): for a joint that turns about the unit axis ω through the point c, v = −ω × c, and
``exp(ξθ)`` turns by θ about that line. Motions are 4×4 homogeneous matrices.
"""

from __future__ import annotations

import numpy as np
from scipy.spatial.transform import Rotation

from fusion.geometry import Floats, skew

_SMALL_RAD = 1e-4
"""Below this angle the series are exact to the last digit and the closed forms are not."""


def revolute_twist(axis: Floats, centre_m: Floats) -> Floats:
    """Twist (−ω × c, ω) of a joint that turns about an axis through a centre [Liu2017 eqs. 8–10].

    Args:
        axis: (..., 3) unit vectors ω.
        centre_m: (..., 3) a point c on the axis.

    Returns:
        (..., 6).
    """
    twist: Floats = np.concatenate([-np.cross(axis, centre_m), np.broadcast_to(axis, np.shape(axis))], axis=-1)
    return twist


def exp_se3(twist: Floats) -> Floats:
    """Rigid motions of twists [Liu2017 eqs. 11–12; Murray, Li, Sastry 1994, eq. 2.36].

    Args:
        twist: (T, 6), rotation and translation per unit of time; angle included.

    Returns:
        (T, 4, 4).
    """
    v, w = twist[..., :3], twist[..., 3:]
    motion = np.zeros((*twist.shape[:-1], 4, 4))
    motion[..., :3, :3] = Rotation.from_rotvec(w).as_matrix()
    motion[..., :3, 3] = np.einsum("...ij,...j->...i", _left_jacobian(w), v)
    motion[..., 3, 3] = 1.0
    return motion


def log_se3(motion: Floats) -> Floats:
    """Twists of rigid motions, the inverse of `exp_se3` for angles below π.

    Args:
        motion: (T, 4, 4).

    Returns:
        (T, 6).
    """
    w = Rotation.from_matrix(motion[..., :3, :3]).as_rotvec()
    v = np.linalg.solve(_left_jacobian(w), motion[..., :3, 3:])[..., 0]
    twist: Floats = np.concatenate([v, w], axis=-1)
    return twist


def inverse(motion: Floats) -> Floats:
    """The motions back, (..., 4, 4)."""
    back = np.zeros_like(motion)
    turn = np.swapaxes(motion[..., :3, :3], -1, -2)
    back[..., :3, :3] = turn
    back[..., :3, 3:] = -turn @ motion[..., :3, 3:]
    back[..., 3, 3] = 1.0
    return back


def moved(motion: Floats, point_m: Floats) -> Floats:
    """A point (3,) carried along by motions (T, 4, 4): (T, 3)."""
    place: Floats = motion[..., :3, :3] @ point_m + motion[..., :3, 3]
    return place


def _left_jacobian(w: Floats) -> Floats:
    """V with translation = V v: I + (1 − cos θ)/θ² [ω]× + (θ − sin θ)/θ³ [ω]×²."""
    angle = np.linalg.norm(w, axis=-1)[..., None, None]
    safe = np.where(angle < _SMALL_RAD, 1.0, angle)
    first = np.where(angle < _SMALL_RAD, 0.5 - angle**2 / 24, (1 - np.cos(safe)) / safe**2)
    second = np.where(angle < _SMALL_RAD, 1 / 6 - angle**2 / 120, (safe - np.sin(safe)) / safe**3)
    cross = skew(w)
    jacobian: Floats = np.eye(3) + first * cross + second * (cross @ cross)
    return jacobian
