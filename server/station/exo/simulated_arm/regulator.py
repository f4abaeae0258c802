"""The drive's regulator: a command becomes a set-point that is carried on, and that the motors' torque."""

from __future__ import annotations

from typing import Final

import numpy as np

from fusion.messages import Floats
from server.exoskeleton import Exoskeleton
from server.station.exo.driver import DriveCommand, DriveMode
from server.station.exo.joint_map import JointMap
from server.station.exo.simulated_arm.engine import Belief, Scene
from server.station.exo.simulated_arm.law import (
    ACCELERATION,
    ANGLE,
    BOUND,
    DAMPING,
    FILTER_S,
    INERTIA,
    PLACE,
    SHARE,
    STIFFNESS,
    TORQUE,
    VELOCITY,
    WEIGHT,
    carry_on,
    friction_nm,
    torques,
)
from server.station.exo.simulated_arm.mechanics import GEARS, SERVOS
from server.station.exo.simulated_arm.mjcf import STEP_S

BELIEF_STEPS: Final = 5
"""The load is worked out anew every so many steps."""
LONGEST_PERIOD_S: Final = 0.03
"""Two commands further apart say nothing about acceleration."""


class Regulator:
    """One drive's.

    Args:
        exoskeleton: its joints' ends, velocities and torques are the drive's own limits.
        to: from anatomical angles to its joints.
        belief: what the drive believes of the load.
    """

    def __init__(self, exoskeleton: Exoskeleton, to: JointMap, belief: Belief) -> None:
        joints = exoskeleton.joints
        self._to, self._belief = to, belief
        self._joints = np.array(
            [
                [joint.min_rad for joint in joints],
                [joint.max_rad for joint in joints],
                [joint.velocity_rad_s for joint in joints],
                [joint.torque_nm for joint in joints],
                [gear.coulomb_nm for gear in GEARS],
                [gear.viscous_nm_s for gear in GEARS],
            ]
        )
        self._quickest = np.array([joint.acceleration_rad_s2 for joint in joints])
        count = len(joints)
        self._still = np.zeros(count)
        self._wanted, self._gains = np.zeros((4, count)), np.zeros((4, count))
        self._measured, self._load, self._smooth = np.zeros((2, count)), np.zeros((2, count)), np.zeros((3, count))
        self._last = self._still
        self._commanded_s = float("-inf")
        self._steps = 0
        self._warm_up()

    def begin(self, joints_rad: Floats) -> None:
        """Hold (n,) from rest; nothing of before counts."""
        self._smooth[:] = 0.0
        self._smooth[ANGLE] = joints_rad
        self._smooth[TORQUE] = self._belief.torque_nm(joints_rad, self._still, self._still)
        self._commanded_s = float("-inf")
        self._steps = 0
        self.hold(joints_rad)

    def hold(self, joints_rad: Floats) -> None:
        """Stay at (n,), as stiffly as the drive can."""
        self._wanted[ANGLE] = self._wanted[PLACE] = joints_rad
        self._wanted[VELOCITY] = self._wanted[ACCELERATION] = 0.0
        self._be_as_stiff_as(np.ones(len(joints_rad)), np.full(len(joints_rad), np.inf))

    def take(self, command: DriveCommand, now_s: float) -> None:
        """A new command; two in a row tell the acceleration between them."""
        velocity = self._to.joints_rad_s(command.velocity_rad_s)
        period_s = now_s - self._commanded_s
        goes_on = command.mode is DriveMode.FOLLOW and 0.0 < period_s <= LONGEST_PERIOD_S
        quickening = (velocity - self._last) / period_s if goes_on else self._still
        self._wanted[ACCELERATION] = np.clip(quickening, -self._quickest, self._quickest)
        self._wanted[ANGLE], self._wanted[VELOCITY] = self._to.joints_rad(command.angle_rad), velocity
        self._last, self._commanded_s = velocity, now_s
        self._be_as_stiff_as(self._to.spread(command.share, 1.0), self._to.spread(command.torque_nm, np.inf))

    def torque_nm(self, t_s: float, scene: Scene) -> Floats:
        """(n,) for the step that ends at `t_s`."""
        carry_on(self._wanted, self._joints, t_s - self._commanded_s, STEP_S)
        self._measured[ANGLE], self._measured[VELOCITY] = scene.rotor_rad, scene.rotor_rad_s
        if self._steps % BELIEF_STEPS == 0:
            self._believe()
        self._steps += 1
        return torques(self._measured, self._wanted, self._gains, self._joints, self._load, self._smooth, STEP_S)

    def interaction_nm(self, scene: Scene) -> Floats:
        """(n,) what the arm adds to what was expected of it, smoothed over `FILTER_S`; + towards larger angles.

        Expected torque of the smoothed movement, and friction, less the smoothed torque that was given.
        """
        angle, velocity, torque = self._smooth
        acceleration = (scene.rotor_rad_s - velocity) / FILTER_S
        rubbing = [friction_nm(v, gear.coulomb_nm, gear.viscous_nm_s) for v, gear in zip(velocity, GEARS, strict=True)]
        unexpected: Floats = self._belief.torque_nm(angle, velocity, acceleration) + rubbing - torque
        return unexpected

    def _warm_up(self) -> None:
        """Compile the law, or load what was compiled, before the first tick needs it."""
        carry_on(self._wanted, self._joints, 0.0, STEP_S)
        torques(self._measured, self._wanted, self._gains, self._joints, self._load, self._smooth, STEP_S)

    def _believe(self) -> None:
        joints = self._measured[ANGLE]
        weight = self._belief.torque_nm(joints, self._still, self._still)
        moving = self._belief.torque_nm(joints, self._wanted[VELOCITY], self._wanted[ACCELERATION])
        self._load[WEIGHT], self._load[INERTIA] = weight, moving - weight

    def _be_as_stiff_as(self, share: Floats, bound_nm: Floats) -> None:
        """Position control where the share is 1; else an impedance with the share of its stiffness, damped alike."""
        stiff = share >= 1.0
        self._gains[STIFFNESS] = np.where(stiff, _STIFF[0], share * _SOFT[0])
        self._gains[DAMPING] = np.where(stiff, _STIFF[1], np.sqrt(share) * _SOFT[1])
        self._gains[BOUND], self._gains[SHARE] = bound_nm, share


_STIFF: Final = np.array([[s.stiffness_nm_rad for s in SERVOS], [s.damping_nm_s for s in SERVOS]])
_SOFT: Final = np.array([[s.soft_nm_rad for s in SERVOS], [s.soft_nm_s for s in SERVOS]])
