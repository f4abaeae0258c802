"""One joint's units: radians and newton metres at the joint against counts and per mille at its motor.

counts = q · N / (2 pi) · n, per mille = 1000 · tau / (n · tau_rated), with N the gear ratio and n the counts per turn
of the motor's encoder. The gear's losses are not known, so torques are the motor's times the ratio.
"""

from __future__ import annotations

from dataclasses import dataclass
from math import pi

from server.exoskeleton import ExoskeletonJoint


@dataclass(frozen=True, slots=True)
class Units:
    """One joint's conversions."""

    counts_per_rad: float
    turns_per_rad: float
    """Of the motor."""
    rated_nm: float
    """Rated torque at the joint."""

    @classmethod
    def of(cls, joint: ExoskeletonJoint, rated_motor_nm: float) -> Units:
        """Of a joint whose motor has this rated torque."""
        turns = joint.gear_ratio / (2 * pi)
        return cls(turns * joint.counts_per_turn, turns, rated_motor_nm * joint.gear_ratio)

    def counts(self, angle_rad: float) -> int:
        """An angle, speed or acceleration of the joint in counts."""
        return round(angle_rad * self.counts_per_rad)

    def rad(self, counts: int) -> float:
        """Counts as an angle or speed of the joint."""
        return counts / self.counts_per_rad

    def rpm(self, velocity_rad_s: float) -> int:
        """The motor's speed, turns a minute."""
        return round(velocity_rad_s * self.turns_per_rad * 60)

    def per_mille(self, torque_nm: float) -> int:
        """A torque of the joint in thousandths of the motor's rated torque."""
        return round(1000 * torque_nm / self.rated_nm)

    def nm(self, per_mille: int) -> float:
        """Thousandths of the rated torque as a torque of the joint."""
        return per_mille * self.rated_nm / 1000
