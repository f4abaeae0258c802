"""What the simulated exoskeleton is made of, link by link and gear by gear (docs/simulated-arm.md has the sources)."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Final

from server.exoskeleton import Exoskeleton, Follows

Vector = tuple[float, float, float]
"""In limb coordinates (outward, up, back) of a hanging arm, m."""

CHAIN: Final = (Follows.PLANE, Follows.ELEVATION, Follows.AXIAL_ROTATION, Follows.ELBOW, *(Follows.NONE,) * 3)
"""What the joints follow, from the shoulder on; the last three are forearm, wrist flexion and wrist deviation."""
UPPER_ARM_M: Final = 0.29
FOREARM_M: Final = 0.25
"""Between the shell's axes; an adult's of 1.75 m as a Kinect sees one (fusion.virtual_patient.anatomy)."""


@dataclass(frozen=True, slots=True)
class Link:
    """A link and the joint that carries it."""

    axis: Vector
    """Of the joint; a positive turn makes its anatomical angle grow."""
    place_m: Vector
    """Of the joint, seen from the one above."""
    mass_kg: float
    centre_m: Vector
    """Of mass, seen from the joint."""
    inertia_kg_m2: float
    """About each axis through the centre."""


@dataclass(frozen=True, slots=True)
class Gear:
    """Motor and gear of one joint, as felt at the joint."""

    rotor_kg_m2: float
    """The rotor's inertia times the squared ratio."""
    coulomb_nm: float
    viscous_nm_s: float
    stiffness_nm_rad: float
    play_rad: float
    """Backlash: the joint turns so far before the gear feels it."""

    @property
    def damping_nm_s(self) -> float:
        """Of the wound-up gear."""
        return 0.002 * self.stiffness_nm_rad


@dataclass(frozen=True, slots=True)
class Servo:
    """What the drive's regulator uses."""

    stiffness_nm_rad: float
    """As a position drive."""
    damping_nm_s: float
    soft_nm_rad: float
    """As an impedance with all of its help."""
    soft_nm_s: float


SIDEWAYS, UP, BACK = (1.0, 0.0, 0.0), (0.0, 1.0, 0.0), (0.0, 0.0, 1.0)
HERE: Final = (0.0, 0.0, 0.0)

LINKS: Final = (
    Link(UP, HERE, 2.5, (0.0, 0.05, 0.10), 0.020),
    Link(BACK, HERE, 2.0, (0.05, -0.05, 0.0), 0.010),
    Link(UP, HERE, 1.8, (0.04, -0.18, 0.0), 0.008),
    Link(SIDEWAYS, (0.0, -UPPER_ARM_M, 0.0), 1.2, (0.04, -0.06, 0.0), 0.004),
    Link(UP, HERE, 0.8, (0.03, -0.18, 0.0), 0.002),
    Link(SIDEWAYS, (0.0, -FOREARM_M, 0.0), 0.3, (0.02, -0.03, 0.0), 0.0004),
    Link(BACK, HERE, 0.3, (0.0, -0.07, 0.0), 0.0004),
)
GEARS: Final = (
    Gear(0.25, 2.0, 1.0, 12_000.0, 0.0009),
    Gear(0.25, 2.0, 1.0, 12_000.0, 0.0009),
    Gear(0.08, 1.0, 0.4, 5_000.0, 0.0012),
    Gear(0.10, 1.0, 0.4, 5_000.0, 0.0012),
    Gear(0.02, 0.3, 0.08, 1_500.0, 0.0020),
    Gear(0.01, 0.2, 0.04, 800.0, 0.0020),
    Gear(0.01, 0.2, 0.04, 800.0, 0.0020),
)
SERVOS: Final = (
    Servo(1900.0, 60.0, 60.0, 6.0),
    Servo(2100.0, 68.0, 60.0, 6.0),
    Servo(400.0, 13.0, 20.0, 1.5),
    Servo(550.0, 17.0, 30.0, 2.5),
    Servo(75.0, 2.4, 8.0, 0.5),
    Servo(40.0, 1.3, 5.0, 0.3),
    Servo(40.0, 1.3, 5.0, 0.3),
)


def is_such_an_arm(exoskeleton: Exoskeleton) -> bool:
    """Whether an exoskeleton file describes this chain of joints."""
    return tuple(joint.follows for joint in exoskeleton.joints) == CHAIN
