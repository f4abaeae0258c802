"""The filters that stand beside ours, each on one angle (T,), tick by tick, causal; and ours with its limiter."""

from __future__ import annotations

from dataclasses import dataclass
from math import pi

import numpy as np

from fusion.messages import Floats
from server.experiments.cranked.station import DT_S
from server.station.exo.driver import ZERO
from server.station.exo.limiter import Box, Motion, towards
from server.station.exo.mapping import JointTarget
from server.station.exo.smoothing import Calm, calmed

FREE = (1.0,) * 4


@dataclass(frozen=True, slots=True)
class Moved:
    """What set-points did, (T, 4) each."""

    calm_rad: Floats
    """Before the limiter."""
    angle_rad: Floats
    acceleration_rad_s2: Floats


def ours(seen_rad: Floats, boxes: tuple[Box, ...]) -> Moved:
    """The station's smoothing and limiter on all angles (T, 4)."""
    calm, motions = Calm(), tuple(map(Motion, seen_rad[0].tolist()))
    rows = []
    for seen in seen_rad.tolist():
        calm, target = calmed(calm, JointTarget(tuple(seen), ZERO, ZERO, FREE), DT_S)
        goals = (target.angle_rad, target.velocity_rad_s) if target else (tuple(seen), ZERO)
        motions = tuple(
            towards(motion, goal, goal_rad_s, box, 1.0, DT_S)
            for motion, goal, goal_rad_s, box in zip(motions, *goals, boxes, strict=True)
        )
        rows.append((goals[0], tuple(m.angle_rad for m in motions), tuple(m.acceleration_rad_s2 for m in motions)))
    found = np.array(rows)
    return Moved(found[:, 0], found[:, 1], found[:, 2])


def limited(goal_rad: Floats, box: Box) -> Floats:
    """(T,) any other filter's output after the limiter."""
    motion, out = Motion(float(goal_rad[0])), np.empty(len(goal_rad))
    for k, goal in enumerate(goal_rad.tolist()):
        motion = towards(motion, goal, 0.0, box, 1.0, DT_S)
        out[k] = motion.angle_rad
    return out


def median(seen_rad: Floats, window_s: float) -> Floats:
    """The median of the last so many seconds."""
    window = round(window_s / DT_S)
    padded = np.concatenate([np.full(window - 1, seen_rad[0]), seen_rad])
    found: Floats = np.median(np.lib.stride_tricks.sliding_window_view(padded, window), axis=1)
    return found


def one_euro(seen_rad: Floats, least_hz: float, beta: float, derivative_hz: float = 1.0) -> Floats:
    """[Casiez 2012] 1€ filter, CHI: a low-pass whose cut-off grows with the speed, f = f_min + β |ẋ|."""
    angle, speed, out = float(seen_rad[0]), 0.0, np.empty(len(seen_rad))
    share = _share(derivative_hz)
    for k, seen in enumerate(seen_rad.tolist()):
        speed += share * ((seen - angle) / DT_S - speed)
        angle += _share(least_hz + beta * abs(speed)) * (seen - angle)
        out[k] = angle
    return out


def _share(cut_off_hz: float) -> float:
    return 1.0 / (1.0 + 1.0 / (2 * pi * cut_off_hz * DT_S))
