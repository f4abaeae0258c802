"""Bone lengths as one sensor sees them, learnt as the person moves; a bone that changes betrays a wandering joint."""

from __future__ import annotations

from typing import Final

import numpy as np

from fusion.compiled import Record, Records, kernel, record
from fusion.estimation.measurement import Measurement
from fusion.estimation.vectors import distance, row
from fusion.messages import Flags
from fusion.skeleton import BONE_INDICES, INDEX

LEARN_FRAMES: Final = 30
"""A length is believed once it was seen this often: a second of one sensor."""
FORGET_FRAMES: Final = 300
"""Afterwards a length follows slowly, over ten seconds."""
STEP_MAX_M: Final = 0.02
"""No single frame moves a length further, so that a few wild ones do not count ..."""
STEP_DEVIATIONS: Final = 2.0
"""... unless, in its first ten seconds, the length is usually further off: its beginning was wild. 2 to 3 serve."""
SPREAD_MAX_M: Final = 0.1
"""No single frame counts for more in the usual deviation."""
DEVIATIONS: Final = 5.0
LEAST_MISFIT_M: Final = 0.08
"""A bone is wrong when it is off by this much and by five of its usual deviations."""
LIMBS: Final = [
    INDEX[name + side] for side in ("Left", "Right") for name in ("Elbow", "Wrist", "Hand", "Knee", "Ankle", "Foot")
]
"""What hangs on one of these wanders with it."""

FIRM: Final = [
    (INDEX[parent + side], INDEX[child + side])
    for side in ("Left", "Right")
    for parent, child in (("Shoulder", "Elbow"), ("Elbow", "Wrist"), ("Hip", "Knee"), ("Knee", "Ankle"))
] + [
    (INDEX[parent], INDEX[child + side])
    for side in ("Left", "Right")
    for parent, child in (("SpineShoulder", "Shoulder"), ("SpineBase", "Hip"))
]
"""Parent and child of the bones that keep their length; hands and feet tremble too much to hold a limb."""

BONE: Final = record(
    [
        ("parent", "i8"),
        ("child", "i8"),
        ("hangs", "?"),  # the child wanders with its parent
        ("firm", "?"),  # the told body keeps its length
        ("length_m", "f8"),
        ("deviation_m", "f8"),  # mean absolute
        ("frames", "f8"),  # how often it was seen
    ]
)


def unknown(joints: int) -> Records:
    """(B,) the bones between the first `joints` joints before anything was seen; parents before their children."""
    between = BONE_INDICES[(joints > BONE_INDICES).all(axis=1)]
    bones = np.zeros(len(between), BONE)
    bones["parent"], bones["child"] = between.T
    bones["hangs"] = np.isin(bones["parent"], LIMBS)
    bones["firm"] = [tuple(pair) in FIRM for pair in between.tolist()]
    return bones


@kernel
def judge(bones: Records, measured: Measurement) -> Flags:
    """(J,) joints at the far end of a bone whose length is wrong, and all that hangs on them; learns the lengths.

    `bones` (B,) are those of one sensor.
    """
    wandering = np.zeros(len(measured.given), np.bool_)
    for b in range(len(bones)):
        bone = bones[b]
        near, far = bone.parent, bone.child
        if not (measured.given[near] and measured.given[far]):
            wandering[far] = bone.hangs and wandering[near]
            continue
        length_m = distance(row(measured.positions, near), row(measured.positions, far))
        wandering[far] = is_wrong(bone, length_m) or (bone.hangs and wandering[near])
        if measured.tracked[near] and measured.tracked[far]:
            learn(bone, length_m, FORGET_FRAMES)
    return wandering


@kernel
def is_wrong(bone: Record, length_m: float) -> bool:
    """Whether a length is not the bone's, once that is known."""
    return bool(bone.frames >= LEARN_FRAMES and abs(length_m - bone.length_m) > tolerance_m(bone))


@kernel
def tolerance_m(bone: Record) -> float:
    """How far off a length may be before it is wrong."""
    deviation_m: float = bone.deviation_m
    return max(LEAST_MISFIT_M, DEVIATIONS * deviation_m)


@kernel
def learn(bone: Record, length_m: float, forget_frames: int) -> None:
    """Follow the length: a running mean, over so many frames at most, with bounded steps."""
    misfit = length_m - bone.length_m
    share = 1 / min(bone.frames + 1, forget_frames)
    young = bone.frames < FORGET_FRAMES
    step_max_m = max(STEP_MAX_M, STEP_DEVIATIONS * bone.deviation_m) if young else STEP_MAX_M
    if bone.frames == 0:
        bone.length_m = length_m
    else:
        bone.length_m += share * min(max(misfit, -step_max_m), step_max_m)
        bone.deviation_m += share * (min(abs(misfit), SPREAD_MAX_M) - bone.deviation_m)
    bone.frames += 1
