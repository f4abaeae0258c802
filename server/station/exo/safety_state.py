"""Everything that the safety gate remembers from one tick to the next."""

from __future__ import annotations

from dataclasses import dataclass, field
from math import inf

from server.messages import EXO_JOINTS
from server.station.exo.assistance import Help
from server.station.exo.driver import ONE, ZERO, Joints
from server.station.exo.gate import Facts, GateState
from server.station.exo.limiter import Motion


@dataclass(frozen=True, slots=True)
class SafetyState:
    """Everything the gate remembers."""

    gate: GateState = field(default_factory=GateState)
    motions: tuple[Motion, ...] = (Motion(0.0),) * len(EXO_JOINTS)
    """The set-points."""
    following: bool = False
    """The last tick followed the target."""
    blend: float = 0.0
    """0..1 of the blend-in (SR-6)."""
    blend_over_s: float = inf
    """How long the blend-in takes."""
    blend_from: Joints = ZERO
    thaw: Joints = ZERO
    """0..1 per joint: a joint that was held comes back as slowly as a blend-in."""
    frozen_s: float = 0.0
    """How long the swing has been held by uncertainty."""
    help: Help = field(default_factory=Help)
    strained_s: Joints = ZERO
    """For how long each joint has been resisting (SR-18)."""
    astray_s: Joints = ZERO
    """For how long each joint has been far from its set-point (SR-2)."""
    seen_rad: Joints | None = None
    """Where the joints were measured last."""
    yielded_at: Joints | None = None
    """Where the arm was measured when a compliant hold began, and is held; None in every other state."""
    facts: Facts = field(default_factory=Facts)
    """Of the last tick; what a person saw who wishes now."""
    speed: Joints = ONE
    """0..1 per joint: what uncertainty and age leave of its speed (SR-4)."""
    last_s: float | None = None

    @property
    def at_rest(self) -> bool:
        """Whether every set-point stands still."""
        return not any(motion.velocity_rad_s for motion in self.motions)

    @property
    def angle_rad(self) -> Joints:
        """The set-points' angles."""
        return tuple(motion.angle_rad for motion in self.motions)

    @property
    def velocity_rad_s(self) -> Joints:
        """The set-points' velocities."""
        return tuple(motion.velocity_rad_s for motion in self.motions)
