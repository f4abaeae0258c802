"""Bone lengths as one sensor sees them, learnt as the person moves; a bone that changes betrays a wandering joint."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Final

import numpy as np
from numpy.typing import NDArray

from fusion.estimation.measurement import Flags, Measurement
from fusion.messages import Floats
from fusion.skeleton import BONE_INDICES, INDEX, JOINT_COUNT

PARENT, CHILD = BONE_INDICES.T
LEARN_FRAMES: Final = 30
"""A length is believed once it was seen this often: a second of one sensor."""
FORGET_FRAMES: Final = 300
"""Afterwards a length follows slowly, over ten seconds."""
STEP_MAX_M: Final = 0.02
"""No single frame moves a length further, so that a few wild ones do not count."""
SPREAD_MAX_M: Final = 0.1
"""No single frame counts for more in the usual deviation."""
DEVIATIONS: Final = 5.0
LEAST_MISFIT_M: Final = 0.08
"""A bone is wrong when it is off by this much and by five of its usual deviations."""
LIMBS: Final = frozenset(
    INDEX[name + side] for side in ("Left", "Right") for name in ("Elbow", "Wrist", "Hand", "Knee", "Ankle", "Foot")
)
"""What hangs on one of these wanders with it."""


def _hangs_on() -> NDArray[np.bool_]:
    """(J, B) whether a joint is the far end of a bone, or hangs on that end along a limb."""
    hangs: NDArray[np.bool_] = np.arange(JOINT_COUNT)[:, None] == CHILD[None, :]
    for parent, child in BONE_INDICES:  # parents come before their children
        if parent in LIMBS:
            hangs[child] |= hangs[parent]
    return hangs


HANGS_ON: Final = _hangs_on()


@dataclass(frozen=True, slots=True)
class Bones:
    """Learnt length and usual deviation of each bone, and how often it was seen."""

    length_m: Floats  # (B,)
    deviation_m: Floats  # (B,) mean absolute
    frames: Floats  # (B,)


def unknown() -> Bones:
    """Before anything was seen."""
    zero = np.zeros(len(PARENT))
    return Bones(zero, zero, zero)


def learn(bones: Bones, measured: Measurement) -> Bones:
    """Follow the lengths of the bones whose two ends are tracked: a running mean with bounded steps."""
    tracked = measured.tracked[PARENT] & measured.tracked[CHILD]
    misfit = _lengths(measured) - bones.length_m
    first = tracked & (bones.frames == 0)
    bounded = np.clip(misfit, -STEP_MAX_M, STEP_MAX_M)
    spread = np.minimum(np.abs(misfit), SPREAD_MAX_M)
    share = tracked / np.minimum(bones.frames + 1, FORGET_FRAMES)
    return Bones(
        bones.length_m + np.where(first, misfit, share * bounded),
        bones.deviation_m + np.where(first, 0.0, share * (spread - bones.deviation_m)),
        bones.frames + tracked,
    )


def wandering(bones: Bones, measured: Measurement) -> Flags:
    """(J,) joints at the far end of a bone whose length is wrong, and all that hangs on them."""
    known = measured.given[PARENT] & measured.given[CHILD] & (bones.frames >= LEARN_FRAMES)
    limit = np.maximum(LEAST_MISFIT_M, DEVIATIONS * bones.deviation_m)
    wrong = known & (np.abs(_lengths(measured) - bones.length_m) > limit)
    joints: Flags = (HANGS_ON & wrong).any(axis=1)
    return joints


def _lengths(measured: Measurement) -> Floats:
    lengths: Floats = np.linalg.norm(measured.positions[CHILD] - measured.positions[PARENT], axis=1)
    return lengths
