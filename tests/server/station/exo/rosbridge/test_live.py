"""The real station process moves an emulated robot through rosbridge, and the robot is safe whatever ends."""

from __future__ import annotations

import asyncio
from pathlib import Path

import msgspec
import numpy as np
import pytest

from server.config import SensorsConfig, StationConfig
from server.emulated.rosbridge import RosbridgePeer
from server.exoskeleton import BUILT_IN, RosbridgeSettings
from server.experiments.rig.live_station import PORT, LiveStation
from server.messages import DriveState, Enable, Reset

HANDS = [(0.35, 0.1, -0.35), (0.15, 0.35, -0.25)]


def _config(peer: RosbridgePeer) -> StationConfig:
    device = msgspec.structs.replace(BUILT_IN, drive="rosbridge", rosbridge=RosbridgeSettings(url=peer.url))
    return StationConfig(sensors=SensorsConfig(ports={PORT: 0}), exoskeleton=device)


@pytest.fixture
def peer():
    with RosbridgePeer(BUILT_IN) as peer:
        yield peer


async def _engaged(station: LiveStation) -> None:
    await station.tick(lambda tick: tick.may_enable, 20)
    assert (await station.ask(lambda number: Enable(number=number))).accepted
    await station.tick(lambda tick: tick.exo.blend == 1.0, 20)


async def test_sr8_a_session_on_a_robot_whose_link_breaks_and_whose_station_is_killed(tmp_path: Path, peer) -> None:
    async with LiveStation(tmp_path, demo=True, config=_config(peer)) as station:
        assert station.up.drive == "rosbridge"
        assert (await station.ask(station.session(tmp_path / "session.mcap"))).accepted
        await _engaged(station)
        before = np.array(station.last.exo.angle_rad)
        await station.reach(HANDS, 1.5)
        assert np.abs(np.array(station.last.exo.angle_rad) - before).max() > 0.15
        apart = [
            np.abs(np.subtract(t.exo.command_rad, t.exo.angle_rad)).max()
            for t in station.ticks
            if t.state is DriveState.ENGAGED
        ]
        assert max(apart) < 0.2
        assert not peer.refusals

        peer.drop()
        failed = await station.tick(lambda tick: tick.state is DriveState.FAULT, 5)
        assert "was lost" in failed.reason
        await station.tick(lambda tick: not tick.exo.fault, 10)
        assert (await station.ask(lambda number: Reset(number=number))).state is DriveState.READY

        await _engaged(station)
        moving = asyncio.create_task(station.reach(HANDS[::-1], 1.0))
        async with asyncio.timeout(20):
            while np.abs(peer.robot.velocity_rad_s).max() < 0.1:
                await asyncio.sleep(0.005)
        station.process.kill()
        await station.process.wait()
        stood = peer.robot.angle_rad.copy()
        await asyncio.sleep(1.0)
        moving.cancel()
        assert np.abs(peer.robot.velocity_rad_s).max() < 1e-3
        assert np.abs(peer.robot.angle_rad - stood).max() < 0.3
        ranges = [(joint.min_rad, joint.max_rad) for joint in BUILT_IN.joints]
        assert all(low < angle < high for angle, (low, high) in zip(peer.robot.angle_rad, ranges, strict=True))
