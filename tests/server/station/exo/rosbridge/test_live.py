"""The real station process moves an emulated robot through rosbridge, and the robot is safe whatever ends.

On a machine that is busy with other things real processes stand still now and then, and the station holds, as it must:
a person resets, resumes and enables until the arm moves.
"""

from __future__ import annotations

import asyncio
import time
from collections.abc import Callable
from itertools import cycle
from pathlib import Path

import numpy as np

from server.config import SensorsConfig, StationConfig
from server.exoskeleton import BUILT_IN, device_limits
from server.experiments.rig.emulated_process import EmulatedProcess
from server.experiments.rig.live_station import PORT, LiveStation
from server.messages import DriveState, Enable, LiveTick, Reset, Resume, Wish
from server.station.exo.rosbridge.drive import RosbridgeDrive

HANDS = [(0.35, 0.1, -0.35), (0.15, 0.35, -0.25)]
WAYS_ON: dict[DriveState, Callable[[int], Wish]] = {
    DriveState.READY: lambda number: Enable(number=number),
    DriveState.HOLD: lambda number: Resume(number=number),
    DriveState.FAULT: lambda number: Reset(number=number),
}
LONG_S = 90.0


async def _moving(station: LiveStation) -> LiveTick:
    """Go on until the arm follows and is measured moving."""
    async with asyncio.timeout(LONG_S):
        for hand in cycle(HANDS):
            await station.reach([hand], 0.3)
            tick = station.last
            if tick.state is not DriveState.ENGAGED:
                await station.ask(WAYS_ON[tick.state])
            elif tick.exo.blend == 1.0 and max(map(abs, tick.exo.velocity_rad_s)) > 0.1:
                return tick


def _config(robot: EmulatedProcess) -> StationConfig:
    return StationConfig(sensors=SensorsConfig(ports={PORT: 0}), exoskeleton=robot.device)


async def test_sr8_a_session_on_a_robot_whose_link_breaks_and_comes_back(tmp_path: Path) -> None:
    with EmulatedProcess(BUILT_IN) as robot:
        async with LiveStation(tmp_path, demo=True, config=_config(robot)) as station:
            assert station.up.drive == "rosbridge"
            assert (await station.ask(station.session(tmp_path / "session.mcap"))).accepted
            begun = station.last.exo.angle_rad
            tick = await _moving(station)
            assert np.abs(np.subtract(tick.exo.angle_rad, begun)).max() > 0.01
            assert np.abs(np.subtract(tick.exo.angle_rad, tick.exo.command_rad)).max() < 0.2
            robot.tell("drop")
            await station.tick(lambda tick: tick.state is DriveState.FAULT and "was lost" in tick.reason, 10)
            await _moving(station)


async def test_sr3_sr8_a_robot_whose_station_is_killed_stands_inside_its_range(tmp_path: Path) -> None:
    with EmulatedProcess(BUILT_IN) as robot:
        async with LiveStation(tmp_path, demo=True, config=_config(robot)) as station:
            assert (await station.ask(station.session(tmp_path / "session.mcap"))).accepted
            await _moving(station)
            station.process.kill()
            await station.process.wait()
            last = station.last.exo
        time.sleep(0.5)
        with RosbridgeDrive(robot.device) as drive:
            stands = drive.read(time.monotonic())
            time.sleep(0.1)
            still = drive.read(time.monotonic())
    assert max(map(abs, stands.velocity_rad_s)) < 1e-3
    assert np.abs(np.subtract(still.angle_rad, stands.angle_rad)).max() < 1e-4
    # Led by 20 ms and braked at 10 rad/s² or more, and what passed between the last tick that was seen and the end.
    assert np.abs(np.subtract(stands.angle_rad, last.angle_rad)).max() < 0.4
    for angle, limits in zip(stands.angle_rad, device_limits(BUILT_IN), strict=True):
        assert limits.min_rad < angle < limits.max_rad
