"""What smoothing and limiting all joints costs in one tick."""

from __future__ import annotations

import time

import numpy as np

from fusion.messages import Floats
from server.experiments.cranked.station import DT_S
from server.experiments.lag.course import DEVICE
from server.station.exo.driver import ZERO
from server.station.exo.limiter import Motion, towards
from server.station.exo.mapping import JointTarget
from server.station.exo.smoothing import Calm, calmed


def cost_us(seen_rad: Floats) -> Floats:
    """(T, 2) microseconds of smoothing and of limiting, on angles (T, 4)."""
    calm, motions = Calm(), tuple(map(Motion, seen_rad[0].tolist()))
    spent = np.empty((len(seen_rad), 2))
    for k, seen in enumerate(seen_rad.tolist()):
        given = JointTarget(tuple(seen), ZERO, ZERO, (1.0,) * 4)
        begun = time.perf_counter()
        calm, target = calmed(calm, given, DT_S)
        calmed_at, wanted = time.perf_counter(), target or given
        goals = zip(motions, wanted.angle_rad, wanted.velocity_rad_s, DEVICE, strict=True)
        motions = tuple(towards(motion, goal, goal_rad_s, box, 1.0, DT_S) for motion, goal, goal_rad_s, box in goals)
        spent[k] = calmed_at - begun, time.perf_counter() - calmed_at
    return 1e6 * spent
