"""The comparison of [Liu2017 §3-4]: inertial positions brought into the optical frame, then correlated.

Scale K0 from the distances between the joints; rotation from a frame on three points (x from the first to the second,
y in the plane of all three); translation from the shoulder, elbow and wrist with weights 0.6, 0.3 and 0.1. Scale,
rotation and translation are taken once, where the three points lie widest apart, and then hold.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Final

import numpy as np

from fusion.messages import Floats

WEIGHTS: Final = np.array([0.6, 0.3, 0.1])
"""Shoulder, elbow, wrist."""
JOINTS: Final = ("shoulder", "elbow", "wrist")


@dataclass(frozen=True, slots=True)
class Compared:
    """One run; the inertial positions in the optical frame."""

    found: Floats  # (T, 3, 3) m
    truth: Floats  # (T, 3, 3) m

    @property
    def error_m(self) -> Floats:
        """(T, 3, 3) m, by joint and axis."""
        return self.found - self.truth

    def correlation(self, joint: int) -> float:
        """Pearson's coefficient, mean over the axes; NaN for a joint that does not move."""
        truth, found = self.truth[:, joint], self.found[:, joint]
        if truth.std(axis=0).min() < 1e-9 or found.std(axis=0).min() < 1e-9:
            return float("nan")
        return float(np.mean([np.corrcoef(truth[:, axis], found[:, axis])[0, 1] for axis in range(3)]))


def compared(truth: Floats, found: Floats) -> Compared:
    """Bring `found` into the frame of `truth` as the paper does; both (T, 3, 3) m: shoulder, elbow, wrist."""
    at = int(np.argmax(_spread(truth)))
    scale = float(np.sum(_distances(truth[at])) / np.sum(_distances(found[at])))
    rotation = _frame(truth[at]) @ _frame(found[at]).T
    turned = scale * found @ rotation.T
    shift = WEIGHTS @ (truth[at] - turned[at])
    return Compared(turned + shift, truth)


def _spread(points: Floats) -> Floats:
    """(T,) m², twice the area of the three points' triangle."""
    area: Floats = np.linalg.norm(np.cross(points[:, 1] - points[:, 0], points[:, 2] - points[:, 0]), axis=1)
    return area


def _distances(points: Floats) -> Floats:
    lengths: Floats = np.linalg.norm(points[[1, 2, 2]] - points[[0, 1, 0]], axis=1)
    return lengths


def _frame(points: Floats) -> Floats:
    """(3, 3) axes as columns: x along P1P2, z across the plane of the three points."""
    x = (points[1] - points[0]) / np.linalg.norm(points[1] - points[0])
    across = np.cross(x, points[2] - points[0])
    z = across / np.linalg.norm(across)
    return np.stack([x, np.cross(z, x), z], axis=1)
