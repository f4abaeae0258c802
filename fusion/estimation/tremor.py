"""How much a sensor's word about a joint trembles from frame to frame, which is the white part of its noise.

The second difference of three frames in a row holds no constant error and no steady motion; of white noise of variance
r² on each axis it is 6 r². Real sensors tremble by millimetres (they smooth), simulated ones by centimetres.
"""

from __future__ import annotations

from typing import Final

from fusion.compiled import Record, kernel
from fusion.estimation.freshness import CONTINUE_S
from fusion.estimation.vectors import Vector

LEAST_STD_M: Final = 0.015
"""No less is believed of a sensor, so that no limb's jerk counts as noise; 0.01 to 0.02 m serve."""
DOUBTED_STD_M: Final = 0.03
"""Of a joint in doubt; 0.015 to 0.06 m serve."""
SHARE: Final = 0.05
"""Of one frame in what is learnt, so that a second or so counts."""
MOST_STD_M: Final = 0.1
"""No frame counts for more: a joint that jumps does not tremble."""

FIELDS: Final = [
    ("last_m", "f8", (3,)),
    ("last_but_one_m", "f8", (3,)),
    ("in_a_row", "i8"),  # frames without a hole
    ("tremor_m2", "f8"),  # r²
]
"""What is remembered of each joint of each sensor."""


@kernel
def learn(word: Record, position: Vector, silent_s: float, tracked: bool) -> None:
    """Follow one sensor's word about one joint, its last word being `silent_s` ago."""
    if silent_s > CONTINUE_S:
        word.in_a_row = 0
    squares = 0.0
    for axis in range(3):
        difference_m = position[axis] - 2 * word.last_m[axis] + word.last_but_one_m[axis]
        squares += difference_m * difference_m
        word.last_but_one_m[axis] = word.last_m[axis]
        word.last_m[axis] = position[axis]
    if tracked and word.in_a_row >= 2:
        word.tremor_m2 += SHARE * (min(squares / 18, MOST_STD_M**2) - word.tremor_m2)
    word.in_a_row += 1


@kernel
def variance(word: Record, believed: bool) -> float:
    """m² on one axis."""
    tremor_m2: float = word.tremor_m2
    return max(tremor_m2, LEAST_STD_M**2) if believed else max(tremor_m2, DOUBTED_STD_M**2)
