"""How far the point may be off, learnt from how far its own predictions were off; it completes the guaranteed set.

The set stands on the worst that a sensor (±0.2 m) and a limb (20 m/s²) can do, and is half a metre wide for it. What
they do as a rule is seen in the innovations: the ball is as wide as the worst of the last second, what no innovation
can show because both sensors share it, and what an acceleration can have added since somebody was last believed.
"""

from __future__ import annotations

from typing import Final

import numpy as np

from fusion.estimation.measurement import Flags
from fusion.estimation.motion_set import ACCELERATION_MAX
from fusion.messages import Floats
from fusion.skeleton import JOINT_COUNT

HIDDEN_M: Final = 0.09
"""Two standard deviations of one sensor's error [Du2016 Table 1], which the other sensor may share."""
START_M: Final = 0.2
FORGET_S: Final = 1.0


def start() -> Floats:
    """(J,) m, the worst innovation before there was any: a sensor's whole error interval."""
    return np.full(JOINT_COUNT, START_M)


def learn(worst_m: Floats, innovation_m: Floats, used: Flags, dt: float) -> Floats:
    """(J,) m, the worst innovation, fading within seconds as smaller ones follow."""
    faded = worst_m * np.exp(-max(dt, 0.0) / FORGET_S)
    return np.where(used, np.maximum(faded, innovation_m), worst_m)


def radius_m(worst_m: Floats, believed_s: Floats, t_s: float) -> Floats:
    """(J,) m, the ball's radius at `t_s`; infinite for a joint never believed."""
    return HIDDEN_M + worst_m + ACCELERATION_MAX / 2 * np.maximum(t_s - believed_s, 0.0) ** 2
