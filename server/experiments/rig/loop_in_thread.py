"""The station's loop as it would be without a process of its own: a plain thread beside a web server."""

from __future__ import annotations

import threading
from collections.abc import Callable
from itertools import count
from pathlib import Path
from typing import Final

import msgspec

from fusion.pipeline import PipelineSettings
from fusion.skeleton import Side
from fusion.warm import warm
from server.config import StationConfig
from server.experiments.rig.drive_link import RemoteDrive
from server.experiments.rig.live_station import AUTHORITY
from server.messages import DriveState, Enable, Heartbeat, LiveTick, OpenSession, Reset, Resume, Stop, Wish
from server.station import pacemaker
from server.station.loop import Loop
from server.station.perception import Perception
from server.station.sources.udp import UdpSource

_tick_from = msgspec.msgpack.Decoder(LiveTick).decode
_ON: Final[dict[DriveState, Callable[[int], Wish]]] = {
    DriveState.READY: lambda number: Enable(number=number),
    DriveState.HOLD: lambda number: Resume(number=number),
    DriveState.STOPPED: lambda number: Reset(number=number),
    DriveState.FAULT: lambda number: Reset(number=number),
}
ASKED_EVERY: Final = 50
"""Ticks between two wishes."""


class Attendant:
    """In place of the channels: a service that beats, opens a session and lets the arm go on whenever it may.

    Args:
        config: of the station.
        recording: file to record to.
    """

    def __init__(self, config: StationConfig, recording: Path) -> None:
        self._numbers = count(1)
        self._state = DriveState.OFF
        self._ticks = 0
        self._open = OpenSession(
            number=next(self._numbers),
            session="thread",
            patient="P-thread",
            healthy_side=Side.RIGHT,
            side_confirmed=True,
            limits=config.device,
            limits_set_by=AUTHORITY,
            recording=str(recording),
        )

    def stops(self) -> list[Stop]:
        """Nobody stops it."""
        return []

    def wishes(self) -> list[Wish]:
        """A heartbeat, and now and then what lets the arm go on."""
        self._ticks += 1
        wishes: list[Wish] = [Heartbeat(number=0, authority=AUTHORITY)]
        if self._ticks == 1:
            wishes.append(self._open)
        elif self._ticks % ASKED_EVERY == 0 and self._state in _ON:
            wishes.append(_ON[self._state](next(self._numbers)))
        return wishes

    def publish(self, tick: bytes) -> None:
        """Looks at one now and then, as a page would."""
        if self._ticks % ASKED_EVERY == ASKED_EVERY - 1:
            self._state = _tick_from(tick).state

    def tell(self, event: bytes) -> None:
        """Nobody listens."""

    def pause_demonstration(self, paused: bool) -> None:
        """There is none."""


def start_loop(config: StationConfig, data: Path, drive_address: str) -> int:
    """Start the loop in a thread of this process, for as long as the process lives.

    Args:
        config: of the station.
        data: folder to record to.
        drive_address: Unix socket of its drive's process.

    Returns:
        The UDP port on which it hears sensors.
    """
    warm(config.method)
    source = UdpSource(config.sensors)
    perception = Perception(PipelineSettings(Side.LEFT, config.method, config.reference))
    drive = RemoteDrive(config.exoskeleton, drive_address)
    attendant = Attendant(config, data / "thread.mcap")

    def run() -> None:
        with drive:
            loop = Loop(config, source, perception, drive, attendant)  # type: ignore[arg-type]  # speaks as channels do
            pacemaker.keep_time(loop.step, loop.count_overruns, config.rate_hz, lambda: True)

    threading.Thread(target=run, name="loop", daemon=True).start()
    return next(iter(source.ports.values()))
