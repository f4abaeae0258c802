"""What every exoskeleton is to the station: open it, give it a command each tick, read what it measures."""

from __future__ import annotations

from dataclasses import dataclass
from enum import StrEnum
from math import inf
from types import TracebackType
from typing import Protocol, Self

from server.messages import EXO_JOINTS, JointLimits

JOINT_COUNT = len(EXO_JOINTS)
WATCHDOG_S = 0.1
"""A drive that gets no command for longer ramps to a hold by itself (SR-3)."""

Joints = tuple[float, ...]
"""One number per joint of `EXO_JOINTS`."""
ZERO: Joints = (0.0,) * JOINT_COUNT
ONE: Joints = (1.0,) * JOINT_COUNT
UNBOUND: Joints = (inf,) * JOINT_COUNT


class DriveMode(StrEnum):
    """What the drive is to do with a command."""

    HOLD = "hold"
    """Stay at `angle_rad`, powered: never fall under gravity (SR-7); with a `share` below 1, softly."""
    FOLLOW = "follow"
    """Follow `angle_rad`, moving at `velocity_rad_s`."""


@dataclass(frozen=True, slots=True)
class DriveCommand:
    """One tick's command, after every limit."""

    mode: DriveMode
    angle_rad: Joints
    velocity_rad_s: Joints
    reason: str
    """Why the drive holds, in plain words; "" when it follows freely."""
    clamped: tuple[str, ...] = ()
    """What the limits changed."""
    share: Joints = ONE
    """0..1 of the drive's stiffness per joint: 1 = position control; below, an impedance about `angle_rad`; 0 = only
    the arm's weight is carried."""
    torque_nm: Joints = UNBOUND
    """The most that each joint may use beyond carrying the arm."""


@dataclass(frozen=True, slots=True)
class DriveReading:
    """What the drive measures."""

    t_s: float
    angle_rad: Joints
    velocity_rad_s: Joints
    torque_nm: Joints
    fault: str = ""
    """What is wrong with the drive, in plain words."""
    interaction_nm: Joints = ZERO
    """What the arm adds to the weight and inertia that were expected of it; + pushes towards larger angles."""


class Drive(Protocol):
    """A drive family: a context manager that opens and closes the device; nothing in it may block."""

    name: str
    can_comply: bool
    """Whether it obeys `DriveCommand.share` below 1."""

    def __enter__(self) -> Self:
        """Open the device.

        Raises:
            fusion.errors.MachineError: it is not there or refuses.
        """
        ...

    def __exit__(
        self, kind: type[BaseException] | None, error: BaseException | None, trace: TracebackType | None
    ) -> None:
        """Leave the device holding, and close it."""
        ...

    def fit(self, limits: tuple[JointLimits, ...]) -> None:
        """A patient's arm is put in, by hand, inside these limits; the device is told its range."""
        ...

    def reset(self) -> None:
        """A person asks to leave a fault (SR-5): the drive comes back holding where it stands, if its cause is gone."""
        ...

    def command(self, command: DriveCommand, now_s: float) -> None:
        """Give the tick's command."""
        ...

    def read(self, now_s: float) -> DriveReading:
        """The newest measurement."""
        ...
