"""Emulated drives for a whole exoskeleton: made, kept running, disturbed at run time, and logged."""

from __future__ import annotations

import time
from collections.abc import Callable
from contextlib import ExitStack
from pathlib import Path
from typing import Any, Final

import can

from fusion.errors import InputError, MachineError
from server.emulated.cia402.bridge import LOOPBACK, SocketcandBus
from server.emulated.cia402.control import Control, Journal
from server.emulated.cia402.node import EmulatedNode
from server.exoskeleton import Cia402Settings, Exoskeleton
from server.station.exo.joint_map import JointMap

LISTEN_S = 0.002
SEATED_RAD: Final = (0.9, 0.4, 0.2, 1.0)
"""Where a seated patient's arm lies in the device (`EXO_JOINTS`)."""


class Emulator:
    """An exoskeleton's drives on one bus.

    Args:
        exoskeleton: its joints; each has a node.
        bus: an open bus; the caller closes it.
    """

    def __init__(self, exoskeleton: Exoskeleton, bus: can.BusABC) -> None:
        self._bus = bus
        seated = JointMap(exoskeleton).joints_rad(SEATED_RAD).tolist()
        self.nodes = {
            joint.name: EmulatedNode(joint, self, min(max(angle, joint.min_rad), joint.max_rad))
            for joint, angle in zip(exoskeleton.joints, seated, strict=True)
        }

    def send_message(self, can_id: int, data: bytes) -> None:
        """A node's message; a bus that takes none is as one that nobody hears."""
        try:
            self._bus.send(can.Message(arbitration_id=can_id, data=data, is_extended_id=False))
        except (can.CanError, OSError):
            return

    def cycle(self) -> None:
        """Hear what is on the bus, for a moment at most, and let every drive move on to now."""
        end_s = time.monotonic() + LISTEN_S
        while (left_s := end_s - time.monotonic()) > 0 and (message := self._bus.recv(left_s)):
            for node in self.nodes.values():
                node.hear(message.arbitration_id, bytes(message.data), time.monotonic())
        for node in self.nodes.values():
            node.advance(time.monotonic())


def serve(
    exoskeleton: Exoskeleton,
    bus: can.BusABC,
    goes_on: Callable[[], bool],
    control: Path | None = None,
    journal: Path | None = None,
) -> None:
    """Emulate until told to end.

    Args:
        exoskeleton: whose drives.
        bus: an open bus.
        goes_on: asked in every cycle.
        control: path of a datagram socket that takes one order per datagram (`control.obey`).
        journal: CSV file of every joint's true movement (`control.Journal`).
    """
    emulator = Emulator(exoskeleton, bus)
    with ExitStack() as stack:
        orders = stack.enter_context(Control(control)) if control else None
        written = stack.enter_context(Journal(journal)) if journal else None
        while goes_on():
            emulator.cycle()
            if orders is not None:
                orders.obey_all(emulator.nodes)
            if written is not None:
                written.note(emulator.nodes, time.monotonic())


def open_bus(settings: Cia402Settings) -> can.BusABC:
    """The emulation's end of the file's bus; for "socketcand" it is the server that the station connects to.

    Raises:
        InputError: the file names no bus, or one that is not on this machine.
        MachineError: the bus cannot be opened.
    """
    options: dict[str, Any] = dict(settings.options)
    try:
        if settings.interface != "socketcand":
            return can.Bus(interface=settings.interface, channel=settings.channel, bitrate=settings.bitrate, **options)
        if options.get("host") != LOOPBACK:
            raise InputError("cia402.options.host is not this machine", f'"{LOOPBACK}", for emulated drives')
        return SocketcandBus(int(options.get("port", 0)))
    except (can.CanError, OSError, ValueError, TypeError, ImportError) as error:
        name = f"{settings.interface} {settings.channel}".strip()
        raise MachineError(f"The CAN bus '{name}' cannot be opened: {error}", "a bus that is free") from None
