"""The turn R and the bones b for which v = R q b fits best what cameras saw, from sums over the samples alone.

Σ |v − R q b|² is least where, by turns, b is the mean of q' R' v and R the rotation nearest to Σ v (q b)' (Wahba's
problem); both need only Σ v ⊗ q.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Final

import numpy as np

from fusion.messages import Floats

LEAST_STD_M: Final = 0.02
"""No camera is better than this, however smooth it looks."""
UP_WEIGHT: Final = 0.5
"""What up is worth in the fit, in m²: as five samples of an upper arm."""
UP_IN_ROOM: Final = np.array([0.0, 1.0, 0.0])
UP_IN_EARTH: Final = np.array([0.0, 0.0, 1.0])
UPRIGHT: Final = np.array([[1.0, 0.0, 0.0], [0.0, 0.0, 1.0], [0.0, -1.0, 0.0]])
_HEADINGS: Final = np.stack(
    [np.array([[c, 0.0, s], [0.0, 1.0, 0.0], [-s, 0.0, c]]) @ UPRIGHT for c, s in ((1, 0), (0, 1), (-1, 0), (0, -1))]
)
_ROUNDS: Final = 6


@dataclass(frozen=True, slots=True)
class Sums:
    """Over samples of B bones, each with v (3,) in the room and q (3, 3) from the sensor to its earth."""

    products: Floats  # (B, 3, 3, 3) Σ v_i q_jk
    squares: Floats  # (B,) Σ |v|²
    count: Floats  # (B,)

    @staticmethod
    def nothing(bones: int) -> Sums:
        """The sums over no sample."""
        return Sums(np.zeros((bones, 3, 3, 3)), np.zeros(bones), np.zeros(bones))


@dataclass(frozen=True, slots=True)
class Fit:
    """The best R and b."""

    earth_to_room: Floats  # (3, 3) R
    bones: Floats  # (B, 3) m in the sensor
    noise_m: float
    """Standard deviation of what is left, per axis."""


def fit(sums: Sums, start: Floats = UPRIGHT) -> Fit:
    """From `start` (3, 3) and from four headings; the best fit counts."""
    count = np.maximum(sums.count, 1e-9)[None, :, None]
    up = UP_WEIGHT * np.outer(UP_IN_ROOM, UP_IN_EARTH)
    turns = np.stack([start, *_HEADINGS])  # (S, 3, 3)
    for _ in range(_ROUNDS):
        bones = np.einsum("bijk,sij->sbk", sums.products, turns) / count
        turns = _nearest_rotations(np.einsum("bijk,sbk->sij", sums.products, bones) + up)
    bones = np.einsum("bijk,sij->sbk", sums.products, turns) / count
    explained = np.sum(sums.count[:, None] * bones**2, axis=(1, 2))
    best = int(np.argmax(explained + 2 * np.einsum("sij,ij->s", turns, up)))
    left = max(float(sums.squares.sum() - explained[best]), 0.0) / (3 * max(float(sums.count.sum()), 1e-9))
    return Fit(turns[best], bones[best], max(float(np.sqrt(left)), LEAST_STD_M))


def _nearest_rotations(matrices: Floats) -> Floats:
    """(S, 3, 3) the rotations that maximise trace(R' M)."""
    u, _, vt = np.linalg.svd(matrices)
    u[:, :, 2] *= np.sign(np.linalg.det(u @ vt))[:, None]
    return np.asarray(u @ vt)
