"""The gated filter of one joint (`gated_filter.py`), extended by every sensor's bias.

A sensor's errors are not white: of a few centimetres, millimetres change from frame to frame. A filter that takes them
for white believes itself too much, lags, and is pulled to and fro between two sensors. So the state is extended by the
coloured part of the noise (Bryson and Henrikson, Estimation using sampled data containing sequentially correlated
noise, J. Spacecraft 5(6), 1968), on each axis

    x = [p; v; b_1 .. b_K],    z_k = p + b_k + white noise,

with the same covariance on all three. [p; v] stands in the joint's record, b_k and its covariances with p and v in the
sensors' words, those of the biases with each other in `bias_m2` (K, K).
"""

from __future__ import annotations

from math import exp, sqrt
from typing import Final

import numpy as np

from fusion.compiled import Record, Records, kernel
from fusion.estimation import gated_filter
from fusion.estimation.freshness import CONTINUE_S
from fusion.estimation.gated_filter import FRAME_S
from fusion.estimation.vectors import Vector, length
from fusion.messages import Floats

CALM_STD: Final = 3.0
"""m/s² per 30 Hz frame, of a joint at rest; 2 to 4 serve, 1 lags."""
HURRY_STD: Final = 20.0
"""m/s² more per m/s: a limb that moves changes its speed within a twentieth of a second; 15 to 40 serve."""
MOST_STD: Final = 20.0
"""m/s²; also of a joint that nobody has seen for three frames."""

EASY_SPEED: Final = 0.15
"""m/s; a point at rest that is moved faster by a word was moved by what is learnt of a sensor, and not by the limb."""
GLIDE_S: Final = 0.1
"""Longer is calmer and lags: 0.08 to 0.15 s serve."""
FIELDS: Final = [("glide_m", "f8", (3,)), *gated_filter.FIELDS]  # from the filter's mean to the point told
"""What the filter keeps in a joint's record."""


@kernel
def predict(joint: Record, words: Records, from_s: float, to_s: float) -> None:
    """Move a joint on, and what its position and velocity have to do with the biases; `words` (K,) are its sensors'."""
    dt = to_s - from_s
    if not 0 < dt < np.inf:  # an older sample, or the very first
        return
    gated_filter.predict(joint, from_s, to_s, density(joint, to_s))
    for k in range(len(words)):
        words[k].with_position += dt * words[k].with_velocity
    settle(joint, dt)


@kernel
def settle(joint: Record, dt: float) -> None:
    """What is left to go of earlier steps goes."""
    for axis in range(3):
        joint.glide_m[axis] *= exp(-max(dt, 0.0) / GLIDE_S)


@kernel
def density(joint: Record, t_s: float) -> float:
    """m²/s³ of the white acceleration: a limb at rest stays so, one that moves may turn at once."""
    speed = length((joint.velocity[0], joint.velocity[1], joint.velocity[2]))
    hurried = min(CALM_STD + HURRY_STD * speed, MOST_STD)
    std = MOST_STD if t_s - joint.seen_s > CONTINUE_S else hurried
    return std**2 * FRAME_S


@kernel
def sigmas_off(joint: Record, words: Records, bias_m2: Floats, own: int, off: Vector, variance: float) -> float:
    """How far off a measurement is, `off` = z - p - b, on its worst axis, in its standard deviations."""
    spread = joint.pp + 2 * words[own].with_position + bias_m2[own, own] + variance
    return max(abs(off[0]), abs(off[1]), abs(off[2])) / sqrt(spread)


@kernel
def correct(
    joint: Record, words: Records, bias_m2: Floats, own: int, off: Vector, variance: float, t_s: float, c: Floats
) -> None:
    """Take a measurement of white noise `variance` m²: x += c off / s, P -= c c' / s, c = P h, s = h'c + variance.

    `c` (K,) is room for c's part of the biases.
    """
    word, count = words[own], len(words)
    c_p, c_v = joint.pp + word.with_position, joint.pv + word.with_velocity
    for k in range(count):
        c[k] = words[k].with_position + bias_m2[k, own]
    s = c_p + c[own] + variance
    for axis in range(3):
        joint.position[axis] += c_p / s * off[axis]
        joint.velocity[axis] += c_v / s * off[axis]
    _glide(joint, (c_p / s * off[0], c_p / s * off[1], c_p / s * off[2]), t_s)
    joint.pp -= c_p * c_p / s
    joint.pv -= c_p * c_v / s
    joint.vv -= c_v * c_v / s
    for k in range(count):
        for axis in range(3):
            words[k].offset_m[axis] += c[k] / s * off[axis]
        words[k].with_position -= c_p * c[k] / s
        words[k].with_velocity -= c_v * c[k] / s
        for other in range(count):
            bias_m2[k, other] -= c[k] * c[other] / s
    joint.seen_s = t_s


@kernel
def _glide(joint: Record, step: Vector, t_s: float) -> None:
    """Tell a step only so far as the joint may have made it; the rest follows within tenths of a second."""
    speed = length((joint.velocity[0], joint.velocity[1], joint.velocity[2]))
    may_m = (speed + EASY_SPEED) * max(t_s - joint.seen_s, 0.0)
    step_m = length(step)
    if step_m > may_m:
        for axis in range(3):
            joint.glide_m[axis] -= (1 - may_m / step_m) * step[axis]


@kernel
def learn_bias(joint: Record, words: Records, bias_m2: Floats, own: int, off: Vector, variance: float) -> None:
    """Take a measurement for its sensor's bias alone, the point being known better from others.

    The same with the gain of every other state 0 (Schmidt 1966): P -= g c' + c g' - g s g'.
    """
    word = words[own]
    c_p, c_v = joint.pp + word.with_position, joint.pv + word.with_velocity
    c_own = word.with_position + bias_m2[own, own]
    gain = c_own / (c_p + c_own + variance)
    for axis in range(3):
        word.offset_m[axis] += gain * off[axis]
    for k in range(len(words)):
        if k != own:
            bias_m2[k, own] -= gain * (words[k].with_position + bias_m2[k, own])
            bias_m2[own, k] = bias_m2[k, own]
    word.with_position -= gain * c_p
    word.with_velocity -= gain * c_v
    bias_m2[own, own] -= gain * c_own


@kernel
def start(
    joint: Record, words: Records, bias_m2: Floats, own: int, unbiased: Vector, variance: float, t_s: float
) -> None:
    """Begin at the measurement less its sensor's bias, at rest; p is then as sure as that bias, and errs with it."""
    own_m2 = bias_m2[own, own]
    gated_filter.start(joint, unbiased, variance + own_m2, t_s)
    joint.glide_m[:] = 0.0
    for k in range(len(words)):
        words[k].with_position = words[k].with_velocity = 0.0
        for other in range(len(words)):
            bias_m2[k, other] *= k == other
    words[own].with_position = -own_m2
