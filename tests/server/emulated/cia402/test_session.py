"""The real station process moves emulated drives over a CAN bus, and they are safe whatever ends."""

from __future__ import annotations

import asyncio
import time
from pathlib import Path

import numpy as np
from drive_process import Drives, drives_in

from server.config import SensorsConfig, StationConfig
from server.emulated.cia402.control import order
from server.exoskeleton_file import read_exoskeleton
from server.experiments.rig.live_station import PORT, LiveStation
from server.messages import DriveState, Enable, Reset, Resume

HANDS = [(0.35, 0.1, -0.35), (0.15, 0.35, -0.25)]
JOINTS = ("plane", "elevation", "axial_rotation", "elbow")
HEARTBEAT_S = 0.5
"""Longer than in life: a busy machine is not a dead one."""


def _states(drives: Drives) -> set[str]:
    return {drives.lines(joint)[-1].state for joint in JOINTS}


async def _moved(station: LiveStation, by_rad: float) -> None:
    """Enable, and again where a busy machine made the station hold, until the healthy hand has moved the drives."""
    before = np.array(station.last.exo.angle_rad)
    async with asyncio.timeout(60):
        while np.abs(np.array(station.last.exo.angle_rad) - before).max() < by_rad:
            if station.last.state is DriveState.READY and station.last.may_enable:
                await station.ask(lambda number: Enable(number=number))
            if station.last.state is DriveState.HOLD:
                await station.ask(lambda number: Resume(number=number))
            await station.reach(HANDS, 0.5)


async def _reset(station: LiveStation) -> None:
    """As a person does: until it is granted. The first press reaches the drives."""
    async with asyncio.timeout(20):
        while not (await station.ask(lambda number: Reset(number=number))).accepted:
            await asyncio.sleep(0.2)


async def test_sr8_a_session_on_drives_of_which_one_fails_and_whose_station_is_killed(tmp_path: Path) -> None:
    with drives_in(tmp_path, HEARTBEAT_S) as drives:
        config = StationConfig(sensors=SensorsConfig(ports={PORT: 0}), exoskeleton=read_exoskeleton(drives.file))
        async with LiveStation(tmp_path / "data", demo=True, config=config) as station:
            assert station.up.drive == "cia402"
            assert (await station.ask(station.session(tmp_path / "session.mcap"))).accepted
            await _moved(station, 0.15)

            order(drives.control, "fault elbow 0x4310")
            failed = await station.tick(lambda tick: tick.state is DriveState.FAULT, 5)
            assert "The drive of 'elbow' reports: the motor is too hot" in failed.reason
            await asyncio.sleep(0.5)
            assert _states(drives) == {"fault", "quick stop active"}
            await _reset(station)
            assert station.last.state is not DriveState.ENGAGED
            assert _states(drives) == {"operation enabled"}

            station.process.kill()
            await station.process.wait()
            killed_s = time.monotonic()
            await asyncio.sleep(2 * HEARTBEAT_S + 1.0)
        _stood(drives, killed_s)


def _stood(drives: Drives, killed_s: float) -> None:
    assert _states(drives) == {"quick stop active"}
    for joint in JOINTS:
        after = [line for line in drives.lines(joint) if line.t_s > killed_s + 2 * HEARTBEAT_S + 0.2]
        assert max(abs(line.velocity_rad_s) for line in after) < 0.01
        assert max(line.angle_rad for line in after) - min(line.angle_rad for line in after) < 1e-3
