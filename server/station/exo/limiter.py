"""One joint's set-point, moved towards a goal inside range, velocity, acceleration and jerk, always (SR-1, SR-2).

Each tick wishes for a jerk. The step it leads to is taken only if from there the fastest jerk-limited way to rest
(`brake`) stays inside the range, and the velocity that a fading acceleration still adds inside its limit. Otherwise
the tick goes as far from the brake's own step towards the wished one as that holds. The brake's step was found safe by
the tick before, so by induction no limit is ever broken (docs/decisions/jerk-limited-motion.md).
"""

from __future__ import annotations

from dataclasses import dataclass, replace
from math import copysign, sqrt

from server.station.exo.brake import Brake, Motion

__all__ = ["Box", "Motion", "to_rest", "towards"]
APPROACH_1_S, SPEED_UP_1_S, FADE_1_S = 6.0, 45.0, 90.0
"""Gains from an error to a velocity, from that to an acceleration, from that to a jerk. The goal's own velocity is
followed at once and its angle gently: more than that answers a noisy goal with the full acceleration, to and fro.
"""
PLANNED = 0.7
"""Share of acceleration and jerk that the approach plans to brake with."""
TOP = 0.98
"""Share of the velocity limit that is wished for; the guard at the limit itself would be felt as a rattle."""
HALVINGS = 4
"""Tries between the brake's step and the wished one."""


@dataclass(frozen=True, slots=True)
class Box:
    """What one joint's set-point may do."""

    low_rad: float
    high_rad: float
    velocity_rad_s: float
    acceleration_rad_s2: float
    jerk_rad_s3: float


def towards(motion: Motion, goal_rad: float, goal_rad_s: float, box: Box, speed: float, dt_s: float) -> Motion:
    """Move one tick towards a moving goal.

    Limits that were lowered in mid-motion, or a start outside the range, are met as soon as the jerk limit allows:
    velocity and acceleration by the brake, the range by coming no further out and then back.

    Args:
        motion: the set-point now.
        goal_rad: where it should be; outside the range it is taken as the range's end, at rest.
        goal_rad_s: how fast the goal itself moves.
        box: the limits.
        speed: 0..1 of the velocity limit.
        dt_s: length of the tick.
    """
    wished = _stepped(motion, _jerk(motion, goal_rad, goal_rad_s, box, speed, dt_s), dt_s)
    room = _Room(box, box.low_rad, box.high_rad, motion.angle_rad, box.velocity_rad_s * dt_s)
    if room.holds(wished):
        return wished
    brake = Brake.of(motion, box.acceleration_rad_s2, box.jerk_rad_s3)
    low_rad, high_rad = min(box.low_rad, brake.low_rad), max(box.high_rad, brake.high_rad)
    return _furthest(brake.after(dt_s), wished, replace(room, low_rad=low_rad, high_rad=high_rad))


def to_rest(motion: Motion, box: Box, dt_s: float) -> Motion:
    """Come to rest the fastest way that acceleration and jerk allow."""
    return Brake.of(motion, box.acceleration_rad_s2, box.jerk_rad_s3).after(dt_s)


def _jerk(motion: Motion, goal_rad: float, goal_rad_s: float, box: Box, speed: float, dt_s: float) -> float:
    """The wish: each of velocity, acceleration and jerk in proportion to what lacks, and inside its own limit."""
    goal = min(max(goal_rad, box.low_rad), box.high_rad)
    lead_rad_s = goal_rad_s if goal == goal_rad else 0.0
    error = goal - motion.angle_rad
    approach = min(APPROACH_1_S * abs(error), _stoppable(abs(error), box))
    velocity = _within(copysign(approach, error) + lead_rad_s, TOP * speed * box.velocity_rad_s)
    acceleration = _within(SPEED_UP_1_S * (velocity - motion.velocity_rad_s), box.acceleration_rad_s2)
    gain = min(FADE_1_S, 1.0 / dt_s)
    return _within(gain * (acceleration - motion.acceleration_rad_s2), box.jerk_rad_s3)


def _stoppable(room_rad: float, box: Box) -> float:
    """Velocity from which a planned brake needs this room: v²/2a + v a/2j."""
    a = PLANNED * box.acceleration_rad_s2
    fade = a * a / (2 * PLANNED * box.jerk_rad_s3)
    return sqrt(fade * fade + 2 * a * room_rad) - fade


def _stepped(motion: Motion, jerk_rad_s3: float, dt_s: float) -> Motion:
    """A tick of constant jerk."""
    q, v, a, j = motion.angle_rad, motion.velocity_rad_s, motion.acceleration_rad_s2, jerk_rad_s3
    return Motion(
        q + dt_s * (v + dt_s * (a / 2 + dt_s * j / 6)),
        v + dt_s * (a + dt_s * j / 2),
        a + dt_s * j,
    )


@dataclass(frozen=True, slots=True)
class _Room:
    """What the end of a tick must keep."""

    box: Box
    low_rad: float
    high_rad: float
    start_rad: float
    way_rad: float
    """Furthest from the start."""

    def holds(self, motion: Motion) -> bool:
        """Whether from here the brake breaks no limit; what is not a number is not safe."""
        v, a, box = motion.velocity_rad_s, motion.acceleration_rad_s2, self.box
        peak_rad_s = max(abs(v), abs(v + a * abs(a) / (2 * box.jerk_rad_s3)))
        if not (abs(a) <= box.acceleration_rad_s2 and peak_rad_s <= box.velocity_rad_s):
            return False
        if not abs(motion.angle_rad - self.start_rad) <= self.way_rad:
            return False
        brake = Brake.of(motion, box.acceleration_rad_s2, box.jerk_rad_s3)
        return self.low_rad <= brake.low_rad and brake.high_rad <= self.high_rad


def _furthest(safe: Motion, wished: Motion, room: _Room) -> Motion:
    """The state nearest to the wished one, of a few on the way from a safe one, that is safe too.

    Motion is linear in its jerk, so what lies between two reachable states is reachable within the same jerk.
    """
    share, step = 0.0, 0.5
    found = safe
    for _ in range(HALVINGS):
        tried = _between(safe, wished, share + step)
        if room.holds(tried):
            found, share = tried, share + step
        step /= 2
    return found


def _between(one: Motion, other: Motion, share: float) -> Motion:
    return Motion(
        one.angle_rad + share * (other.angle_rad - one.angle_rad),
        one.velocity_rad_s + share * (other.velocity_rad_s - one.velocity_rad_s),
        one.acceleration_rad_s2 + share * (other.acceleration_rad_s2 - one.acceleration_rad_s2),
    )


def _within(value: float, limit: float) -> float:
    return min(max(value, -limit), limit)
