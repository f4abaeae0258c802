"""Faults around a station: its wires, its disk, its clock, its drive, its own process, and whoever speaks to it."""

from __future__ import annotations

import resource
import signal
from collections.abc import AsyncIterator, Callable
from contextlib import asynccontextmanager
from functools import partial
from typing import Final

from server.experiments.rig import wires
from server.experiments.rig.fault import (
    BRAKING_S,
    GOING,
    HEARTBEAT_S,
    HELD,
    SOON_S,
    STALE_S,
    TICK_S,
    UNHEARD,
    UNMOVED,
    WATCHDOG_S,
    Fault,
)
from server.experiments.rig.scene import Scene
from server.experiments.rig.wires import Wire
from server.messages import DriveState

AN_HOUR_S: Final = 3600.0


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
async def station_killed(scene: Scene) -> AsyncIterator[None]:
    """`kill -9` of the station."""
    scene.station.process.kill()
    yield


@asynccontextmanager
async def station_frozen(scene: Scene) -> AsyncIterator[None]:
    """SIGSTOP of the station."""
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
async def drive_frozen(scene: Scene) -> AsyncIterator[None]:
    """SIGSTOP of the drive's process."""
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


FAULTS: Final[tuple[Fault[Scene], ...]] = (
    Fault(
        "service-silent",
        "the service sends nothing any more (its event loop stands)",
        _service_silent,
        HELD,
        HEARTBEAT_S + SOON_S,
        HEARTBEAT_S + SOON_S + BRAKING_S,
        ("silent",),
    ),
    Fault(
        "nobody-in-charge",
        "whoever is in charge is no longer connected (the heartbeat names nobody)",
        _nobody_in_charge,
        HELD,
        HEARTBEAT_S + SOON_S,
        HEARTBEAT_S + SOON_S + BRAKING_S,
        ("charge",),
    ),
    Fault(
        "sensors-unplugged",
        "both sensors unplugged",
        lambda scene: _wired(scene, wires.cut, wires.cut),
        HELD,
        STALE_S + 1 / 30 + SOON_S,
        STALE_S + 1 / 30 + SOON_S + BRAKING_S,
        ("sensor", "uncertain", "seen"),
    ),
    Fault(
        "first-sensor-unplugged",
        "first sensor unplugged, the second sees on",
        lambda scene: _wired(scene, wires.cut, wires.whole),
        GOING,
    ),
    Fault(
        "second-sensor-unplugged",
        "second sensor unplugged, the first sees on",
        lambda scene: _wired(scene, wires.whole, wires.cut),
        GOING,
    ),
    Fault(
        "half-dropped",
        "half of all datagrams dropped",
        partial(_wires_bent, bend=wires.half_dropped),
        GOING,
    ),
    Fault("doubled", "every datagram twice", lambda scene: _wired(scene, wires.doubled, wires.doubled), GOING),
    Fault("reordered", "datagrams in any order", partial(_wires_bent, bend=wires.reordered), GOING),
    Fault("corrupted", "every other datagram corrupted", partial(_wires_bent, bend=wires.corrupted), GOING),
    Fault("clock-ahead", "wall clock set an hour ahead", partial(_clock_stepped, seconds=AN_HOUR_S), UNMOVED),
    Fault("clock-back", "wall clock set back by half a second", partial(_clock_stepped, seconds=-0.5), UNMOVED),
    Fault("disk-full", "disk full while recording", _disk_full, UNMOVED, watched_s=1.3),
    Fault(
        "drive-silent",
        "the drive answers nothing any more",
        drive_frozen,
        frozenset({DriveState.FAULT}),
        WATCHDOG_S + TICK_S + SOON_S,
        words=("drive",),
    ),
    Fault(
        "station-frozen",
        "the station's process frozen (SIGSTOP)",
        station_frozen,
        frozenset({DriveState.HOLD, DriveState.FAULT}),
        still_within_s=WATCHDOG_S + BRAKING_S,
        words=("stood still", "too busy", "not of now"),
        heard_after_s=0.3,
    ),
    Fault(
        "station-killed",
        "the station killed (SIGKILL)",
        station_killed,
        UNHEARD,
        still_within_s=WATCHDOG_S + BRAKING_S,
        ends=True,
    ),
)
