"""`python -m server.experiments.rig.drive_process`: the simulated drive with a process and a clock of its own.

It goes on when its station is killed or frozen, as a real drive's controller does, and writes down what came and how
the arm moved.
"""

from __future__ import annotations

import argparse
import os
import select
import socket
import sys
import time
from collections.abc import Sequence
from contextlib import suppress
from pathlib import Path
from typing import Final

import msgspec

from server.exoskeleton import BUILT_IN
from server.experiments.rig.drive_link import LONGEST_BYTES, Commanded, Fitted, encoded, said_from
from server.experiments.rig.drive_log import Note
from server.station import pacemaker
from server.station.exo.driver import Drive, DriveCommand
from server.station.exo.drives import make_drive

STEP_S: Final = 0.002
NOTED_EVERY_S: Final = 0.004
_line = msgspec.json.Encoder().encode


class DriveController:
    """A drive, its link and its log.

    Args:
        drive: open.
        address: Unix socket to read.
        log: file to write.
    """

    def __init__(self, drive: Drive, address: str, log: Path) -> None:
        self._drive, self._address = drive, address
        self._socket = socket.socket(socket.AF_UNIX, socket.SOCK_DGRAM)
        self._socket.bind(address)
        self._socket.setblocking(False)
        # Unbuffered: what stands in it has happened, whoever is killed next.
        self._log = log.open("ab", buffering=0)
        self._command: DriveCommand | None = None
        self._command_s: float | None = None
        self._noted_s = 0.0

    def run(self, parent: int) -> None:
        """Until the process that started it has gone."""
        while os.getppid() == parent:
            select.select([self._socket], [], [], STEP_S)
            self._hear()
            now_s = time.monotonic()
            if now_s - self._noted_s >= NOTED_EVERY_S:
                self._note(now_s, is_command=False)

    def _hear(self) -> None:
        with suppress(BlockingIOError):
            while True:
                message = self._socket.recv(LONGEST_BYTES)
                self._take(message, time.monotonic())

    def _take(self, message: bytes, now_s: float) -> None:
        said = said_from(message)
        if isinstance(said, Fitted):
            self._drive.fit(said.limits)
        if isinstance(said, Commanded):
            self._drive.command(said.command, now_s)
            self._command, self._command_s = said.command, now_s
            self._note(now_s, is_command=True)
        with suppress(OSError):  # a station that has gone does not listen
            self._socket.sendto(encoded(self._drive.read(now_s)), f"{self._address}.station")

    def _note(self, now_s: float, *, is_command: bool) -> None:
        reading, command = self._drive.read(now_s), self._command
        note = Note(
            now_s,
            self._command_s,
            is_command,
            command.mode if command else None,
            command.reason if command else "",
            reading.angle_rad,
            reading.velocity_rad_s,
        )
        self._log.write(_line(note) + b"\n")
        self._noted_s = now_s


def main(arguments: Sequence[str] | None = None) -> int:
    """Run it; ends with the process that started it."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--address", required=True, help="Unix socket")
    parser.add_argument("--log", type=Path, required=True, help="file to write")
    options = parser.parse_args(arguments)
    with make_drive(BUILT_IN) as drive:
        controller = DriveController(drive, options.address, options.log)
        pacemaker.settle()
        pacemaker.ask_for_priority()  # a controller of its own is not held up by what the computer does
        controller.run(os.getppid())
    return 0


if __name__ == "__main__":
    sys.exit(main())
