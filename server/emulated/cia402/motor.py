"""A joint's motor behind its gear: inertia, friction, a weight that pulls, a regulator, a holding brake."""

from __future__ import annotations

from dataclasses import dataclass
from math import copysign, inf

INERTIA_KG_M2, FRICTION_NM_S = 0.15, 0.4
NATURAL_RAD_S = 80.0
"""Of the position loop; its damping ratio is 1."""
ARRIVED_RAD = 1e-9


@dataclass(slots=True)
class Limits:
    """What the drive keeps by itself."""

    min_rad: float = -inf
    max_rad: float = inf
    velocity_rad_s: float = inf
    torque_nm: float = inf


@dataclass(slots=True)
class Motor:
    """One joint, in its own angle."""

    angle_rad: float
    load_nm: float = 0.0
    """What gravity asks of it; the regulator knows it, as one with an integral part does."""
    velocity_rad_s: float = 0.0
    torque_nm: float = 0.0
    reference_rad: float = 0.0
    reference_rad_s: float = 0.0
    goal_rad: float = 0.0
    blocked: bool = False

    def stand(self) -> None:
        """From here on the reference is where the joint is."""
        self.reference_rad = self.goal_rad = self.angle_rad
        self.reference_rad_s = 0.0

    def head_for(self, goal_rad: float, over_s: float, limits: Limits) -> bool:
        """Interpolate to a new set-point; True = a limit changed it."""
        inside = min(max(goal_rad, limits.min_rad), limits.max_rad)
        wanted_rad_s = (inside - self.reference_rad) / over_s
        self.goal_rad = inside
        self.reference_rad_s = copysign(min(abs(wanted_rad_s), limits.velocity_rad_s), wanted_rad_s)
        return inside != goal_rad or self.reference_rad_s != wanted_rad_s

    def brake(self, deceleration_rad_s2: float, dt_s: float) -> None:
        """One step of the quick stop's ramp, on the reference."""
        slower = max(abs(self.reference_rad_s) - deceleration_rad_s2 * dt_s, 0.0)
        self.reference_rad_s = copysign(slower, self.reference_rad_s)
        self.reference_rad += self.reference_rad_s * dt_s
        self.goal_rad = self.reference_rad

    def interpolate(self, dt_s: float) -> None:
        """One step of the reference on its way to the goal, never past it."""
        left_rad = self.goal_rad - self.reference_rad
        step_rad = self.reference_rad_s * dt_s
        if abs(left_rad) < ARRIVED_RAD:
            self.reference_rad_s = 0.0
        elif abs(step_rad) >= abs(left_rad) or step_rad * left_rad < 0:
            self.reference_rad = self.goal_rad
        else:
            self.reference_rad += step_rad

    def drive(self, limits: Limits, dt_s: float) -> None:
        """One step under power: J q'' = tau + load - b q', semi-implicit Euler."""
        error_rad, error_rad_s = self.reference_rad - self.angle_rad, self.reference_rad_s - self.velocity_rad_s
        wanted_nm = INERTIA_KG_M2 * NATURAL_RAD_S * (NATURAL_RAD_S * error_rad + 2 * error_rad_s) - self.load_nm
        self.torque_nm = min(max(wanted_nm, -limits.torque_nm), limits.torque_nm)
        push_nm = self.torque_nm + self.load_nm - FRICTION_NM_S * self.velocity_rad_s
        self.velocity_rad_s = 0.0 if self.blocked else self.velocity_rad_s + push_nm / INERTIA_KG_M2 * dt_s
        self.angle_rad += self.velocity_rad_s * dt_s

    def rest_on_brake(self) -> None:
        """Without power the holding brake carries the load."""
        self.velocity_rad_s = self.torque_nm = 0.0
        self.stand()
