"""The simulated exoskeleton: four joints with inertia, gravity, friction, limited torque, and a drive's regulator."""

from __future__ import annotations

from dataclasses import dataclass
from math import tanh
from types import TracebackType
from typing import Self

from server.exoskeleton import Exoskeleton, device_limits
from server.messages import JointLimits
from server.station.exo.arm_load import ArmLoad
from server.station.exo.driver import WATCHDOG_S, ZERO, DriveCommand, DriveMode, DriveReading, Joints

SUBSTEP_S = 0.002
RAMP_RAD_S2 = 10.0
"""Deceleration of the drive's own watchdog."""
LONGEST_CATCH_UP_S = 0.5
"""A simulation that was not asked for longer skips ahead; nothing in it moves on its own by then."""
INTERPOLATED_S = 0.015
"""The drive carries a set-point on at its velocity for so long, as cyclic position drives interpolate."""
KNOWN_LOAD = 0.9
"""Share of the true gravity that the drive's model knows: people are not all alike."""
AT_REST: Joints = (0.9, 0.4, 0.2, 1.0)
"""Where a seated patient's arm lies in it."""


@dataclass(frozen=True, slots=True)
class JointPlant:
    """One joint's mechanics and its regulator."""

    inertia_kg_m2: float
    viscous_nm_s: float
    coulomb_nm: float
    torque_nm: float
    """Largest torque of the motor."""
    natural_rad_s: float = 45.0
    """Of the position loop; the damping ratio is 1."""


PLANTS = (
    JointPlant(0.30, 0.4, 0.4, 40.0),
    JointPlant(0.45, 0.5, 0.5, 60.0),
    JointPlant(0.06, 0.1, 0.2, 15.0),
    JointPlant(0.12, 0.15, 0.2, 20.0),
)


class SimulatedDrive:
    """A drive of equal standing with a real one: it is commanded, measured and watched in the same way.

    Args:
        exoskeleton: the ends of its joints are mechanical stops.
        load: the arm it carries.
    """

    name = "simulated"
    can_comply = False

    def __init__(self, exoskeleton: Exoskeleton, load: ArmLoad | None = None) -> None:
        self._stops = tuple((limits.min_rad, limits.max_rad) for limits in device_limits(exoskeleton))
        self._load = load or ArmLoad()
        self._angle, self._velocity, self._torque = AT_REST, ZERO, ZERO
        self._command = DriveCommand(DriveMode.HOLD, AT_REST, ZERO, "not commanded yet")
        self._commanded_s: float | None = None
        self._now_s: float | None = None

    def __enter__(self) -> Self:
        return self

    def __exit__(
        self, kind: type[BaseException] | None, error: BaseException | None, trace: TracebackType | None
    ) -> None:
        self._hold(self._angle)

    def fit(self, limits: tuple[JointLimits, ...]) -> None:
        """Somebody puts the arm in, at rest as a seated patient's lies, and at least a tenth inside its range."""
        inside = []
        for angle, joint in zip(AT_REST, limits, strict=True):
            inset = 0.1 * (joint.max_rad - joint.min_rad)
            inside.append(min(max(angle, joint.min_rad + inset), joint.max_rad - inset))
        self._angle, self._velocity = tuple(inside), ZERO
        self._hold(self._angle)

    def command(self, command: DriveCommand, now_s: float) -> None:
        """Take over a command."""
        self._advance(now_s)
        self._command, self._commanded_s = command, now_s

    def read(self, now_s: float) -> DriveReading:
        """Integrate up to now and measure."""
        self._advance(now_s)
        return DriveReading(now_s, self._angle, self._velocity, self._torque)

    def _hold(self, angle: Joints) -> None:
        self._command = DriveCommand(DriveMode.HOLD, angle, ZERO, "held by the drive")

    def _advance(self, now_s: float) -> None:
        start_s = now_s if self._now_s is None else max(self._now_s, now_s - LONGEST_CATCH_UP_S)
        for step in range(int((now_s - start_s) / SUBSTEP_S + 1e-6)):
            self._substep(start_s + (step + 1) * SUBSTEP_S)
            self._now_s = start_s + (step + 1) * SUBSTEP_S
        if self._now_s is None or self._now_s < now_s - SUBSTEP_S:
            self._now_s = now_s

    def _substep(self, t_s: float) -> None:
        self._watch(t_s)
        carried_s = min(t_s - (self._commanded_s or t_s), INTERPOLATED_S)
        gravity = self._load.gravity_nm(self._angle)
        moved = [self._joint(i, gravity[i], carried_s) for i in range(len(PLANTS))]
        self._angle, self._velocity, self._torque = (tuple(part) for part in zip(*moved, strict=True))

    def _joint(self, i: int, gravity_nm: float, carried_s: float) -> tuple[float, float, float]:
        """One joint's semi-implicit Euler step: J q̈ = τ + gravity − b q̇ − c tanh(q̇ / 0.02)."""
        plant, angle, velocity = PLANTS[i], self._angle[i], self._velocity[i]
        wanted_rad_s = self._command.velocity_rad_s[i]
        error_rad = self._command.angle_rad[i] + wanted_rad_s * carried_s - angle
        stiffness, damping = plant.inertia_kg_m2 * plant.natural_rad_s**2, 2 * plant.inertia_kg_m2 * plant.natural_rad_s
        torque = stiffness * error_rad + damping * (wanted_rad_s - velocity) - KNOWN_LOAD * gravity_nm
        torque = min(max(torque, -plant.torque_nm), plant.torque_nm)
        friction = plant.viscous_nm_s * velocity + plant.coulomb_nm * tanh(velocity / 0.02)
        velocity += (torque + gravity_nm - friction) / plant.inertia_kg_m2 * SUBSTEP_S
        angle += velocity * SUBSTEP_S
        low, high = self._stops[i]
        if low <= angle <= high:
            return angle, velocity, torque
        return min(max(angle, low), high), 0.0, torque

    def _watch(self, t_s: float) -> None:
        """The drive's own watchdog (SR-3): without commands the set-point comes to rest at a steady deceleration."""
        if self._commanded_s is None or t_s - self._commanded_s <= WATCHDOG_S or not any(self._command.velocity_rad_s):
            return
        slower = tuple(_towards_zero(v, RAMP_RAD_S2 * SUBSTEP_S) for v in self._command.velocity_rad_s)
        moved = tuple(
            angle + v * SUBSTEP_S
            for angle, v in zip(self._command.angle_rad, self._command.velocity_rad_s, strict=True)
        )
        self._command = DriveCommand(DriveMode.HOLD, moved, slower, "the drive's watchdog: no command came")


def _towards_zero(value: float, step: float) -> float:
    return max(0.0, value - step) if value > 0 else min(0.0, value + step)
