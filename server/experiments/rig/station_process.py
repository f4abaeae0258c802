"""`python -m server.experiments.rig.station_process --config FILE`: the station, unchanged but for its drive and clock.

The drive is the one of `drive_process`. The wall clock is the machine's plus a step that somebody outside may set: what
Python reads of it and what the kernel stamps datagrams with are stepped alike, and the machine's own clock is left
alone.
"""

from __future__ import annotations

import os
import socket
import sys
import time
from mmap import PAGESIZE, mmap
from pathlib import Path
from struct import Struct
from typing import Any, Final

from server.experiments.rig.inside import Watch
from server.station import pacemaker
from server.station.__main__ import main as run_station
from server.station.exo.drives import DRIVES
from server.station.sources.udp import SO_TIMESTAMPNS

STEP_FILE: Final = "MIRRORLIMB_RIG_CLOCK"
"""Environment variable: the file that holds the step."""
INSIDE_FILE: Final = "MIRRORLIMB_RIG_INSIDE"
"""Environment variable: the file for what is counted inside."""
NS_PER_S: Final = 1_000_000_000
_STEP: Final = Struct("@qq")  # ns of the step, ns of the true wall clock from which on it holds
_STAMP: Final = Struct("@qq")  # the kernel's timespec
_true_ns = time.time_ns


class SteppedClock:
    """A wall clock that somebody else may step.

    Args:
        path: a file that both sides map.
    """

    def __init__(self, path: Path) -> None:
        if not path.exists():
            path.write_bytes(bytes(PAGESIZE))
        with path.open("r+b") as file:
            self._shared = mmap(file.fileno(), PAGESIZE)

    def step(self, seconds: float) -> None:
        """From now on the clock is wrong by so much."""
        _STEP.pack_into(self._shared, 0, round(seconds * NS_PER_S), _true_ns())

    def shown_ns(self, true_ns: int) -> int:
        """What the clock shows, or showed, at a true instant."""
        step_ns, since_ns = _STEP.unpack_from(self._shared, 0)
        return true_ns + (step_ns if true_ns >= since_ns else 0)


def live_by(clock: SteppedClock) -> None:
    """Make this process read the wall clock from `clock`."""

    class SteppedSocket(socket.socket):
        def recvmsg(self, *sizes: int) -> Any:
            payload, ancillary, flags, sender = super().recvmsg(*sizes)
            return payload, [_stepped(clock, *entry) for entry in ancillary], flags, sender

    socket.socket = SteppedSocket  # type: ignore[misc]  # the point: the station shall not notice
    time.time_ns = lambda: clock.shown_ns(_true_ns())
    time.time = lambda: clock.shown_ns(_true_ns()) / NS_PER_S


def _stepped(clock: SteppedClock, level: int, kind: int, data: bytes) -> tuple[int, int, bytes]:
    if kind != SO_TIMESTAMPNS:
        return level, kind, data
    seconds, nanoseconds = _STAMP.unpack(data[: _STAMP.size])
    return level, kind, _STAMP.pack(*divmod(clock.shown_ns(seconds * NS_PER_S + nanoseconds), NS_PER_S))


def main() -> int:
    """Run the station."""
    DRIVES["simulated"] = ("server.experiments.rig.drive_link", "RemoteDrive")
    if STEP_FILE in os.environ:
        live_by(SteppedClock(Path(os.environ[STEP_FILE])))
    watch = Watch()
    settle = pacemaker.settle

    def settle_and_watch() -> None:
        settle()
        watch.begin()

    pacemaker.settle = settle_and_watch
    code = run_station()
    if INSIDE_FILE in os.environ:
        watch.write(Path(os.environ[INSIDE_FILE]))
    return code


if __name__ == "__main__":
    sys.exit(main())
