"""One drive as the station sees it: the newest of everything it sent, kept by the reading thread."""

from __future__ import annotations

import time
from collections.abc import Callable
from dataclasses import dataclass, replace

from server.exoskeleton import ExoskeletonJoint
from server.station.exo.cia402.bus import BOOTED, Bus, emergency_id, emergency_of
from server.station.exo.cia402.pdo import DETAILS, HEARTBEAT_ID, MEASURED, SET_POINT
from server.station.exo.cia402.states import State, state_of

MEASURED_FORM, DETAILS_FORM, SET_POINT_FORM = MEASURED.form, DETAILS.form, SET_POINT.form


@dataclass(frozen=True, slots=True)
class Measured:
    """What came with the newest SYNC that was answered."""

    statusword: int = 0
    position: int = 0
    """Counts."""
    torque: int = 0
    """Thousandths of the rated torque."""


@dataclass(frozen=True, slots=True)
class Details:
    """The second message's content."""

    velocity: int = 0
    """Counts/s."""
    mode: int = 0
    error: int = 0


class Link:
    """One drive's place on the bus. Made before the bus is read.

    Args:
        joint: the joint it moves.
        bus: the bus.
        clock: monotonic.
    """

    def __init__(self, joint: ExoskeletonJoint, bus: Bus, clock: Callable[[], float] = time.monotonic) -> None:
        self.joint, self._bus, self._clock = joint, bus, clock
        self.measured, self.details = Measured(), Details()
        self.answered = 0
        """The number of SYNCs sent when it last answered one."""
        self.heard_s = float("-inf")
        """When its last heartbeat came."""
        self.network_state = BOOTED
        self.emergency = 0
        """Error code of its newest emergency message, kept until a person's reset."""
        bus.listen(MEASURED.first_id + joint.node, self._on_measured)
        bus.listen(DETAILS.first_id + joint.node, self._on_details)
        bus.listen(HEARTBEAT_ID + joint.node, self._on_heartbeat)
        bus.listen(emergency_id(joint.node), self._on_emergency)

    @property
    def state(self) -> State:
        """Its state in CiA 402."""
        return state_of(self.measured.statusword)

    @property
    def error(self) -> int:
        """The error that it names, 0 = none."""
        return self.emergency or self.details.error

    @property
    def unanswered(self) -> int:
        """SYNCs sent since it last answered one."""
        return self._bus.syncs - self.answered

    def forgive(self) -> None:
        """Forget its error, and its state until it says it again: a drive that is gone was in operation last."""
        self.emergency, self.measured = 0, replace(self.measured, statusword=0)

    def send(self, control: int, position: int, torque: int) -> None:
        """Give it a set-point for the next SYNC."""
        self._bus.send(SET_POINT.first_id + self.joint.node, SET_POINT_FORM.pack(control, position, torque))

    def _on_measured(self, data: bytes) -> None:
        if len(data) == MEASURED_FORM.size:
            self.measured = Measured(*MEASURED_FORM.unpack(data))
            self.answered = self._bus.syncs

    def _on_details(self, data: bytes) -> None:
        if len(data) == DETAILS_FORM.size:
            self.details = Details(*DETAILS_FORM.unpack(data))

    def _on_heartbeat(self, data: bytes) -> None:
        if data:
            self.heard_s, self.network_state = self._clock(), data[0] & 0x7F

    def _on_emergency(self, data: bytes) -> None:
        self.emergency = emergency_of(data) or self.emergency
