"""Single faults (SR-8): how each is put in and taken out again, what is safe afterwards, and within what time.

A fault is an asynchronous context: it is there while the block lasts.
"""

from __future__ import annotations

import resource
import signal
from collections.abc import AsyncIterator, Callable
from contextlib import AbstractAsyncContextManager, asynccontextmanager
from dataclasses import dataclass
from functools import partial
from typing import Final

from server.experiments.rig import wires
from server.experiments.rig.scene import Scene
from server.experiments.rig.wires import Wire
from server.messages import DriveState

PutIn = Callable[[Scene], AbstractAsyncContextManager[None]]

HEARTBEAT_S: Final = 0.25
STALE_S: Final = 0.1
WATCHDOG_S: Final = 0.1
TICK_S: Final = 0.01
BRAKING_S: Final = 0.4
"""From the device's highest speed, 2 rad/s, at 10 rad/s² and with the jerk's time at both ends."""
AN_HOUR_S: Final = 3600.0


@dataclass(frozen=True, slots=True)
class Fault:
    """One thing that goes wrong."""

    name: str
    what: str
    """For people."""
    put_in: PutIn
    safe: frozenset[DriveState]
    """States of which each is safe with this fault; with `ENGAGED` among them the arm may go on."""
    decided_within_s: float | None = None
    """From the fault to the station's change of state; None = the drive must see for itself, or it goes on."""
    still_within_s: float | None = None
    """From the fault to an arm that stands; None = it may go on, or cannot be measured."""
    words: tuple[str, ...] = ("",)
    """The reason that a person reads holds one of these."""
    watched_s: float = 0.8
    heard_after_s: float = 0.0
    """How long after the fault's end the station's state is asked for, where it cannot be heard before."""
    ends_station: bool = False

    @property
    def goes_on(self) -> bool:
        """Whether the arm may follow on."""
        return DriveState.ENGAGED in self.safe


@asynccontextmanager
async def _wired(scene: Scene, *through: Wire) -> AsyncIterator[None]:
    scene.patient.wires = list(through)
    try:
        yield
    finally:
        scene.patient.mend()


@asynccontextmanager
async def _wires_bent(scene: Scene, bend: Callable[[int], Wire]) -> AsyncIterator[None]:
    async with _wired(scene, bend(1), bend(2)):
        yield


@asynccontextmanager
async def _station_killed(scene: Scene) -> AsyncIterator[None]:
    scene.station.process.kill()
    yield


@asynccontextmanager
async def _station_frozen(scene: Scene) -> AsyncIterator[None]:
    scene.station.process.send_signal(signal.SIGSTOP)
    try:
        yield
    finally:
        scene.station.process.send_signal(signal.SIGCONT)


@asynccontextmanager
async def _service_silent(scene: Scene) -> AsyncIterator[None]:
    scene.station.beats = False
    try:
        yield
    finally:
        scene.station.beats = True


@asynccontextmanager
async def _nobody_in_charge(scene: Scene) -> AsyncIterator[None]:
    before, scene.station.authority = scene.station.authority, ""
    try:
        yield
    finally:
        scene.station.authority = before


@asynccontextmanager
async def _drive_frozen(scene: Scene) -> AsyncIterator[None]:
    scene.drive.process.send_signal(signal.SIGSTOP)
    try:
        yield
    finally:
        scene.drive.process.send_signal(signal.SIGCONT)


@asynccontextmanager
async def _clock_stepped(scene: Scene, seconds: float) -> AsyncIterator[None]:
    scene.clock.step(seconds)
    try:
        yield
    finally:
        scene.clock.step(0.0)  # a step back: the next fault's watch begins after it


@asynccontextmanager
async def _disk_full(scene: Scene) -> AsyncIterator[None]:
    """No file of the station may grow: what the kernel says to it is what a full disk says."""
    pid = scene.station.process.pid
    size = (scene.data / "session.mcap").stat().st_size
    before = resource.prlimit(pid, resource.RLIMIT_FSIZE, (size, resource.RLIM_INFINITY))
    try:
        yield
    finally:
        resource.prlimit(pid, resource.RLIMIT_FSIZE, before)


_HELD: Final = frozenset({DriveState.HOLD})
_GOING: Final = frozenset({DriveState.ENGAGED, DriveState.HOLD})
_UNMOVED: Final = frozenset({DriveState.ENGAGED})
_SOON: Final = 2 * TICK_S
"""The tick that sees it, and the one that was under way."""

FAULTS: Final = (
    Fault(
        "service-silent",
        "the service sends nothing any more (its event loop stands)",
        _service_silent,
        _HELD,
        HEARTBEAT_S + _SOON,
        HEARTBEAT_S + _SOON + BRAKING_S,
        ("silent",),
    ),
    Fault(
        "nobody-in-charge",
        "whoever is in charge is no longer connected (the heartbeat names nobody)",
        _nobody_in_charge,
        _HELD,
        HEARTBEAT_S + _SOON,
        HEARTBEAT_S + _SOON + BRAKING_S,
        ("charge",),
    ),
    Fault(
        "sensors-unplugged",
        "both sensors unplugged",
        lambda scene: _wired(scene, wires.cut, wires.cut),
        _HELD,
        STALE_S + 1 / 30 + _SOON,
        STALE_S + 1 / 30 + _SOON + BRAKING_S,
        ("sensor", "uncertain", "seen"),
    ),
    Fault(
        "first-sensor-unplugged",
        "first sensor unplugged, the second sees on",
        lambda scene: _wired(scene, wires.cut, wires.whole),
        _GOING,
    ),
    Fault(
        "second-sensor-unplugged",
        "second sensor unplugged, the first sees on",
        lambda scene: _wired(scene, wires.whole, wires.cut),
        _GOING,
    ),
    Fault(
        "half-dropped",
        "half of all datagrams dropped",
        partial(_wires_bent, bend=wires.half_dropped),
        _GOING,
    ),
    Fault("doubled", "every datagram twice", lambda scene: _wired(scene, wires.doubled, wires.doubled), _GOING),
    Fault("reordered", "datagrams in any order", partial(_wires_bent, bend=wires.reordered), _GOING),
    Fault("corrupted", "every other datagram corrupted", partial(_wires_bent, bend=wires.corrupted), _GOING),
    Fault("clock-ahead", "wall clock set an hour ahead", partial(_clock_stepped, seconds=AN_HOUR_S), _UNMOVED),
    Fault("clock-back", "wall clock set back by half a second", partial(_clock_stepped, seconds=-0.5), _UNMOVED),
    Fault("disk-full", "disk full while recording", _disk_full, _UNMOVED, watched_s=1.3),
    Fault(
        "drive-silent",
        "the drive answers nothing any more",
        _drive_frozen,
        frozenset({DriveState.FAULT}),
        WATCHDOG_S + TICK_S + _SOON,
        words=("drive",),
    ),
    Fault(
        "station-frozen",
        "the station's process frozen (SIGSTOP)",
        _station_frozen,
        _HELD,
        still_within_s=WATCHDOG_S + BRAKING_S,
        words=("stood still", "too busy"),
        heard_after_s=0.3,
    ),
    Fault(
        "station-killed",
        "the station killed (SIGKILL)",
        _station_killed,
        frozenset(),
        still_within_s=WATCHDOG_S + BRAKING_S,
        ends_station=True,
    ),
)
