"""The set that holds a joint's position and velocity, moved on under bounded acceleration and speed.

On each of the room's axes an ellipse in [p; v] couples position with velocity, and an interval beside it keeps what
the latest boxes said: a joint lies in the intersection. In one ellipsoid of six dimensions every strip would leave
√6 of its width; on an axis of its own it leaves √2, and the interval cuts that too.

Any evidence of where a joint is cuts its set: `take(joint, centre, half)`, whoever says it.
"""

from __future__ import annotations

from math import sqrt
from typing import Final, NamedTuple

import numpy as np

from fusion.compiled import Record, kernel, record
from fusion.estimation.ellipse import Ellipse, Normal, cut, outer_sum
from fusion.estimation.vectors import Vector

ACCELERATION_MAX: Final = 20.0
"""m/s², what a limb can do."""
SPEED_MAX: Final = 6.0
"""m/s, likewise."""
ENDLESS_M: Final = 1e3
"""Farther than any sensor sees, and still a number."""
POSITION: Final[Normal] = (1.0, 0.0)
VELOCITY: Final[Normal] = (0.0, 1.0)

AXIS: Final = record([(name, "f8") for name in (*Ellipse._fields, "low", "high")])
FIELDS: Final = [("on", AXIS, (3,))]
"""What the set adds to a joint's record; m and m/s."""


class Axis(NamedTuple):
    """On one of the room's axes [p; v] lies in the ellipse and p in low..high."""

    body: Ellipse
    low: float
    high: float


@kernel
def forget(joint: Record) -> None:
    """Nothing known: the joint may be anywhere."""
    for k in range(3):
        _write(joint.on[k], Axis(Ellipse(0.0, 0.0, 1.0, 0.0, 1.0), -ENDLESS_M, ENDLESS_M))


@kernel
def move(joint: Record, dt: float) -> None:
    """Hold all that p' = v, |v'| <= 20 m/s² and |v| <= 6 m/s can reach within `dt`; nothing for what is not later."""
    if 0 < dt < np.inf:
        for k in range(3):
            _write(joint.on[k], moved(axis_of(joint, k), dt))


@kernel
def take(joint: Record, centre: Vector, half: Vector) -> bool:
    """Cut with |p - centre| <= half on every axis, in metres; says whether that met the set, which else stays."""
    x, met_x = cut_axis(axis_of(joint, 0), centre[0], half[0])
    y, met_y = cut_axis(axis_of(joint, 1), centre[1], half[1])
    z, met_z = cut_axis(axis_of(joint, 2), centre[2], half[2])
    met = met_x and met_y and met_z
    if met:
        _write(joint.on[0], x)
        _write(joint.on[1], y)
        _write(joint.on[2], z)
    return met


@kernel
def begin(joint: Record, centre: Vector, half: Vector) -> None:
    """Start from a box alone, at any speed within the bound; doubled, so that the ellipse holds the whole rectangle."""
    for k in range(3):
        body = Ellipse(centre[k], 0.0, 2 * half[k] ** 2, 0.0, 2 * SPEED_MAX**2)
        _write(joint.on[k], Axis(body, centre[k] - half[k], centre[k] + half[k]))


@kernel
def extent(joint: Record, k: int) -> tuple[float, float]:
    """The least and greatest position on axis `k` that is still possible, in metres."""
    axis = axis_of(joint, k)
    half = sqrt(axis.body.pp)
    return max(axis.low, axis.body.p - half), min(axis.high, axis.body.p + half)


@kernel
def moved(axis: Axis, dt: float) -> Axis:
    """One axis moved on by `dt` > 0."""
    slowest, fastest = _speeds(axis.body, dt)
    body, _ = cut(_carried(axis.body, dt), VELOCITY, 0.0, SPEED_MAX)
    return Axis(body, axis.low + slowest * dt, axis.high + fastest * dt)


@kernel
def _carried(body: Ellipse, dt: float) -> Ellipse:
    """F E ⊕ Q with Q what a changing acceleration adds: Δv within ±A dt, Δp within dt/2 Δv ± A dt²/4."""
    pp = body.pp + 2 * dt * body.pv + dt**2 * body.vv
    straight = Ellipse(body.p + body.v * dt, body.v, pp, body.pv + dt * body.vv, body.vv)
    doubled = 2 * ACCELERATION_MAX**2
    return outer_sum(straight, doubled * (dt**4 / 4 + dt**4 / 16), doubled * dt**3 / 2, doubled * dt**2)


@kernel
def _speeds(body: Ellipse, dt: float) -> tuple[float, float]:
    """The least and greatest mean velocity over the next `dt`, in m/s."""
    spread = sqrt(body.vv) + ACCELERATION_MAX * dt / 2
    return max(body.v - spread, -SPEED_MAX), min(body.v + spread, SPEED_MAX)


@kernel
def cut_axis(axis: Axis, middle: float, half: float) -> tuple[Axis, bool]:
    """One axis cut with |p - middle| <= half; says whether they met, and is meaningless where they did not."""
    low, high = max(axis.low, middle - half), min(axis.high, middle + half)
    body, met = cut(axis.body, POSITION, (low + high) / 2, (high - low) / 2)
    return Axis(body, low, high), met and low < high


@kernel
def axis_of(joint: Record, k: int) -> Axis:
    """What a joint's record says of one axis."""
    on = joint.on[k]
    return Axis(Ellipse(on.p, on.v, on.pp, on.pv, on.vv), on.low, on.high)


@kernel
def _write(on: Record, axis: Axis) -> None:
    on.p, on.v, on.pp, on.pv, on.vv = axis.body.p, axis.body.v, axis.body.pp, axis.body.pv, axis.body.vv
    on.low, on.high = axis.low, axis.high
