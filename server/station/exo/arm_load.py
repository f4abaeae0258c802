"""What gravity asks of the simulated exoskeleton's joints when it carries an arm."""

from __future__ import annotations

from dataclasses import dataclass
from math import cos, sin

from server.station.exo.driver import Joints

GRAVITY_M_S2 = 9.81


@dataclass(frozen=True, slots=True)
class ArmLoad:
    """An arm with its shell. Masses in kg, lengths in m; the centres are measured from the joint above."""

    upper_arm_kg: float = 2.6
    upper_arm_m: float = 0.30
    upper_arm_centre_m: float = 0.14
    forearm_kg: float = 2.0
    forearm_centre_m: float = 0.16

    def gravity_nm(self, angle_rad: Joints) -> Joints:
        """Torque of gravity about each joint, N m.

        With p, e, t, f for plane, elevation, rotation and elbow flexion, the upper arm's centre is at height −cos e
        and the forearm's direction has the height −cos f cos e + sin f sin e sin(p − t); the torque is minus the
        derivative of the potential energy.
        """
        p, e, t, f = angle_rad
        upper = GRAVITY_M_S2 * (self.upper_arm_kg * self.upper_arm_centre_m + self.forearm_kg * self.upper_arm_m)
        fore = GRAVITY_M_S2 * self.forearm_kg * self.forearm_centre_m
        ahead = sin(p - t)
        turning = fore * sin(f) * sin(e) * cos(p - t)
        return (
            -turning,
            -upper * sin(e) - fore * (cos(f) * sin(e) + sin(f) * cos(e) * ahead),
            turning,
            -fore * (sin(f) * cos(e) + cos(f) * sin(e) * ahead),
        )
