"""The CAN bus: opened through python-can, read by a thread of its own, written from the loop."""

from __future__ import annotations

import logging
import struct
import threading
import time
from collections.abc import Callable
from typing import Any, Final

import can
from canopen import Network, ObjectDictionary
from canopen.sdo.client import SdoClient

from fusion.errors import MachineError
from server.exoskeleton import Cia402Settings
from server.station.exo.cia402.pdo import EMERGENCY_ID, HEARTBEAT_ID, SYNC_ID

NMT_START, NMT_PRE_OPERATIONAL = 0x01, 0x80
OPERATIONAL, PRE_OPERATIONAL, BOOTED = 5, 127, 0
"""States in a heartbeat."""
EMERGENCY: Final = struct.Struct("<HB5s")
SDO_WITHIN_S = 1.0
_LISTEN_S, _PAUSE_S = 0.05, 0.005
_SILENT_S = 0.1

Received = Callable[[bytes], None]
"""Told of a message's bytes, in the reading thread: quick, and never raising."""


class Bus:
    """An open CAN bus. A message that cannot be sent is `trouble`, not an error: the tick goes on.

    Args:
        settings: how python-can reaches it.

    Raises:
        MachineError: python-can cannot open it.
    """

    def __init__(self, settings: Cia402Settings) -> None:
        self._settings = settings
        self._network = Network(_opened(settings))
        self._reader = threading.Thread(target=self._read, name="canopen reader", daemon=True)
        self._closing = threading.Event()
        self.trouble = ""
        """Why the bus does not work, in plain words; "" = it does."""
        self.syncs = 0
        """SYNC messages sent."""

    def listen(self, identifier: int, received: Received) -> None:
        """Ask to be told of a message; before `start`."""
        self._network.subscribe(identifier, lambda _id, data, _t: received(bytes(data)))

    def sdo(self, node: int) -> SdoClient:
        """A node's parameter channel; before `start`."""
        dictionary = ObjectDictionary()  # type: ignore[no-untyped-call]  # canopen annotates no constructor
        client = SdoClient(0x600 + node, 0x580 + node, dictionary)  # type: ignore[no-untyped-call]  # as above
        client.network = self._network
        client.RESPONSE_TIMEOUT = SDO_WITHIN_S
        self._network.subscribe(client.tx_cobid, client.on_response)
        return client

    def start(self) -> None:
        """Begin to read."""
        self._reader.start()

    def close(self) -> None:
        """Stop reading and close the bus."""
        self._closing.set()
        if self._reader.is_alive():
            self._reader.join()
        self._network.disconnect()

    def send(self, identifier: int, data: bytes) -> None:
        """Give one message to the interface."""
        try:
            self._network.send_message(identifier, data)
        except (can.CanError, OSError) as error:
            self.trouble = f"The CAN bus '{self.name}' takes no messages: {error}"

    def sync(self) -> None:
        """Let every node take over its set-point and measure."""
        self.syncs += 1
        self.send(SYNC_ID, b"")

    def command(self, order: int, node: int) -> None:
        """A network-management order to a node."""
        self.send(0, bytes((order, node)))

    def beat(self) -> None:
        """The station's own heartbeat. Without it the drives stop by themselves (SR-3)."""
        self.send(HEARTBEAT_ID + self._settings.own_node, bytes((OPERATIONAL,)))

    @property
    def name(self) -> str:
        """For people."""
        return f"{self._settings.interface} {self._settings.channel}".strip()

    def _read(self) -> None:
        """Read until closed. A bus that has died may return at once for ever, so silence is waited out."""
        heard_s = time.monotonic()
        bus = self._network.bus
        while bus is not None and not self._closing.is_set():
            message = self._received(bus, _LISTEN_S if time.monotonic() - heard_s < _SILENT_S else 0.0)
            if message is None:
                time.sleep(_PAUSE_S)
                continue
            heard_s = time.monotonic()
            if not (message.is_error_frame or message.is_remote_frame):
                self._network.notify(message.arbitration_id, message.data, message.timestamp)

    def _received(self, bus: can.BusABC, within_s: float) -> can.Message | None:
        try:
            return bus.recv(within_s)
        except (can.CanError, OSError) as error:
            self.trouble = f"The CAN bus '{self.name}' cannot be read: {error}"
            return None


def emergency_of(data: bytes) -> int:
    """Error code of an emergency message; 0 = the drive takes back what it said."""
    code: int = EMERGENCY.unpack(data[: EMERGENCY.size].ljust(EMERGENCY.size, b"\0"))[0]
    return code


def emergency_id(node: int) -> int:
    """Identifier of a node's emergency messages."""
    return EMERGENCY_ID + node


def _opened(settings: Cia402Settings) -> can.BusABC:
    logging.getLogger("can").setLevel(logging.ERROR)  # socketcand warns of every message that comes in two parts
    expected = "an interface of python-can that is up, as in cia402.interface, cia402.channel and cia402.options"
    options: dict[str, Any] = dict(settings.options)
    if settings.interface == "socketcand":
        options.setdefault("tcp_tune", True)  # without it TCP holds small messages back, which made motion 40 ms late
    try:
        return can.Bus(interface=settings.interface, channel=settings.channel, bitrate=settings.bitrate, **options)
    except (can.CanError, OSError, ValueError, TypeError, ImportError) as error:
        name = f"{settings.interface} {settings.channel}".strip() or "(cia402.interface is empty)"
        raise MachineError(f"The CAN bus '{name}' cannot be opened: {error}", expected, "docs/cia402.md") from None
