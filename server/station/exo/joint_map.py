"""Between the anatomical angles and a device's joints: linear, after the exoskeleton file.

q = A a + c with q (n,) the joints and a (4,) the angles of `EXO_JOINTS`; torques go the other way by equal power,
τ_a = Aᵀ τ_q.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import ArrayLike

from fusion.messages import Floats
from server.exoskeleton import Exoskeleton, ExoskeletonJoint, Follows
from server.messages import EXO_JOINTS
from server.station.exo.driver import Joints

_ROWS: dict[Follows, tuple[float, ...]] = {
    Follows.PLANE: (1, 0, 0, 0),
    Follows.ELEVATION: (0, 1, 0, 0),
    Follows.ROTATION: (0, 0, 1, 0),
    Follows.AXIAL_ROTATION: (-1, 0, 1, 0),
    Follows.ELBOW: (0, 0, 0, 1),
    Follows.NONE: (0, 0, 0, 0),
}


class JointMap:
    """One exoskeleton's map.

    Args:
        exoskeleton: each angle of `EXO_JOINTS` is followed by one of its joints.
    """

    def __init__(self, exoskeleton: Exoskeleton) -> None:
        joints = exoskeleton.joints
        self._slope = np.array([[j.sign * part for part in _ROWS[j.follows]] for j in joints], dtype=float)  # (n, 4)
        self._constant = np.array([_constant(joint) for joint in joints])  # (n,)
        self._back: Floats = np.linalg.pinv(self._slope)  # (4, n)
        self.names = tuple(joint.name for joint in joints)
        self.leading = tuple(_leading(joint) for joint in joints)
        """Per joint the index of the angle whose share, torque bound and stop category it takes; None: it rests."""

    def joints_rad(self, angle_rad: ArrayLike) -> Floats:
        """Anatomical angles (4,) → joints' angles (n,), rad."""
        joints: Floats = self._slope @ np.asarray(angle_rad) + self._constant
        return joints

    def joints_rad_s(self, velocity_rad_s: ArrayLike) -> Floats:
        """Anatomical velocities (4,) → joints' velocities (n,), rad/s."""
        joints: Floats = self._slope @ np.asarray(velocity_rad_s)
        return joints

    def anatomical_rad(self, joints_rad: ArrayLike) -> Joints:
        """Joints' angles (n,) → anatomical angles (4,), rad."""
        return tuple((self._back @ (np.asarray(joints_rad) - self._constant)).tolist())

    def anatomical_rad_s(self, joints_rad_s: ArrayLike) -> Joints:
        """Joints' velocities (n,) → anatomical velocities (4,), rad/s."""
        return tuple((self._back @ np.asarray(joints_rad_s)).tolist())

    def anatomical_nm(self, joints_nm: ArrayLike) -> Joints:
        """Joints' torques (n,) → torques about the anatomical angles (4,), N m, by equal power."""
        return tuple((self._slope.T @ np.asarray(joints_nm)).tolist())

    def joints_nm(self, anatomical_nm: ArrayLike) -> Floats:
        """Torques about the anatomical angles (4,) → joints' torques (n,), N m, by equal power; 0 where one rests."""
        joints: Floats = self._back.T @ np.asarray(anatomical_nm)
        return joints

    def ranges_rad(self, ends_rad: tuple[tuple[float, float], ...]) -> Floats:
        """Where the joints (n, 2) may be while the anatomical angles are inside (4, 2), rad: interval arithmetic."""
        low, high = np.asarray(ends_rad).T
        parts = np.stack((self._slope * low, self._slope * high))  # (2, n, 4)
        ends = np.column_stack((parts.min(axis=0).sum(axis=1), parts.max(axis=0).sum(axis=1)))
        moved: Floats = ends + self._constant[:, None]
        return moved

    def spread(self, per_angle: Joints, resting: float) -> Floats:
        """A share or a bound per angle (4,) → per joint (n,): each joint takes its leading angle's."""
        return np.array([resting if lead is None else per_angle[lead] for lead in self.leading])


def _constant(joint: ExoskeletonJoint) -> float:
    return joint.rest_rad if joint.follows is Follows.NONE else joint.offset_rad


def _leading(joint: ExoskeletonJoint) -> int | None:
    if joint.follows is Follows.NONE:
        return None
    angle = Follows.ROTATION if joint.follows is Follows.AXIAL_ROTATION else joint.follows
    return EXO_JOINTS.index(angle.value)
