"""Which joints a sensor cannot see because the patient's own trunk stands before them.

A sensor that looks from the side makes up the far arm, up to half a metre away, and not every one says that it infers
it. Where the line of sight passes the spine at less than half a trunk's width before it comes to the joint, the joint
is in doubt.
"""

from __future__ import annotations

from math import sqrt
from typing import Final

from fusion.compiled import Record, kernel
from fusion.estimation.vectors import Vector, dot, length, plus
from fusion.skeleton import INDEX, JOINT_COUNT

TRUNK_RADIUS_M: Final = 0.15
"""0.12 to 0.18 m serve."""
BEHIND_M: Final = 0.1
"""A joint is behind the trunk when the line of sight goes on for this long: the near shoulder is not."""
TOP: Final = INDEX["SpineShoulder"]
BOTTOM: Final = INDEX["SpineBase"]
SPINE_JOINTS: Final = 1 + max(TOP, BOTTOM)
_ARM: Final = ("Shoulder", "Elbow", "Wrist", "Hand", "HandTip", "Thumb")
HIDES: Final = tuple(
    any(INDEX[name + side] == j for name in _ARM for side in ("Left", "Right")) for j in range(JOINT_COUNT)
)
"""(J,) the joints of which it is asked."""


@kernel
def is_hidden(lens: Vector, joint: Vector, top: Vector, bottom: Vector) -> bool:
    """Whether the trunk from `top` to `bottom` stands between lens and joint; False where the spine is not known.

    The nearest points of two segments: lens + s (joint - lens) and top + t (bottom - top) (Ericson, Real-Time
    Collision Detection, 2005, §5.1.9).
    """
    sight, spine, between = plus(joint, lens, -1.0), plus(bottom, top, -1.0), plus(lens, top, -1.0)
    a, b, c = dot(sight, sight), dot(sight, spine), dot(spine, spine)
    d, e = dot(sight, between), dot(spine, between)
    across = a * c - b * b
    if not across > 1e-9:  # parallel, or not known
        return False
    t = min(max((a * e - b * d) / across, 0.0), 1.0)
    s = (b * t - d) / a
    if not 0 < s < 1 or (1 - s) * sqrt(a) < BEHIND_M:
        return False
    return length(plus(plus(between, sight, s), spine, -t)) < TRUNK_RADIUS_M


@kernel
def hides(lens: Vector, seen: Vector, expected: Record, top: Record, bottom: Record) -> bool:
    """Whether the trunk hides a joint, be it where the sensor sees it or where it is expected.

    `expected`, `top` and `bottom` are the joint's and the spine's records.
    """
    above = (top.position[0], top.position[1], top.position[2])
    below = (bottom.position[0], bottom.position[1], bottom.position[2])
    there = (expected.position[0], expected.position[1], expected.position[2])
    return is_hidden(lens, seen, above, below) or is_hidden(lens, there, above, below)
