"""The safety gate in closed loop with simulated joints, a tick at a time, by a clock that is only counted."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, field
from typing import Final

from fusion.skeleton import Side
from server.config import GateConfig
from server.experiments.gate.plant import QuickArm
from server.messages import Assistance, DriveState, JointLimits, OpenSession, Wish
from server.station.exo import safety
from server.station.exo.driver import ZERO, DriveCommand, DriveMode, DriveReading, Joints
from server.station.exo.evidence import Device, SafetyInputs
from server.station.exo.gate import GateState
from server.station.exo.limiter import Box
from server.station.exo.mapping import JointTarget
from server.station.exo.patient_range import boxes
from server.station.exo.safety_state import SafetyState

TICK_S: Final = 0.01
CONFIG: Final = GateConfig()
IN_CHARGE: Final = "therapist"


def unspoilt(reading: DriveReading) -> DriveReading:
    """As it is measured."""
    return reading


@dataclass(frozen=True, slots=True)
class Scene:
    """What a tick finds besides the target; all is well by default."""

    evidence_age_s: float = 0.0
    service_age_s: float = 0.0
    authority: str = IN_CHARGE
    interrupted: str = ""
    spoilt: Callable[[DriveReading], DriveReading] = unspoilt
    """What becomes of the measurement on its way."""
    obeyed: bool = True
    """The drive takes the command."""


GOOD: Final = Scene()


@dataclass(slots=True)
class GateRig:
    """The gate, what it saw, and the joints behind it."""

    limits: tuple[JointLimits, ...]
    device: Device
    arm: QuickArm
    state: SafetyState = field(default_factory=lambda: SafetyState(GateState(DriveState.READY, "", 0.0, True)))
    t_s: float = 0.0
    boxes: tuple[Box, ...] = ()
    before: SafetyState = field(default_factory=SafetyState)
    """As it was before the last tick."""
    inputs: SafetyInputs = field(default_factory=lambda: SafetyInputs(DriveReading(0.0, *(ZERO,) * 3), None, 0.0, 0.0))
    command: DriveCommand = field(default_factory=lambda: DriveCommand(DriveMode.HOLD, ZERO, ZERO, ""))

    def __post_init__(self) -> None:
        self.boxes = boxes(self.limits, CONFIG)
        self.state = safety.put_in(self.state, self.arm.read(0.0), 0.0)

    @property
    def now(self) -> DriveState:
        """The gate's state."""
        return self.state.gate.state

    def tick(
        self,
        target: JointTarget | None,
        seconds: float = TICK_S,
        scene: Scene = GOOD,
    ) -> None:
        """One tick.

        Args:
            target: what is to be followed.
            seconds: since the last tick.
            scene: what else is so in it.
        """
        self.arm.live(seconds)
        self.t_s += seconds
        self.inputs = SafetyInputs(
            scene.spoilt(self.arm.read(self.t_s)),
            target,
            scene.evidence_age_s,
            scene.service_age_s,
            self.limits,
            self.boxes,
            scene.interrupted,
            authority=scene.authority,
            device=self.device,
        )
        self.before = self.state
        self.state, self.command = safety.step(self.state, self.inputs, CONFIG, self.t_s)
        if scene.obeyed:
            self.arm.take(self.command)

    def wish(self, wanted: Wish) -> bool:
        """Whether a wish was granted."""
        self.state, refusal = safety.wish(self.state, wanted, self.t_s)
        return not refusal


def opening(mode: Assistance = Assistance.PASSIVE, level: float = 1.0) -> OpenSession:
    """The wish to open a session."""
    return OpenSession(
        number=1,
        session="1",
        patient="P",
        healthy_side=Side.LEFT,
        side_confirmed=True,
        limits=(),
        limits_set_by=IN_CHARGE,
        recording="",
        assistance=mode,
        level=level,
    )


def middle(limits: tuple[JointLimits, ...]) -> Joints:
    """The middle of each joint's range."""
    return tuple((joint.min_rad + joint.max_rad) / 2 for joint in limits)
