"""How far the point may be off, learnt from how far its own predictions were off; it completes the guaranteed set.

The set stands on the worst that a sensor (±0.2 m) and a limb (20 m/s²) can do, and is half a metre wide for it. What
they do as a rule is seen in the innovations: the ball is as wide as the worst of the last second, what no innovation
can show because both sensors share it, and what an acceleration can have added since somebody was last believed.
"""

from __future__ import annotations

from math import exp
from typing import Final

from fusion.compiled import Record, kernel
from fusion.estimation.motion_set import ACCELERATION_MAX

HIDDEN_M: Final = 0.09
"""Two standard deviations of one sensor's error [Du2016 Table 1], which the other sensor may share."""
START_M: Final = 0.2
"""The worst innovation before there was any: a sensor's whole error interval."""
FORGET_S: Final = 1.0

FIELDS: Final = [("worst_innovation_m", "f8")]
"""What is kept in a joint's record."""


@kernel
def learn(joint: Record, innovation_m: float, dt: float) -> None:
    """The worst innovation, fading within seconds as smaller ones follow."""
    faded_m = joint.worst_innovation_m * exp(-max(dt, 0.0) / FORGET_S)
    joint.worst_innovation_m = max(faded_m, innovation_m)


@kernel
def radius_m(joint: Record, believed_s: float, t_s: float) -> float:
    """The ball's radius at `t_s`; infinite for a joint never believed."""
    worst_m: float = joint.worst_innovation_m
    return HIDDEN_M + worst_m + ACCELERATION_MAX / 2 * max(t_s - believed_s, 0.0) ** 2
