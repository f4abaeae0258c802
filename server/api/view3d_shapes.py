"""Where the pieces of the 3-D view go: bones as unit cylinders, joints and bounds as unit balls, all as arrays."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray
from scipy.spatial.transform import Rotation

from server.messages import Point

Array = NDArray[np.float32]
HIDDEN = 1e-6
"""Scale of a piece that is not to be seen; a batch keeps its length."""


@dataclass(frozen=True, slots=True)
class Placement:
    """Where each piece of a batch is."""

    wxyzs: Array  # (N, 4) unit quaternions
    positions: Array  # (N, 3) m
    scales: Array  # (N, 3)


def as_array(points: tuple[Point | None, ...]) -> Array:
    """Points as (N, 3); a missing one is NaN."""
    missing = (np.nan, np.nan, np.nan)
    return np.array([missing if point is None else point for point in points], np.float32).reshape(-1, 3)


def place_bones(joints: Array, bones: NDArray[np.intp], radius_m: float) -> Placement:
    """Unit cylinders along z, stretched from joint to joint.

    Args:
        joints: (J, 3) m, NaN where missing.
        bones: (B, 2) indices of the joints at both ends.
        radius_m: thickness.
    """
    start, end = joints[bones[:, 0]], joints[bones[:, 1]]
    way = end - start
    length = np.linalg.norm(way, axis=1)
    seen = np.isfinite(length) & (length > HIDDEN)
    way = np.where(seen[:, None], way / np.where(seen, length, 1.0)[:, None], (0.0, 0.0, 1.0))
    scales = np.where(seen[:, None], np.stack((_all(length, radius_m), _all(length, radius_m), length), 1), HIDDEN)
    middle = np.where(seen[:, None], (start + end) / 2, 0.0)
    return Placement(_turned_from_z(way), middle.astype(np.float32), scales.astype(np.float32))


def place_balls(joints: Array, radius_m: float) -> Placement:
    """Unit balls at the joints (J, 3)."""
    seen = np.isfinite(joints).all(1)
    scales = np.where(seen, radius_m, HIDDEN)[:, None] * np.ones((1, 3))
    return Placement(_unturned(len(joints)), np.nan_to_num(joints), scales.astype(np.float32))


def place_bounds(joints: Array, shape_m2: tuple[tuple[float, ...], ...]) -> Placement:
    """Unit balls made to fill each joint's set (x-c)' shape⁻¹ (x-c) ≤ 1.

    Args:
        joints: (J, 3) m.
        shape_m2: per joint (xx, xy, xz, yy, yz, zz).
    """
    flat = np.asarray(shape_m2, float).reshape(-1, 6)
    seen = np.isfinite(joints).all(1) & np.isfinite(flat).all(1)
    matrices = np.where(seen[:, None], flat, 0.0)[:, [0, 1, 2, 1, 3, 4, 2, 4, 5]].reshape(-1, 3, 3)
    squares, axes = np.linalg.eigh(matrices)
    axes[np.linalg.det(axes) < 0, :, 0] *= -1  # columns must form a rotation, not a mirror image
    scales = np.where(seen[:, None], np.sqrt(np.maximum(squares, HIDDEN**2)), HIDDEN)
    wxyzs = Rotation.from_matrix(axes).as_quat(scalar_first=True)
    return Placement(wxyzs.astype(np.float32), np.nan_to_num(joints), scales.astype(np.float32))


def facing(position: Array, towards: Array) -> Array:
    """Quaternion (4,) of a camera (z ahead, y down) at `position` that looks level towards a point."""
    ahead = np.array([towards[0] - position[0], 0.0, towards[2] - position[2]])
    length = float(np.linalg.norm(ahead))
    ahead = ahead / length if length > HIDDEN else np.array([0.0, 0.0, 1.0])
    down = np.array([0.0, -1.0, 0.0])
    turned = Rotation.from_matrix(np.stack((np.cross(down, ahead), down, ahead), axis=1))
    return np.asarray(turned.as_quat(scalar_first=True), np.float32)


def _all(like: Array, value: float) -> Array:
    return np.full_like(like, value)


def _unturned(count: int) -> Array:
    return np.tile(np.array([1.0, 0.0, 0.0, 0.0], np.float32), (count, 1))


def _turned_from_z(way: NDArray[np.floating]) -> Array:
    """Shortest turn from +z to each unit vector: q ∝ (1 + z·w, z × w)."""
    wxyz = np.stack((1.0 + way[:, 2], -way[:, 1], way[:, 0], np.zeros(len(way))), axis=1)
    wxyz[wxyz[:, 0] < HIDDEN] = (0.0, 1.0, 0.0, 0.0)  # straight back: half a turn about x
    return np.asarray(wxyz / np.linalg.norm(wxyz, axis=1, keepdims=True), np.float32)
