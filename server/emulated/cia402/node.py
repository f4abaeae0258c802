"""An emulated drive's place on the bus: parameters, process data, heartbeats both ways, emergency messages."""

from __future__ import annotations

from collections import deque
from dataclasses import dataclass
from typing import Final, Protocol

from canopen.sdo.exceptions import SdoAbortedError
from canopen.sdo.server import SdoServer

from server.emulated.cia402.drive import EmulatedDrive
from server.emulated.cia402.store import ERROR_COUNT, Store, shipped
from server.exoskeleton import ExoskeletonJoint
from server.station.exo.cia402 import objects, pdo
from server.station.exo.cia402.bus import (
    BOOTED,
    EMERGENCY,
    NMT_PRE_OPERATIONAL,
    NMT_START,
    OPERATIONAL,
    PRE_OPERATIONAL,
    emergency_id,
)
from server.station.exo.cia402.faults import HEARTBEAT_LOST
from server.station.exo.cia402.objects import Entry
from server.station.exo.cia402.states import State

_LIMITS: Final = (objects.MIN_POSITION, objects.MAX_POSITION)
_VALUE_REFUSED = 0x06090030
_ORDERS: Final = {NMT_START: OPERATIONAL, NMT_PRE_OPERATIONAL: PRE_OPERATIONAL}
_GENERIC_ERROR = 1


class Wire(Protocol):
    """What a node sends through."""

    def send_message(self, can_id: int, data: bytes) -> None:
        """Put one message on the bus."""
        ...


@dataclass(slots=True)
class Disturbance:
    """What is wrong with a node; everything can change while it runs."""

    silent: bool = False
    """It says nothing and hears nothing; its motor goes on as it was told last."""
    no_heartbeat: bool = False
    no_measurement: bool = False
    lie_rad: float = 0.0
    """Added to the position that it tells."""
    lag_s: float = 0.0
    """Its set-points are this old."""
    false_limits: bool = False
    """Its limits read back otherwise than they were written."""
    refuse_limits: bool = False


class EmulatedNode:
    """One node.

    Args:
        joint: the joint it moves.
        wire: the bus.
        start_rad: where the joint stands when its power comes.
    """

    def __init__(self, joint: ExoskeletonJoint, wire: Wire, start_rad: float) -> None:
        self.joint, self.wrong = joint, Disturbance()
        self._wire = wire
        self._store = Store(shipped(joint.counts_per_turn), self._told, self._written)
        self.drive = EmulatedDrive(joint, self._store.values, start_rad, self._complain)
        self._sdo = SdoServer(0x600 + joint.node, 0x580 + joint.node, self._store)  # type: ignore[no-untyped-call]  # canopen annotates no constructor
        self._sdo.network = self  # type: ignore[assignment]  # of a network it uses send_message only
        self._network_state = PRE_OPERATIONAL
        self._now_s = self._beat_s = float("-inf")
        self._station_s: float | None = None
        self._set_point: tuple[int, int, int] | None = None
        self._late: deque[tuple[float, tuple[int, int, int]]] = deque()
        self.send_message(pdo.HEARTBEAT_ID + joint.node, bytes((BOOTED,)))

    # ---------------------------------------------------------------- what people ask of it

    def restart(self) -> None:
        """Lose power and get it back: what was written is gone, and the brake holds."""
        self._store.values.update(shipped(self.joint.counts_per_turn))
        self.drive.state, self._network_state, self._station_s = State.DISABLED, PRE_OPERATIONAL, None
        self.send_message(pdo.HEARTBEAT_ID + self.joint.node, bytes((BOOTED,)))

    def place(self, angle_rad: float) -> None:
        """Somebody moves the joint by hand."""
        self.drive.motor.angle_rad = angle_rad
        self.drive.motor.stand()

    # ---------------------------------------------------------------- time

    def advance(self, now_s: float) -> None:
        """Move on to now: the motor, and the heartbeats both ways."""
        self.drive.advance(max(now_s - self._now_s, 0.0) if self._now_s > float("-inf") else 0.0, now_s)
        self._now_s = now_s
        self._watch_station(now_s)
        every_s = self._store.values[objects.PRODUCER_HEARTBEAT] / 1000
        if every_s and now_s - self._beat_s >= every_s and not self.wrong.no_heartbeat:
            self._beat_s = now_s
            self.send_message(pdo.HEARTBEAT_ID + self.joint.node, bytes((self._network_state,)))

    def _watch_station(self, now_s: float) -> None:
        """Consumer heartbeat, from the first one heard; 6007h says quick stop (SR-3)."""
        within_s = (self._store.values[objects.CONSUMER_HEARTBEAT] & 0xFFFF) / 1000
        if within_s and self._station_s is not None and now_s - self._station_s > within_s:
            self._station_s = None
            self.drive.quick_stop()
            self._complain(HEARTBEAT_LOST)

    # ---------------------------------------------------------------- what it hears

    def hear(self, identifier: int, data: bytes, now_s: float) -> None:
        """A message on the bus."""
        if self.wrong.silent:
            return
        node = self.joint.node
        if identifier == pdo.SYNC_ID:
            self._on_sync(now_s)
        elif identifier == pdo.SET_POINT.first_id + node and len(data) == pdo.SET_POINT.form.size:
            self._set_point = pdo.SET_POINT.form.unpack(data)
        elif identifier == 0x600 + node:
            self._sdo.on_request(identifier, bytearray(data), now_s)  # type: ignore[no-untyped-call]  # canopen's
        else:
            self._hear_management(identifier, data, now_s)

    def _hear_management(self, identifier: int, data: bytes, now_s: float) -> None:
        station = self._store.values[objects.CONSUMER_HEARTBEAT] >> 16
        if identifier == pdo.HEARTBEAT_ID + station:
            self._station_s = now_s
        elif identifier == 0 and len(data) == 2 and data[1] in (0, self.joint.node):
            self._network_state = _ORDERS.get(data[0], self._network_state)

    def _on_sync(self, now_s: float) -> None:
        """Take over the newest set-point, and measure."""
        if self._network_state != OPERATIONAL:
            return
        self.drive.advance(now_s - self._now_s, now_s)
        self._now_s = now_s
        if self._set_point is not None:
            self._late.append((now_s, self._set_point))
            self._set_point = None
        while self._late and now_s - self._late[0][0] >= self.wrong.lag_s:
            self._take(*self._late.popleft()[1])
        if not self.wrong.no_measurement:
            self._tell(pdo.MEASURED)
            self._tell(pdo.DETAILS)

    def _take(self, control: int, target: int, max_torque: int) -> None:
        values = self._store.values
        values[objects.MAX_TORQUE] = max_torque
        over_s = values[objects.INTERPOLATION_TIME] * 10.0 ** values[objects.INTERPOLATION_EXPONENT]
        self.drive.obey(control)
        self.drive.head_for(target, over_s)

    # ---------------------------------------------------------------- what it says

    def send_message(self, can_id: int, data: bytes) -> None:
        """Put one message on the bus, unless it is silent."""
        if not self.wrong.silent:
            self._wire.send_message(can_id, bytes(data))

    def _tell(self, message: pdo.Pdo) -> None:
        values = [self._value(entry) for entry in message.entries]
        self.send_message(message.first_id + self.joint.node, message.form.pack(*values))

    def _value(self, entry: Entry) -> int:
        told = self._told(entry)
        return self._store.values[entry] if told is None else told

    def _told(self, entry: Entry) -> int | None:
        """What differs from what is stored."""
        if entry == objects.POSITION:
            return self.drive.shown[entry] + self.drive.counts(self.wrong.lie_rad)
        if entry in _LIMITS and self.wrong.false_limits:
            return self._store.values[entry] + self.drive.counts(0.1)
        return self.drive.shown.get(entry)

    def _written(self, entry: Entry, value: int) -> None:
        if entry in _LIMITS and self.wrong.refuse_limits:
            raise SdoAbortedError(_VALUE_REFUSED)
        if entry == objects.CONTROLWORD:
            self.drive.obey(value)
        elif entry == objects.CONSUMER_HEARTBEAT:
            self._station_s = None

    def _complain(self, code: int) -> None:
        values = self._store.values
        values[objects.ERROR_CODE], values[objects.ERROR_REGISTER] = code, _GENERIC_ERROR
        values[objects.LAST_ERROR], values[ERROR_COUNT] = code, 1
        message = EMERGENCY.pack(code, _GENERIC_ERROR, b"")
        self.send_message(emergency_id(self.joint.node), message)
