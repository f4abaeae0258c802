"""Calms a joint target: what a depth camera sees of an arm trembles and wanders, and an exoskeleton must not.

A second-order low-pass per joint, as quick as what it sees is steady: the lag is short where the sensors are good, and
grows only where following their noise would shake the arm more than its acceleration limit can follow.
docs/decisions/calm-targets.md has what was measured.
"""

from __future__ import annotations

from dataclasses import dataclass, replace
from math import sqrt
from typing import Final, Self

from server.station.exo.mapping import JointTarget

DAMPING: Final = 0.8
LEAD: Final = 0.25
"""Share of the low-pass's own lag that is led by its velocity."""
NOISE_RAD_S: Final = 0.4
"""Pace at which noise may move the set-point: the low-pass's natural frequency times the noise's size."""
QUICKNESS_1_S: Final = (6.0, 40.0)
"""Least and largest natural frequency: the lag on a steady movement is 2 ζ (1 − LEAD) over it, 30 to 200 ms."""
SPAN_S: Final = 0.1
"""Noise is what three angles so far apart lack to a straight line; a reach bends by no more than 0.04 rad in it."""
LARGEST_BEND_RAD: Final = 1.0
"""A jump counts no more than this."""
LEARNT_SHARE: Final = 0.05
"""Of one such look: a memory of two seconds. The first looks count more."""
EXPECTED_RAD: Final = 0.08
"""Noise of sensors that are not known yet; counts as two looks."""


@dataclass(frozen=True, slots=True)
class Noise:
    """How much one joint's target trembles, learnt once a span."""

    before_rad: float
    earlier_rad: float
    """What was seen one span ago and two."""
    variance_rad2: float = EXPECTED_RAD**2
    looks: int = 2

    def after(self, seen_rad: float) -> Noise:
        """One span on."""
        bend = min(abs(seen_rad - 2 * self.before_rad + self.earlier_rad), LARGEST_BEND_RAD)
        share = max(LEARNT_SHARE, 1.0 / (self.looks + 1))
        variance = self.variance_rad2 + share * (bend * bend / 6 - self.variance_rad2)
        return Noise(seen_rad, self.before_rad, variance, self.looks + 1)

    @property
    def quickness_1_s(self) -> float:
        """Natural frequency at which this noise moves the set-point no faster than it may."""
        least, largest = QUICKNESS_1_S
        return min(max(NOISE_RAD_S / sqrt(max(self.variance_rad2, 1e-12)), least), largest)


@dataclass(frozen=True, slots=True)
class CalmJoint:
    """One joint's low-pass."""

    angle_rad: float
    velocity_rad_s: float
    quickness_1_s: float
    noise: Noise

    @classmethod
    def at(cls, seen_rad: float) -> Self:
        """At rest where it is first seen."""
        noise = Noise(seen_rad, seen_rad)
        return cls(seen_rad, 0.0, noise.quickness_1_s, noise)

    def after(self, seen_rad: float, dt_s: float) -> CalmJoint:
        """One tick on: c'' = ω² (seen − c) − 2 ζ ω c', stepped implicitly, so that no tick is too long for it."""
        pace = self.quickness_1_s * dt_s
        push = self.quickness_1_s * pace * (seen_rad - self.angle_rad)
        velocity = (self.velocity_rad_s + push) / (1 + 2 * DAMPING * pace + pace * pace)
        return CalmJoint(self.angle_rad + velocity * dt_s, velocity, self.quickness_1_s, self.noise)

    def judged(self, seen_rad: float) -> CalmJoint:
        """As quick as the noise allows from now on."""
        noise = self.noise.after(seen_rad)
        return CalmJoint(self.angle_rad, self.velocity_rad_s, noise.quickness_1_s, noise)

    @property
    def led_rad(self) -> float:
        """The angle, led by a part of the lag."""
        return self.angle_rad + LEAD * 2 * DAMPING / self.quickness_1_s * self.velocity_rad_s


@dataclass(frozen=True, slots=True)
class Calm:
    """What is remembered of the target; () before the first."""

    joints: tuple[CalmJoint, ...] = ()
    waited_s: float = 0.0
    """Since noise was last judged."""


def calmed(before: Calm, target: JointTarget | None, dt_s: float) -> tuple[Calm, JointTarget | None]:
    """The target after the low-pass; a lost target forgets everything.

    Args:
        before: what is remembered so far.
        target: the new target.
        dt_s: since the last one.
    """
    if target is None:
        return Calm(), None
    if not before.joints:
        return Calm(tuple(map(CalmJoint.at, target.angle_rad))), target
    joints = tuple(joint.after(seen, dt_s) for joint, seen in zip(before.joints, target.angle_rad, strict=True))
    waited_s = before.waited_s + dt_s
    if waited_s >= SPAN_S:
        joints = tuple(joint.judged(seen) for joint, seen in zip(joints, target.angle_rad, strict=True))
        waited_s -= SPAN_S
    angles, velocities = tuple(joint.led_rad for joint in joints), tuple(joint.velocity_rad_s for joint in joints)
    return Calm(joints, waited_s), replace(target, angle_rad=angles, velocity_rad_s=velocities)
