"""Tags on one stiff thing (a trolley, a belt): where each sits on it, and where they are when it stands and turns."""

from __future__ import annotations

from dataclasses import dataclass
from itertools import combinations
from typing import Final

import numpy as np

from fusion.messages import Floats

STIFF_M: Final = 0.01
"""Tags whose mutual distance varies (std) by less are on one thing."""
LEAST_APART_M: Final = 0.05
"""Tags that are nearer say nothing of a direction."""


@dataclass(frozen=True, slots=True)
class Rig:
    """Tags in the frame of what carries them; it turns about the vertical only."""

    offsets: Floats  # (K, 3) m, from the middle of the tags, at yaw 0

    @property
    def has_direction(self) -> bool:
        """Whether a yaw means anything: not with a single tag."""
        return bool(np.hypot(self.offsets[:, 0], self.offsets[:, 1]).max() > LEAST_APART_M / 2)

    def positions(self, middle: Floats, yaw_rad: float) -> Floats:
        """The tags, (K, 3), with the middle at (3,)."""
        return middle + self.offsets @ turn(yaw_rad).T

    def pose(self, positions: Floats) -> tuple[Floats, float]:
        """Middle (3,) and yaw that fit tags (K, 3) best in the plane; NaN rows are left out.

        With o and p from their own middles: yaw = atan2(Σ o × p, Σ o · p).
        """
        seen = np.isfinite(positions).all(axis=-1)
        offsets, tags = self.offsets[seen], positions[seen]
        o, p = offsets - offsets.mean(axis=0), tags - tags.mean(axis=0)
        cross = np.sum(o[:, 0] * p[:, 1] - o[:, 1] * p[:, 0])
        yaw = float(np.arctan2(cross, np.sum(o[:, :2] * p[:, :2])))
        return np.asarray(tags.mean(axis=0) - turn(yaw) @ offsets.mean(axis=0)), yaw


SINGLE: Final = Rig(np.zeros((1, 3)))
"""One tag alone."""


def turn(yaw_rad: float) -> Floats:
    """Rotation (3, 3) about z."""
    c, s = np.cos(yaw_rad), np.sin(yaw_rad)
    return np.array([[c, -s, 0.0], [s, c, 0.0], [0.0, 0.0, 1.0]])


def learn_rig(positions: Floats) -> Rig | None:
    """The rig that true positions (T, K, 3) show, or None where the tags move on their own.

    Its direction is that of the two tags that are farthest apart in the plane.
    """
    whole = positions[np.isfinite(positions).all(axis=(1, 2))]
    if len(whole) < 2 or positions.shape[1] < 2:
        return None
    pairs = list(combinations(range(positions.shape[1]), 2))
    apart = np.stack([np.linalg.norm(whole[:, i] - whole[:, j], axis=-1) for i, j in pairs], axis=-1)
    if apart.std(axis=0).max() > STIFF_M:
        return None
    first, second = pairs[int(apart.mean(axis=0).argmax())]
    along = whole[:, second] - whole[:, first]
    yaws = np.arctan2(along[:, 1], along[:, 0])
    from_middle = whole - whole.mean(axis=1, keepdims=True)
    rig = Rig(np.mean([tags @ turn(yaw) for tags, yaw in zip(from_middle, yaws.tolist(), strict=True)], axis=0))
    return rig if rig.has_direction else None
