"""One joint's set-point, moved towards a goal inside range, velocity, acceleration and jerk (SR-1, SR-2)."""

from __future__ import annotations

from dataclasses import dataclass
from math import copysign, sqrt

APPROACH_1_S = 8.0
"""Gain of the approach near the goal: quick enough for a mirror, slow enough to leave the sensors' noise behind."""
SPEED_UP_1_S = 28.0
"""Gain from a wished velocity to an acceleration; with the gain above there is no overshoot."""
PLANNED, USED = 0.5, 0.9
"""Shares of the acceleration limit that the approach plans to brake with, and may use; the rest is the guard's."""


@dataclass(frozen=True, slots=True)
class Box:
    """What one joint's set-point may do."""

    low_rad: float
    high_rad: float
    velocity_rad_s: float
    acceleration_rad_s2: float
    jerk_rad_s3: float


@dataclass(frozen=True, slots=True)
class Motion:
    """One joint's set-point."""

    angle_rad: float
    velocity_rad_s: float = 0.0
    acceleration_rad_s2: float = 0.0


def towards(motion: Motion, goal_rad: float, goal_rad_s: float, box: Box, speed: float, dt_s: float) -> Motion:
    """Move one tick towards a moving goal.

    The wished velocity is the goal's own plus an approach that can still brake: min(k e, √(2 a e)). It is reached
    within the jerk limit. The guard then cuts any velocity from which the range could not be kept at full
    deceleration; the guard may break the jerk limit, never the others.

    Args:
        motion: the set-point now.
        goal_rad: where it should be; outside the range it is taken as the range's end.
        goal_rad_s: how fast the goal itself moves.
        box: the limits.
        speed: 0..1 of the velocity limit.
        dt_s: length of the tick.
    """
    goal = min(max(goal_rad, box.low_rad), box.high_rad)
    error = goal - motion.angle_rad
    approach = min(APPROACH_1_S * abs(error), sqrt(2 * PLANNED * box.acceleration_rad_s2 * abs(error)))
    top = speed * box.velocity_rad_s
    wished = _within(copysign(approach, error) + speed * goal_rad_s, top)
    acceleration = _within((wished - motion.velocity_rad_s) * SPEED_UP_1_S, USED * box.acceleration_rad_s2)
    jerk = box.jerk_rad_s3 * dt_s
    acceleration = motion.acceleration_rad_s2 + _within(acceleration - motion.acceleration_rad_s2, jerk)
    return _moved(motion, motion.velocity_rad_s + acceleration * dt_s, box, dt_s)


def to_rest(motion: Motion, box: Box, dt_s: float) -> Motion:
    """Come to rest at the full deceleration: a hold or a stop does not wait for comfort."""
    return _moved(motion, 0.0, box, dt_s)


def _moved(motion: Motion, wished_rad_s: float, box: Box, dt_s: float) -> Motion:
    step = box.acceleration_rad_s2 * dt_s
    guarded = min(
        max(wished_rad_s, -_stoppable(motion.angle_rad - box.low_rad, box, dt_s)),
        _stoppable(box.high_rad - motion.angle_rad, box, dt_s),
    )
    velocity = motion.velocity_rad_s + _within(guarded - motion.velocity_rad_s, step)
    acceleration = (velocity - motion.velocity_rad_s) / dt_s
    return Motion(motion.angle_rad + velocity * dt_s, velocity, acceleration)


def _stoppable(room_rad: float, box: Box, dt_s: float) -> float:
    """Largest velocity towards a limit that leaves room to brake: v dt + v² / 2a <= room, and the velocity limit."""
    if room_rad <= 0:
        return 0.0
    a = box.acceleration_rad_s2
    return min(box.velocity_rad_s, -a * dt_s + sqrt((a * dt_s) ** 2 + 2 * a * room_rad))


def _within(value: float, limit: float) -> float:
    return min(max(value, -limit), limit)
