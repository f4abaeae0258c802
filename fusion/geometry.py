"""Rotations and small vector helpers."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

Floats = NDArray[np.float64]


def skew(vector: Floats) -> Floats:
    """Matrices [v]× with ``skew(v) @ u == cross(v, u)``.

    Args:
        vector: (..., 3).

    Returns:
        (..., 3, 3).
    """
    x, y, z = np.moveaxis(np.asarray(vector, dtype=np.float64), -1, 0)
    zero = np.zeros_like(x)
    rows = np.stack([zero, -z, y, z, zero, -x, -y, x, zero], axis=-1)
    return rows.reshape(*rows.shape[:-1], 3, 3)


def rotation_angle_rad(rotation: Floats) -> float:
    """Angle of a rotation matrix (3, 3), from both sine and cosine so that small angles stay exact."""
    vector = np.array(
        [rotation[2, 1] - rotation[1, 2], rotation[0, 2] - rotation[2, 0], rotation[1, 0] - rotation[0, 1]]
    )
    return float(np.arctan2(np.linalg.norm(vector), np.trace(rotation) - 1.0))


def nearest_rotation(matrix: Floats) -> Floats:
    """The rotation that maximises ``trace(R' M)``, i.e. the nearest one to `matrix` (3, 3)."""
    u, _, vt = np.linalg.svd(matrix)
    u[:, 2] *= np.sign(np.linalg.det(u @ vt))
    rotation: Floats = u @ vt
    return rotation
