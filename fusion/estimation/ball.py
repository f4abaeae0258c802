"""How far the point may be off, learnt from how far its own predictions were off; it completes the guaranteed set.

The set stands on the worst that a sensor (±0.2 m) and a limb (20 m/s²) can do, and is half a metre wide for it. What
they do as a rule is seen, joint by joint, in how far the sensors' words are from the point. The ball is as wide as the
worst of the last second, what no word can show because the sensors share it, and what an acceleration can have added
since somebody was last believed. Sensors that agree with each other share little, those that differ share more.
"""

from __future__ import annotations

from math import exp, sqrt
from typing import Final

from fusion.compiled import Record, kernel
from fusion.estimation.motion_set import ACCELERATION_MAX

LEAST_M: Final = 0.02
"""Shared by sensors that agree perfectly."""
SHARED: Final = 2.3
"""What sensors share, in root mean squares of their distance from the point between them; the least for which the truth
is in the ball at every instant with errors as in [Du2016 Table 1] of a frame-to-frame correlation of 0.9."""
START_APART_M: Final = 0.045
"""One sensor's standard deviation [Du2016 Table 1], before several were heard."""
FOLLOW_S: Final = 2.5
START_M: Final = 0.2
"""The worst before there was any word: a sensor's whole error interval."""
FORGET_S: Final = 1.0

FIELDS: Final = [
    ("worst_m", "f8"),  # farthest word from the point, fading
    ("apart_m2", "f8"),  # mean square of the words' distance from the point while several are believed
]
"""What is kept in a joint's record."""


@kernel
def forget(joint: Record) -> None:
    """Nothing was heard yet."""
    joint.worst_m, joint.apart_m2 = START_M, START_APART_M**2


@kernel
def learn(joint: Record, off_m: float, shared: bool, passed_s: float) -> None:
    """A believed word was `off_m` from the point predicted, `passed_s` after the last believed one.

    `shared`: another sensor is believed as well.
    """
    joint.worst_m = max(joint.worst_m * exp(-max(passed_s, 0.0) / FORGET_S), off_m)
    if shared:
        joint.apart_m2 += min(max(passed_s, 0.0) / FOLLOW_S, 0.2) * (off_m**2 - joint.apart_m2)


@kernel
def radius_m(joint: Record, believed_s: float, sensors: int, t_s: float) -> float:
    """The ball's radius at `t_s`; infinite for a joint never believed.

    `sensors` believed of late: a lone one errs by √2 as much as the mean of two.
    """
    worst_m: float = joint.worst_m
    shared_m = LEAST_M + SHARED * sqrt(joint.apart_m2 * (1 if sensors > 1 else 2))
    return shared_m + worst_m + ACCELERATION_MAX / 2 * max(t_s - believed_s, 0.0) ** 2
