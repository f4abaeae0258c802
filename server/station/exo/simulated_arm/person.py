"""The arm in the exoskeleton: its segments, how it is held, and what its muscles do (docs/simulated-arm.md)."""

from __future__ import annotations

from collections import deque
from collections.abc import Callable
from dataclasses import dataclass, replace
from typing import Final

from server.station.exo.driver import Joints
from server.station.exo.simulated_arm.mechanics import FOREARM_M, UPPER_ARM_M

Effort = Callable[[float, Joints], Joints]
"""Time in s and the arm's own angles (4,) → torque of the muscles about each, N m: about the vertical, about the
elevation's axis, about the humerus, about the elbow."""


@dataclass(frozen=True, slots=True)
class Segment:
    """A part of the arm, hanging; moments about the axes outward, up, back through its centre."""

    length_m: float
    mass_kg: float
    centre_m: float
    """Below the joint above."""
    inertia_kg_m2: tuple[float, float, float]


@dataclass(frozen=True, slots=True)
class Cuff:
    """How a segment is held in its shell, at a distance below the joint above. 0 = not held."""

    below_m: float
    across_n_m: float = 0.0
    along_n_m: float = 0.0
    turn_nm_rad: float = 0.0
    """About the segment's long axis."""
    tilt_nm_rad: float = 0.0
    """About the other two."""


UPPER_CUFF: Final = Cuff(below_m=0.17, across_n_m=4500.0, along_n_m=2100.0, turn_nm_rad=1.7)
FOREARM_CUFF: Final = Cuff(below_m=0.20, across_n_m=4500.0, along_n_m=2100.0)
HANDLE: Final = Cuff(below_m=0.06, turn_nm_rad=10.0, tilt_nm_rad=10.0)
CUFF_DAMPING_S: Final = 0.01
"""Damping over stiffness of every cuff."""


@dataclass(frozen=True, slots=True)
class HumanArm:
    """An arm after de Leva (1996), men: shares of the body's mass, centres and radii of gyration."""

    body_kg: float = 73.0
    """Of the whole person."""
    lengths_m: tuple[float, float, float] = (UPPER_ARM_M, FOREARM_M, 0.086)
    """Upper arm, forearm, hand to its third knuckle; the shells are set to the arm, as therapists do."""
    shoulder_m: tuple[float, float, float] = (0.007, 0.0, 0.007)
    """Where the shoulder's centre lies, seen from where the exoskeleton's axes meet: nobody sits quite right."""
    shoulder_nm_rad: float = 0.3
    """Passive stiffness towards the hanging arm."""
    shoulder_nm_s: float = 0.5
    elbow_nm_rad: float = 0.5
    """Towards `elbow_rest_rad`."""
    elbow_nm_s: float = 0.2
    elbow_rest_rad: float = 1.0
    wrist_nm_rad: float = 0.3
    """Of forearm and wrist."""
    wrist_nm_s: float = 0.03

    @property
    def segments(self) -> tuple[Segment, Segment, Segment]:
        """Upper arm, forearm, hand."""
        upper_m, fore_m, hand_m = self.lengths_m
        return (
            self._segment(upper_m, 0.0271, 0.5772, (0.269, 0.158, 0.285)),
            self._segment(fore_m, 0.0162, 0.4574, (0.265, 0.121, 0.276)),
            self._segment(hand_m, 0.0061, 0.7900, (0.513, 0.401, 0.628)),
        )

    def believed(self, share: float) -> HumanArm:
        """The same arm for somebody who knows only a share of its mass."""
        return replace(self, body_kg=share * self.body_kg)

    def _segment(self, length_m: float, heavy: float, centre: float, gyration: tuple[float, float, float]) -> Segment:
        mass_kg = heavy * self.body_kg
        x, y, z = (mass_kg * (share * length_m) ** 2 for share in gyration)
        return Segment(length_m, mass_kg, centre * length_m, (x, y, z))


@dataclass(frozen=True, slots=True)
class Spasticity:
    """A catch of the elbow's flexors: a quick stretch beyond an angle is answered by a pull that lasts."""

    beyond_rad: float = 1.4
    """Straighter than this flexion."""
    stretch_rad_s: float = 0.7
    """Slower stretches are not answered."""
    gain_nm_s: float = 12.0
    """Pull for each rad/s more."""
    most_nm: float = 15.0
    latency_s: float = 0.04
    release_s: float = 0.5
    """Time constant with which it fades."""


class Muscles:
    """What the arm's owner does, willing or not.

    Args:
        effort: torque that is wanted.
        spasticity: of the elbow's flexors; None = they are calm.
        dt_s: time between two calls of `torque_nm`.
    """

    def __init__(self, effort: Effort | None, spasticity: Spasticity | None, dt_s: float) -> None:
        self._effort, self._spasticity, self._dt_s = effort, spasticity, dt_s
        waiting = round(spasticity.latency_s / dt_s) if spasticity else 0
        self._pulls = deque([0.0] * waiting)
        self._pull_nm = 0.0

    @property
    def are_passive(self) -> bool:
        """Whether nothing is ever done."""
        return self._effort is None and self._spasticity is None

    def torque_nm(self, t_s: float, angle_rad: Joints, elbow_rad_s: float) -> Joints:
        """(4,) N m about each angle, with the arm's own angles and its elbow's velocity."""
        wanted = self._effort(t_s, angle_rad) if self._effort else (0.0, 0.0, 0.0, 0.0)
        if self._spasticity is None:
            return wanted
        return (*wanted[:3], wanted[3] + self._caught_nm(self._spasticity, angle_rad[3], elbow_rad_s))

    def _caught_nm(self, spasticity: Spasticity, flexion_rad: float, flexing_rad_s: float) -> float:
        """The reflex: its pull comes after the latency, rises at once, and fades slowly."""
        too_fast_rad_s = -flexing_rad_s - spasticity.stretch_rad_s
        answers = flexion_rad < spasticity.beyond_rad and too_fast_rad_s > 0
        self._pulls.append(min(spasticity.gain_nm_s * too_fast_rad_s, spasticity.most_nm) if answers else 0.0)
        fading = self._pull_nm * (1.0 - self._dt_s / spasticity.release_s)
        self._pull_nm = max(self._pulls.popleft(), fading)
        return self._pull_nm
