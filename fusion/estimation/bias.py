"""What each sensor says differently from the others, joint by joint: learnt while several see it, taken off always.

Seen from the side a shoulder lies elsewhere than seen from the front, by centimetres and for as long as the person
stands so. Nobody can tell which sensor is right, so the mean of all stays where it is: offsets sum to zero. What they
buy is that the point stays where it was when one of the sensors falls silent, and is not pulled to and fro meanwhile.
"""

from __future__ import annotations

from typing import Final

from fusion.compiled import Record, Records, kernel
from fusion.estimation.vectors import Vector, length

FOLLOW_S: Final = 2.0
"""Offsets change as the person turns, and must outlast one movement of the arm; 1 to 4 s serve."""
LARGEST_M: Final = 0.15
"""More than this is a wandering joint and no bias."""

FIELDS: Final = [
    ("offset_m", "f8", (3,)),  # where this sensor sees the joint, less where all do; in room
    ("heard_s", "f8"),  # when the sensor last spoke
]
"""What is remembered of each joint of each sensor."""


@kernel
def share_of(word: Record, t_s: float) -> float:
    """How much a sensor's word at `t_s` counts in its bias, by how long it had been silent."""
    silent_s: float = t_s - word.heard_s
    word.heard_s = t_s
    return min(max(silent_s / FOLLOW_S, 0.0), 0.1)


@kernel
def learn(words: Records, own: int, difference_m: Vector, share: float) -> None:
    """Follow `difference_m`, measured less fused, of a joint that another sensor sees as well.

    `words` (K,) are what is remembered of the joint, sensor by sensor.
    """
    offset_m = words[own].offset_m
    for k in range(3):
        offset_m[k] += share * (difference_m[k] - offset_m[k])
    _centre(words)


@kernel
def _centre(words: Records) -> None:
    """The same differences, none too large, with no offset that all sensors share."""
    for axis in range(3):
        total = 0.0
        for k in range(len(words)):
            total += words[k].offset_m[axis]
        for k in range(len(words)):
            words[k].offset_m[axis] -= total / len(words)
    for k in range(len(words)):
        offset_m = words[k].offset_m
        excess = length(offset_m) / LARGEST_M
        for axis in range(3):
            offset_m[axis] /= max(excess, 1.0)
