"""A constant-velocity Kalman filter for one joint, driven by white acceleration, with a gate.

State [p; v] per axis. Measurement noise and process noise are the same on the three axes, so one 2×2 covariance
[[pp, pv], [pv, vv]] serves all three.
"""

from __future__ import annotations

from math import sqrt
from typing import Final

import numpy as np

from fusion.compiled import Record, kernel
from fusion.estimation.freshness import seconds_in_motion
from fusion.estimation.vectors import Vector, plus

FRAME_S: Final = 1 / 30
ACCELERATION_STD: Final = 12.0
"""m/s² per 30 Hz frame; 12 to 25 serve, 6 lags behind a reaching hand. The calmest that serves."""
ACCELERATION_DENSITY: Final = ACCELERATION_STD**2 * FRAME_S  # m²/s³
START_SPEED_STD: Final = 1.0  # m/s
GATE_SIGMA: Final = 4.0
RESTART_AFTER_S: Final = 0.5
"""Refusals in a row for this long mean that what is known is wrong, not the sensors."""

FIELDS: Final = [
    ("position", "f8", (3,)),  # m
    ("velocity", "f8", (3,)),  # m/s
    ("pp", "f8"),  # m²
    ("pv", "f8"),  # m²/s
    ("vv", "f8"),  # m²/s²
    ("seen_s", "f8"),  # time of the last measurement that was used
    ("refused_since_s", "f8"),  # when the present row of refusals began; +inf when there is none
]
"""What the filter keeps in a joint's record; a joint never seen has `seen_s` = -inf and NaN position."""


@kernel
def forget(joint: Record) -> None:
    """Nothing was seen yet."""
    joint.position[:] = np.nan
    joint.velocity[:] = 0.0
    joint.pp = joint.pv = joint.vv = 0.0
    joint.seen_s, joint.refused_since_s = -np.inf, np.inf


@kernel
def predict(joint: Record, from_s: float, to_s: float, density: float) -> None:
    """Move on: p + v dt, P → F P F' + Q, with the mean halted three frames after the last measurement.

    Q = q [[dt³/3, dt²/2], [dt²/2, dt]], `density` q = a²/30 Hz for a white acceleration of a per frame. The covariance
    grows through the whole silence, the mean does not fly off. What is not later changes nothing.
    """
    dt, q = to_s - from_s, density
    if not 0 < dt < np.inf:  # an older sample, or the very first
        return
    moving_s = seconds_in_motion(joint.seen_s, from_s, to_s)
    for k in range(3):
        joint.position[k] += joint.velocity[k] * moving_s
        joint.velocity[k] *= moving_s > 0
    joint.pp += 2 * dt * joint.pv + dt**2 * joint.vv + q * dt**3 / 3
    joint.pv += dt * joint.vv + q * dt**2 / 2
    joint.vv += q * dt


@kernel
def carried_on(joint: Record, position: Vector, late_s: float) -> Vector:
    """A position measured a little before the joint's own time, moved on with its velocity."""
    return plus(position, joint.velocity, late_s)


@kernel
def sigmas_off(joint: Record, position: Vector, variance: float) -> float:
    """How far a measurement is from its prediction on its worst axis, in standard deviations of the difference.

    Axis by axis, because that is what a number of sigmas is said of: a distance in three dimensions exceeds 4 twenty
    times as often as one axis does. NaN for a joint never seen.
    """
    off = plus(position, joint.position, -1.0)
    return max(abs(off[0]), abs(off[1]), abs(off[2])) / sqrt(joint.pp + variance)


@kernel
def correct(joint: Record, position: Vector, variance: float, t_s: float) -> None:
    """Take a measurement; `variance` in m² is that of one axis."""
    gain = 1 / (joint.pp + variance)
    gain_p, gain_v = gain * joint.pp, gain * joint.pv
    for k in range(3):
        innovation = position[k] - joint.position[k]
        joint.position[k] += gain_p * innovation
        joint.velocity[k] += gain_v * innovation
    joint.vv -= gain_v * joint.pv
    joint.pp *= 1 - gain_p
    joint.pv *= 1 - gain_p
    joint.seen_s = t_s


@kernel
def start(joint: Record, position: Vector, variance: float, t_s: float) -> None:
    """Begin at the measurement, at rest."""
    for k in range(3):
        joint.position[k] = position[k]
        joint.velocity[k] = 0.0
    joint.pp, joint.pv, joint.vv = variance, 0.0, START_SPEED_STD**2
    joint.seen_s, joint.refused_since_s = t_s, np.inf


@kernel
def insists(joint: Record, met: bool, t_s: float) -> bool:
    """Remember whether a measurement met what was expected; True once none did for half a second in a row."""
    if met:
        joint.refused_since_s = np.inf
    else:
        joint.refused_since_s = min(joint.refused_since_s, t_s)
    return bool(t_s - joint.refused_since_s >= RESTART_AFTER_S)
