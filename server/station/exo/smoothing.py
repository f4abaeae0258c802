"""Calms a joint target: what a depth camera sees of a resting arm trembles, and an exoskeleton must not.

A critically damped observer of angle and velocity, x̂' = v̂ + 2 ω (x − x̂), v̂' = ω² (x − x̂): no lag behind a steady
movement. docs/decisions/calm-targets.md has what was measured.
"""

from __future__ import annotations

from dataclasses import dataclass, replace

from server.station.exo.driver import Joints
from server.station.exo.mapping import JointTarget

OMEGA_RAD_S = 8.0
LEAD = 0.5
"""Share of the observed velocity that the command is told: with all of it the noise of the velocity shows, with none
the command lags 0.11 s behind the target."""


@dataclass(frozen=True, slots=True)
class Calm:
    """What has been observed of the target; None before the first."""

    angle_rad: Joints | None = None
    velocity_rad_s: Joints = ()


def calmed(before: Calm, target: JointTarget | None, dt_s: float) -> tuple[Calm, JointTarget | None]:
    """The target after the observer; a lost target forgets everything.

    Args:
        before: what was observed so far.
        target: the new target.
        dt_s: since the last one.
    """
    if target is None:
        return Calm(), None
    if before.angle_rad is None:
        return Calm(target.angle_rad, (0.0,) * len(target.angle_rad)), target
    angles, velocities = [], []
    for seen, angle, velocity in zip(target.angle_rad, before.angle_rad, before.velocity_rad_s, strict=True):
        error = seen - angle
        angles.append(angle + (velocity + 2 * OMEGA_RAD_S * error) * dt_s)
        velocities.append(velocity + OMEGA_RAD_S**2 * error * dt_s)
    after = Calm(tuple(angles), tuple(velocities))
    lead = tuple(LEAD * velocity for velocity in velocities)
    return after, replace(target, angle_rad=tuple(angles), velocity_rad_s=lead)
