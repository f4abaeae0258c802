"""The set that holds each joint's position and velocity, moved on under bounded acceleration and speed.

On each of the room's axes an ellipse in [p; v] couples position with velocity, and an interval beside it keeps what
the latest boxes said: a joint lies in the intersection. In one ellipsoid of six dimensions every strip would leave
√6 of its width; on an axis of its own it leaves √2, and the interval cuts that too.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Final

import numpy as np

from fusion.estimation.ellipsoid import Ellipsoids, choose, cut, half_width, outer_sum
from fusion.estimation.measurement import Flags
from fusion.messages import Floats
from fusion.skeleton import JOINT_COUNT

ACCELERATION_MAX: Final = 20.0
"""m/s², what a limb can do [methods §5]."""
SPEED_MAX: Final = 6.0
"""m/s, likewise."""
ENDLESS_M: Final = 1e3
"""Farther than any sensor sees, and still a number."""
POSITION: Final = np.array([1.0, 0.0])
VELOCITY: Final = np.array([0.0, 1.0])


@dataclass(frozen=True, slots=True)
class MotionSet:
    """At `t_s`, on every axis, [p; v] lies in the ellipse and p in low..high. A joint never seen may be anywhere."""

    t_s: float
    body: Ellipsoids  # (J, 3), D = 2; m and m/s
    low: Floats  # (J, 3) m
    high: Floats  # (J, 3) m


def anywhere(t_s: float) -> MotionSet:
    """Nothing known; `begin` replaces it joint by joint."""
    shape = np.broadcast_to(np.eye(2), (JOINT_COUNT, 3, 2, 2))
    endless = np.full((JOINT_COUNT, 3), ENDLESS_M)
    return MotionSet(t_s, Ellipsoids(np.zeros((JOINT_COUNT, 3, 2)), shape), -endless, endless)


def move(motion: MotionSet, t_s: float) -> MotionSet:
    """Hold all that p' = v, |v'| <= 20 m/s² and |v| <= 6 m/s can reach by `t_s`."""
    dt = t_s - motion.t_s
    if not 0 < dt < np.inf:  # an older sample, or the very first
        return MotionSet(max(t_s, motion.t_s), motion.body, motion.low, motion.high)
    step = np.array([[1.0, dt], [0.0, 1.0]])
    moved = outer_sum(Ellipsoids(motion.body.centre @ step.T, step @ motion.body.shape @ step.T), _reach(dt))
    body, _ = cut(moved, VELOCITY, np.zeros((JOINT_COUNT, 3)), np.full((JOINT_COUNT, 3), SPEED_MAX))
    slowest, fastest = _speeds(motion.body, dt)
    return MotionSet(t_s, _symmetric(body), motion.low + slowest * dt, motion.high + fastest * dt)


def _reach(dt: float) -> Floats:
    """(2, 2) ellipse of what a changing acceleration adds in `dt`: Δv within ±A dt, Δp within dt/2 Δv ± A dt²/4."""
    together = np.array([dt**2 / 2, dt])
    apart = np.array([dt**2 / 4, 0.0])
    return 2 * ACCELERATION_MAX**2 * (np.outer(together, together) + np.outer(apart, apart))


def _speeds(body: Ellipsoids, dt: float) -> tuple[Floats, Floats]:
    """(J, 3) m/s, the least and greatest mean velocity over the next `dt`."""
    middle = body.centre[..., 1]
    spread = half_width(body)[..., 1] + ACCELERATION_MAX * dt / 2
    return np.maximum(middle - spread, -SPEED_MAX), np.minimum(middle + spread, SPEED_MAX)


def _symmetric(body: Ellipsoids) -> Ellipsoids:
    """Sums and cuts multiply what rounding leaves of asymmetry and never shrink it; it grew to metres in seconds."""
    return Ellipsoids(body.centre, (body.shape + body.shape.swapaxes(-1, -2)) / 2)


def take(motion: MotionSet, positions: Floats, half: Floats, used: Flags) -> tuple[MotionSet, Flags]:
    """Cut with |p - positions| <= half (J, 3) m where `used` (J,); says which joints' measurements met their set.

    A joint whose measurement does not meet its set stays as it was.
    """
    low, high = np.maximum(motion.low, positions - half), np.minimum(motion.high, positions + half)
    met = used & (low < high).all(axis=1)
    body, meets = cut(motion.body, POSITION, (low + high) / 2, np.where(met[:, None], (high - low) / 2, np.inf))
    met &= meets.all(axis=1)
    return _replaced(motion, met, body, low, high), met


def begin(motion: MotionSet, positions: Floats, half: Floats, which: Flags) -> MotionSet:
    """Start the joints in `which` from their box alone, at any speed within the bound."""
    if not which.any():
        return motion
    shape = np.zeros((JOINT_COUNT, 3, 2, 2))
    shape[..., 0, 0] = 2 * half**2  # doubled, so that the ellipse holds the whole rectangle
    shape[..., 1, 1] = 2 * SPEED_MAX**2
    centre = np.stack([positions, np.zeros_like(positions)], axis=-1)
    return _replaced(motion, which, Ellipsoids(centre, shape), positions - half, positions + half)


def extent(motion: MotionSet) -> tuple[Floats, Floats]:
    """(J, 3) m, the least and greatest position on each axis that is still possible."""
    middle, half = motion.body.centre[..., 0], half_width(motion.body)[..., 0]
    return np.maximum(motion.low, middle - half), np.minimum(motion.high, middle + half)


def _replaced(motion: MotionSet, which: Flags, body: Ellipsoids, low: Floats, high: Floats) -> MotionSet:
    on_axes = which[:, None]
    return MotionSet(
        motion.t_s,
        choose(np.broadcast_to(on_axes, low.shape), body, motion.body),
        np.where(on_axes, low, motion.low),
        np.where(on_axes, high, motion.high),
    )
