"""Adaptive weighted mean [Yao]: sensors count by tracking state and by how the person faces their lens.

p_i = Σ_k λ_ki w_k p_ki / Σ_k λ_ki w_k, with λ 1 tracked, ½ inferred, 0 lost, and w falling linearly from 1 at 0° and
180° between the person's facing and the lens to 0 at 90°. Left and right are put right before (`fusion.align.mend`).
"""

from __future__ import annotations

from typing import ClassVar, Final

import numpy as np

from fusion.estimation.average import Average, Samples
from fusion.estimation.measurement import FARTHEST_M, read, sight
from fusion.messages import AlignedSample, Floats
from fusion.skeleton import INDEX, JOINT_COUNT, TrackingState

INFERRED_SHARE: Final = 0.5
LEAST_WEIGHT: Final = 0.05
"""Seen from the side by the only sensor that sees a joint, Yao's weight would divide 0 by 0."""
PAIRS: Final = tuple(
    (INDEX[name + "Left"], INDEX[name + "Right"]) for name in ("Shoulder", "Elbow", "Hip", "Knee", "Ankle", "Foot")
)
"""The first of these with both sides tracked tells how the person stands."""
UP: Final = np.array([0.0, 1.0, 0.0])


class Adaptive(Average):
    """Weighted mean of what the sensors say now, for any number of them at any angles; refuses nothing."""

    name: ClassVar[str] = "adaptive"

    def _weights(self, samples: Samples) -> Floats:
        """(K, J) λ w."""
        facing = _facing_in_room(samples)
        by_lens = np.array([_lens_weight(facing, sample) for sample in samples])
        return by_lens[:, None] * np.stack([_state_weight(sample) for sample in samples])


def _state_weight(sample: AlignedSample) -> Floats:
    """(J,) λ; lost joints are left out by the mean itself."""
    return np.where(sample.state == TrackingState.TRACKED, 1.0, INFERRED_SHARE)


def _facing_in_room(samples: Samples) -> Floats:
    """(3,) level unit vector out of the chest, the mean of what the sensors say; zeros where none can tell."""
    facing = sum((_facing_seen(sample) for sample in samples), np.zeros(3))
    return _unit(facing)


def _facing_seen(sample: AlignedSample) -> Floats:
    """(3,) y × (right − left) of the first pair that is tracked; zeros where there is none."""
    measured = read(sight(sample, JOINT_COUNT))
    for left, right in PAIRS:
        if measured.tracked[left] and measured.tracked[right]:
            return _unit(np.cross(UP, measured.positions[right] - measured.positions[left]))
    return np.zeros(3)


def _lens_weight(facing: Floats, sample: AlignedSample) -> float:
    """The weight w = |1 − θ / 90°| of facing and lens, at least 0.05; 1 where either is not known."""
    ahead = sample.rotation_sensor_to_room[:, 2]
    if not facing.any() or not np.abs(ahead).max() < FARTHEST_M:
        return 1.0
    lens = _unit(ahead * (1.0 - UP))
    angle_rad = float(np.arccos(np.clip(facing @ lens, -1.0, 1.0)))
    return max(abs(1.0 - angle_rad / (np.pi / 2)), LEAST_WEIGHT)


def _unit(vector: Floats) -> Floats:
    """The vector at length 1, zeros where it has none or is not a number."""
    length = float(np.linalg.norm(vector))
    return vector / length if length > 0 else np.zeros(3)
