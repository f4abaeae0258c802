"""The fastest way to rest inside acceleration and jerk, and how far it still leads (Ruckig's velocity control)."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Self

from ruckig import ControlInterface, InputParameter, Ruckig, Trajectory

_PLANNER = Ruckig(1)
"""Offline planning keeps nothing in it from one call to the next."""
_HERE = _REST = [0.0]
"""Planned from 0: a trajectory that never passes 0 is told as if it did [pantor/ruckig issue 215]."""


@dataclass(frozen=True, slots=True)
class Motion:
    """One joint's set-point."""

    angle_rad: float
    velocity_rad_s: float = 0.0
    acceleration_rad_s2: float = 0.0


@dataclass(frozen=True, slots=True)
class Brake:
    """The way to rest from one state."""

    start_rad: float
    trajectory: Trajectory
    """From 0."""
    low_rad: float
    """Least angle on the way, both ends included."""
    high_rad: float
    """Largest angle on the way, both ends included."""

    @classmethod
    def of(cls, motion: Motion, acceleration_rad_s2: float, jerk_rad_s3: float) -> Self:
        """Plan it. An acceleration above its limit is brought under it first, within the jerk.

        Args:
            motion: where it begins.
            acceleration_rad_s2: largest.
            jerk_rad_s3: largest.

        Raises:
            RuckigError: a limit is not above 0, or anything is not a number.
        """
        wanted, trajectory = InputParameter(1), Trajectory(1)
        wanted.control_interface = ControlInterface.Velocity
        wanted.current_position = _HERE
        wanted.current_velocity = [motion.velocity_rad_s]
        wanted.current_acceleration = [motion.acceleration_rad_s2]
        wanted.target_velocity = wanted.target_acceleration = _REST
        wanted.max_acceleration = [acceleration_rad_s2]
        wanted.max_jerk = [jerk_rad_s3]
        _PLANNER.calculate(wanted, trajectory)
        furthest = trajectory.position_extrema[0]
        return cls(motion.angle_rad, trajectory, motion.angle_rad + furthest.min, motion.angle_rad + furthest.max)

    def after(self, dt_s: float) -> Motion:
        """Where it has led to; what is left of it is the brake from there."""
        (way,), (velocity,), (acceleration,) = self.trajectory.at_time(dt_s)
        if dt_s >= self.trajectory.duration:
            return Motion(self.start_rad + way)
        return Motion(self.start_rad + way, velocity, acceleration)
