"""A drive in a process of its own, as a real one has a controller of its own: what the station says to it, and hears.

Unix datagrams, one each way per tick. A station that is killed or frozen takes nothing of the drive with it, so what
the drive does then can be measured.
"""

from __future__ import annotations

import os
import select
import socket
import time
from dataclasses import replace
from pathlib import Path
from types import TracebackType
from typing import Final, Self

import msgspec

from fusion.errors import MachineError
from server.exoskeleton import Exoskeleton
from server.messages import JointLimits
from server.station.exo.driver import WATCHDOG_S, ZERO, DriveCommand, DriveReading

ADDRESS: Final = "MIRRORLIMB_RIG_DRIVE"
"""Environment variable: the Unix socket that the drive's process reads."""
ANSWER_WITHIN_S: Final = 5.0
LONGEST_BYTES: Final = 65_536


class Commanded(msgspec.Struct, frozen=True, tag="command"):
    """A tick's command."""

    command: DriveCommand


class Fitted(msgspec.Struct, frozen=True, tag="fit"):
    """An arm was put in."""

    limits: tuple[JointLimits, ...]


class Greeted(msgspec.Struct, frozen=True, tag="hello"):
    """Asks for a reading."""


Said = Commanded | Fitted | Greeted

said_from = msgspec.msgpack.Decoder(Said).decode
reading_from = msgspec.msgpack.Decoder(DriveReading).decode
encoded = msgspec.msgpack.Encoder().encode


class RemoteDrive:
    """The station's end; obeys the contract of every drive and never blocks.

    Args:
        exoskeleton: what the drive's process was made from too.
        address: Unix socket of that process; by default the environment names it.
    """

    name = "simulated"
    can_comply = True

    def __init__(self, exoskeleton: Exoskeleton, address: str = "") -> None:
        self._address = address or os.environ[ADDRESS]
        self._socket = socket.socket(socket.AF_UNIX, socket.SOCK_DGRAM)
        self._reading = DriveReading(0.0, ZERO, ZERO, ZERO, "The drive has not answered yet.")
        self._heard_s = float("-inf")

    def __enter__(self) -> Self:
        """Open it.

        Raises:
            MachineError: the drive's process does not answer.
        """
        Path(f"{self._address}.station").unlink(missing_ok=True)
        self._socket.bind(f"{self._address}.station")
        self._socket.setblocking(False)
        self._say(Greeted())
        if not select.select([self._socket], [], [], ANSWER_WITHIN_S)[0]:
            raise MachineError(f"The drive at {self._address} does not answer", "a running drive process")
        self._listen(time.monotonic())
        return self

    def __exit__(
        self, kind: type[BaseException] | None, error: BaseException | None, trace: TracebackType | None
    ) -> None:
        self._socket.close()

    def fit(self, limits: tuple[JointLimits, ...]) -> None:
        """An arm is put in."""
        self._say(Fitted(limits))

    def reset(self) -> None:
        """Its faults end with their causes; there is nothing to leave."""

    def command(self, command: DriveCommand, now_s: float) -> None:
        """Give the tick's command."""
        self._say(Commanded(command))

    def read(self, now_s: float) -> DriveReading:
        """The newest measurement; a drive that has been silent for its watchdog's time is at fault."""
        self._listen(now_s)
        if now_s - self._heard_s > WATCHDOG_S:
            return replace(self._reading, velocity_rad_s=ZERO, fault="The drive is silent.")
        return self._reading

    def _listen(self, now_s: float) -> None:
        while (answer := self._answer()) is not None:
            self._reading, self._heard_s = reading_from(answer), now_s

    def _answer(self) -> bytes | None:
        try:
            return self._socket.recv(LONGEST_BYTES)
        except OSError:
            return None

    def _say(self, what: Said) -> None:
        try:
            self._socket.sendto(encoded(what), self._address)
        except OSError:
            return  # a drive that does not listen is found by its silence
