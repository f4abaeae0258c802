"""What each sensor says differently from the others, joint by joint, and how long that lasts.

Seen from the side a shoulder lies elsewhere than seen from the front, by centimetres and for as long as the arm is held
so. A sensor's bias is therefore taken to fade as the joint moves in the body, and hardly with time (an
Ornstein-Uhlenbeck process whose clock is mostly the path). It is learnt with the point itself, by one filter
(`biased_filter.py`): where two sensors differ, half is believed of each; nobody knows which is right. That buys a point
that stays where it was when a sensor falls silent, goes on with what the other sees, and is not pulled to and fro by
the two meanwhile.
"""

from __future__ import annotations

from math import exp
from typing import Final

import numpy as np

from fusion.compiled import Record, Records, kernel
from fusion.estimation.vectors import Vector, distance
from fusion.messages import Floats

STD_M: Final = 0.033
"""Of a believed joint, on one axis; 0.025 to 0.045 serve."""
FADE_S: Final = 8.0
"""4 to 20 s serve."""
FADE_M: Final = 0.15
"""Path of the joint beside the spine over which its bias becomes another; 0.1 to 0.2 m serve."""
DOUBTED_STD_M: Final = 0.2
"""Off by half a metre at worst is 0.2 to 0.3 m as a rule; 0.15 to 0.3 m serve."""
DOUBTED_FADE_S: Final = 20.0
DOUBTED_FADE_M: Final = 0.4
"""What is not seen but made up goes where it likes; 0.2 to 0.8 m serve."""

FIELDS: Final = [
    ("offset_m", "f8", (3,)),  # the bias, in room
    ("with_position", "f8"),  # m², its covariance with the joint's position
    ("with_velocity", "f8"),  # m²/s, and velocity, on one axis
    ("place_m", "f8", (3,)),  # where the sensor last saw the joint, from the spine; in room
    ("heard_s", "f8"),  # when; -inf never
    ("was_believed", "?"),
]
"""What is remembered of each joint of each sensor."""


@kernel
def strange(word: Record, bias_m2: Floats, own: int) -> None:
    """Nothing was heard of this sensor yet; `bias_m2` (K, K) are how the sensors' biases vary together in one joint."""
    word.heard_s, word.was_believed = -np.inf, True
    bias_m2[own, own] = STD_M**2


@kernel
def age(words: Records, bias_m2: Floats, own: int, from_spine: Vector, spine_seen: bool, t_s: float) -> None:
    """Let a sensor's bias in one joint fade by the time and the path since its last word.

    `from_spine` is the joint's place as this sensor sees it, less where it sees the spine: a body that sways keeps its
    biases.
    """
    word = words[own]
    if np.isfinite(word.heard_s):
        path_m = distance(from_spine, word.place_m) if spine_seen else 0.0
        _fade(words, bias_m2, own, max(t_s - word.heard_s, 0.0), path_m)
    word.heard_s = t_s
    if spine_seen:
        word.place_m[0], word.place_m[1], word.place_m[2] = from_spine


@kernel
def _fade(words: Records, bias_m2: Floats, own: int, passed_s: float, path_m: float) -> None:
    word = words[own]
    if word.was_believed:
        std_m, kept = STD_M, exp(-passed_s / FADE_S - path_m / FADE_M)
    else:
        std_m, kept = DOUBTED_STD_M, exp(-passed_s / DOUBTED_FADE_S - path_m / DOUBTED_FADE_M)
    for axis in range(3):
        word.offset_m[axis] *= kept
    word.with_position *= kept
    word.with_velocity *= kept
    for k in range(len(words)):
        bias_m2[own, k] *= kept
        bias_m2[k, own] *= kept
    bias_m2[own, own] += std_m**2 * (1 - kept**2)


@kernel
def reopen(words: Records, bias_m2: Floats, own: int, believed: bool) -> None:
    """A joint comes into doubt or out of it: what it says differently may change by decimetres at once.

    The offset learnt so far is the best guess still: who is believed again pulls the point only as far as others agree.
    """
    word = words[own]
    if word.was_believed == believed:
        return
    word.was_believed = believed
    word.with_position = word.with_velocity = 0.0
    for k in range(len(words)):
        bias_m2[own, k] = bias_m2[k, own] = 0.0
    bias_m2[own, own] = DOUBTED_STD_M**2
