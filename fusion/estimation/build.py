"""The patient's own build: lengths of the fused body's bones, learnt as they move, which the told body keeps.

Sensors err by centimetres and each for itself, so a fused forearm would breathe by two to five; the patient's does not.
Points are drawn along their bone until it has its length, the less sure end by more (position based dynamics, Müller
2007, with the variances for inverse masses). And nobody's joint is further from the next than the bone is long, so a
joint that nobody sees is bounded by one that somebody does.
"""

from __future__ import annotations

from typing import Final

import numpy as np

from fusion.compiled import Records, kernel
from fusion.estimation import bones
from fusion.estimation.freshness import CONTINUE_S
from fusion.estimation.vectors import distance, row
from fusion.messages import Floats

KNOWN_FRAMES: Final = 30
"""Samples after which a length counts: half a second of two sensors."""
FORGET_FRAMES: Final = 3600
"""Afterwards a length follows over a minute of two sensors; 10 s let it breathe."""
GIVE_M: Final = 0.03
"""How far a bone's length may be another for all that (the shoulder's joint slides), where it is not further off as a
rule; 0.02 to 0.04 m serve."""
ROUNDS: Final = 3
"""One bone's end is another's beginning."""


@kernel
def learn(build: Records, joints: Records, t_s: float) -> None:
    """Follow the lengths between joints that somebody sees; `build` (B,) are the fused body's bones."""
    for b in range(len(build)):
        bone = build[b]
        near, far = joints[bone.parent], joints[bone.child]
        if bone.firm and t_s - near.seen_s < CONTINUE_S and t_s - far.seen_s < CONTINUE_S:
            bones.learn(bone, distance(near.position, far.position), FORGET_FRAMES)


@kernel
def keep(build: Records, joints: Records, positions: Floats) -> None:
    """Draw `positions` (J, 3) along their bones, each end as far as its variance has it; NaN stays NaN."""
    for _ in range(ROUNDS):
        for b in range(len(build)):
            bone = build[b]
            near, far = bone.parent, bone.child
            if bone.frames < KNOWN_FRAMES:
                continue
            length_m = distance(row(positions, near), row(positions, far))
            if not length_m > 0:
                continue
            spread = joints[near].pp + joints[far].pp + max(GIVE_M, bone.deviation_m) ** 2
            share = (bone.length_m - length_m) / length_m / spread
            for axis in range(3):
                along = share * (positions[far, axis] - positions[near, axis])
                positions[near, axis] -= joints[near].pp * along
                positions[far, axis] += joints[far].pp * along


@kernel
def cap(build: Records, positions: Floats, bound_m: Floats, shape_m2: Floats) -> None:
    """Bound a joint by its parent's bound and the bone between them, where that is less.

    |c - told c| <= |c - p| + |p - told p| + |told p - told c|, c the joint, p its parent. Lengths count with the
    tolerance that one sensor's bones have. Writes `bound_m` (J,) and the ball in `shape_m2` (J, 3, 3) of joints at
    `positions` (J, 3).
    """
    for b in range(len(build)):
        bone = build[b]
        near, far = bone.parent, bone.child
        apart_m = distance(row(positions, near), row(positions, far))
        reach_m = bound_m[near] + apart_m + bone.length_m + bones.tolerance_m(bone)
        if bone.frames >= KNOWN_FRAMES and reach_m < bound_m[far] < np.inf:
            bound_m[far] = reach_m
            for axis in range(3):
                shape_m2[far, axis, axis] = reach_m**2
