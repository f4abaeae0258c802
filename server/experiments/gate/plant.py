"""Four joints that are quick to simulate: inertia, friction, a weight that is not quite known, a drive's regulator.

The arm of `server.station.exo.simulated` is far truer and slower; here a million ticks are wanted. There are no end
stops: what would leave its range does so.
"""

from __future__ import annotations

from math import sin, tanh
from typing import Final

import numpy as np

from fusion.compiled import kernel
from fusion.messages import Floats
from server.station.exo.driver import WATCHDOG_S, ZERO, DriveCommand, DriveReading, Joints

SUBSTEP_S: Final = 0.001
CARRIED_S: Final = 0.02
"""For so long after a command its set-point is carried on at its velocity."""

INERTIA: Final = np.array([0.30, 0.45, 0.10, 0.15])
"""kg m², as felt at the joint."""
STIFF: Final = 2000.0 * INERTIA
"""N m/rad of the position drive; natural frequency 45 rad/s, damped critically."""
SOFT: Final = np.array([60.0, 60.0, 20.0, 30.0])
"""N m/rad of the impedance at its full share."""
MOTOR_NM: Final = np.array([40.0, 60.0, 15.0, 20.0])
UNKNOWN_WEIGHT_NM: Final = np.array([0.2, 1.0, 0.1, 0.4])
"""What the drive does not know of the arm's weight, at most."""
COULOMB_NM, VISCOUS_NM_S, FULL_AT_RAD_S = 0.4, 0.4, 0.02
"""Friction, fully developed from a few times the last."""


class QuickArm:
    """The four joints.

    Args:
        angle_rad: where they rest at first.
    """

    def __init__(self, angle_rad: Joints) -> None:
        self._moving = np.array([angle_rad, ZERO, ZERO])  # angle, velocity, torque
        self._command = np.array([angle_rad, ZERO, (1.0,) * 4, (np.inf,) * 4])  # angle, velocity, share, bound
        self.push_nm: Joints = ZERO
        """By which the arm's owner acts on each joint."""
        self.was_pushed = False
        self._unheard_s = 0.0

    def take(self, command: DriveCommand) -> None:
        """A new command."""
        self._unheard_s = 0.0
        self._command[:] = (command.angle_rad, command.velocity_rad_s, command.share, command.torque_nm)

    def live(self, seconds: float) -> None:
        """Go on for so long."""
        self.was_pushed = self.was_pushed or any(self.push_nm)
        advance(self._moving, self._command, np.array(self.push_nm), self._unheard_s, seconds)
        self._unheard_s += seconds

    @property
    def angle_rad(self) -> Joints:
        """Where the joints truly are."""
        return tuple(self._moving[0].tolist())

    def read(self, now_s: float) -> DriveReading:
        """What is measured."""
        angle, velocity, torque = map(tuple, self._moving.tolist())
        return DriveReading(now_s, angle, velocity, torque, interaction_nm=self.push_nm)


@kernel
def advance(moving: Floats, command: Floats, push_nm: Floats, unheard_s: float, seconds: float) -> None:
    """Semi-implicit Euler steps of J q̈ = clip(K e + D ė, ± bound) + unknown weight + push − friction.

    Args:
        moving: (3, 4) angle, velocity and torque, changed in place.
        command: (4, 4) angle, velocity, share and torque bound.
        push_nm: (4,).
        unheard_s: since the last command; after `WATCHDOG_S` the drive holds by itself (SR-3).
        seconds: how long.
    """
    for step in range(int(seconds / SUBSTEP_S + 0.5)):
        before_s = unheard_s + step * SUBSTEP_S
        carried_s = min(before_s + SUBSTEP_S, CARRIED_S)
        if before_s <= WATCHDOG_S < before_s + SUBSTEP_S:
            command[0], command[1], command[2] = moving[0], 0.0, 1.0
        for i in range(4):
            q, v, share = moving[0, i], moving[1, i], command[2, i]
            stiffness = STIFF[i] if share >= 1.0 else share * SOFT[i]
            damping = 2.0 * (stiffness * INERTIA[i]) ** 0.5
            error = command[0, i] + command[1, i] * carried_s - q
            torque = stiffness * error + damping * (command[1, i] - v)
            most = min(command[3, i], MOTOR_NM[i])
            torque = min(max(torque, -most), most)
            friction = COULOMB_NM * tanh(v / FULL_AT_RAD_S) + VISCOUS_NM_S * v
            v += (torque + push_nm[i] - UNKNOWN_WEIGHT_NM[i] * sin(q) - friction) / INERTIA[i] * SUBSTEP_S
            moving[0, i], moving[1, i], moving[2, i] = q + v * SUBSTEP_S, v, torque
