"""What a body cannot do: bones keep their length, elbows fold only so far. It caps the sets in a silence.

Lengths are learnt from the body that cameras alone tell; before that they are as long as anybody's may be.
"""

from __future__ import annotations

from dataclasses import dataclass
from math import radians, sin
from typing import Final

import numpy as np

from fusion.joined.boxes import Distance
from fusion.messages import Floats, FusedFrame
from fusion.skeleton import BONE_INDICES, Side, TrackingState, arm

PARENT, CHILD = BONE_INDICES.T
LONGEST_M: Final = 0.65
"""No bone of anybody is longer; a spine from the pelvis to its middle, a thigh."""
ENOUGH: Final = 30.0
MEMORY: Final = 300.0
TOLERANCE_M: Final = 0.04
"""How far a learnt length may be from the true one: joints shift in their sockets, and cameras see them elsewhere from
elsewhere."""
DEVIATIONS: Final = 1.0
"""And by how much of the length's own usual deviation."""
FOLDED_RAD: Final = radians(160.0)
"""An elbow does not fold further."""


@dataclass(frozen=True, slots=True)
class Anatomy:
    """Learnt length of each bone, its mean absolute deviation, and how often it was seen."""

    length_m: Floats  # (N,)
    deviation_m: Floats  # (N,)
    count: Floats  # (N,)


def unknown() -> Anatomy:
    """Before anything was seen."""
    zero = np.zeros(len(PARENT))
    return Anatomy(zero, zero, zero)


def learn(anatomy: Anatomy, frame: FusedFrame) -> Anatomy:
    """Follow the lengths of the bones whose two ends cameras see now."""
    tracked = frame.state == TrackingState.TRACKED
    seen = tracked[PARENT] & tracked[CHILD]
    away = np.where(seen[:, None], frame.positions_in_room[CHILD] - frame.positions_in_room[PARENT], 0.0)
    misfit = np.linalg.norm(away, axis=1) - anatomy.length_m
    share = seen / np.minimum(anatomy.count + 1, MEMORY)
    spread = np.where(anatomy.count > 0, np.abs(misfit), 0.0)
    return Anatomy(
        anatomy.length_m + share * misfit,
        anatomy.deviation_m + share * (spread - anatomy.deviation_m),
        anatomy.count + seen,
    )


def distances(anatomy: Anatomy) -> tuple[Distance, ...]:
    """What two joints may be apart: every bone, and shoulder and wrist by the elbow that joins them."""
    known = anatomy.count >= ENOUGH
    slack = TOLERANCE_M + DEVIATIONS * anatomy.deviation_m
    least = np.where(known, np.maximum(anatomy.length_m - slack, 0.0), 0.0)
    most = np.where(known, anatomy.length_m + slack, LONGEST_M)
    bones = [
        Distance(int(a), int(b), float(lower), float(upper))
        for a, b, lower, upper in zip(PARENT, CHILD, least, most, strict=True)
    ]
    return (*bones, *(_across_elbow(bones, side) for side in Side))


def _across_elbow(bones: list[Distance], side: Side) -> Distance:
    """At a flexion of 0 to 160° the wrist is no nearer to the shoulder than either segment's length times sin 160°."""
    shoulder, elbow, wrist, _ = arm(side)
    upper = next(bone for bone in bones if (bone.first, bone.second) == (shoulder, elbow))
    forearm = next(bone for bone in bones if (bone.first, bone.second) == (elbow, wrist))
    return Distance(
        shoulder, wrist, max(upper.least_m, forearm.least_m) * sin(FOLDED_RAD), upper.most_m + forearm.most_m
    )
