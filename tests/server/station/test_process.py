"""The real station process: a session with the virtual patient, and every way of ending."""

from __future__ import annotations

import asyncio
import signal
import socket
import sys
import time
from collections.abc import AsyncIterator
from contextlib import asynccontextmanager
from itertools import pairwise
from pathlib import Path

import msgspec
import numpy as np
import psutil
import pytest
from mcap.exceptions import McapError
from mcap.reader import NonSeekingReader

from fusion.recording.log import TICKS
from fusion.recording.reader import read_recording
from server.config import SensorsConfig, StationConfig, StationStart, write_start
from server.experiments.rig.live_station import PORT, LiveStation
from server.messages import CloseSession, DriveState, Enable, LiveTick, Resume, SessionClosed, Stop

HANDS = [(0.35, 0.05, -0.30), (0.15, -0.15, -0.40)]
_decode = msgspec.msgpack.Decoder(LiveTick).decode


def _recorded_ticks(path: Path) -> list[LiveTick]:
    """What can be read, also of a recording that was cut off."""
    ticks: list[LiveTick] = []
    with path.open("rb") as file:
        try:
            for _, channel, message in NonSeekingReader(file).iter_messages(log_time_order=False):
                if channel.topic == TICKS:
                    ticks.append(_decode(message.data))
        except McapError:
            pass
    return ticks


@asynccontextmanager
async def _attended(station: LiveStation) -> AsyncIterator[None]:
    """A therapist who starts the arm and lets it go on: on a busy machine a real loop stands still now and then."""

    async def attend() -> None:
        while True:
            state = station.last.state
            if state in (DriveState.READY, DriveState.HOLD):
                wish = Enable(number=0) if state is DriveState.READY else Resume(number=0)
                await station.ask(lambda number, wish=wish: msgspec.structs.replace(wish, number=number))
            await asyncio.sleep(0.1)

    therapist = asyncio.create_task(attend())
    try:
        yield
    finally:
        therapist.cancel()
        await asyncio.gather(therapist, return_exceptions=True)


async def _moved_rad(station: LiveStation) -> float:
    """How far the arm goes while the patient reaches, a few times if need be."""
    before, moved = station.last.exo.angle_rad, 0.0
    for _ in range(5):
        await station.reach(HANDS, 1.5)
        moved = float(np.abs(np.array([t.exo.angle_rad for t in station.ticks[-300:]]) - before).max())
        if moved > 0.2:
            break
    return moved


async def test_a_whole_session_with_the_virtual_patient(tmp_path: Path) -> None:
    path = tmp_path / "session.mcap"
    async with LiveStation(tmp_path, demo=True) as station:
        assert (await station.ask(station.session(path))).accepted
        await station.tick(lambda tick: tick.may_enable, 60)
        async with _attended(station):
            await station.tick(lambda tick: tick.exo.blend == 1.0, 60)
            assert await _moved_rad(station) > 0.2
        stopped = await station.ask(lambda number: Stop(number=number, reason="pain"))
        assert stopped.state is DriveState.STOPPED
        at_rest = await station.tick(lambda tick: not any(tick.exo.command_velocity_rad_s), 5)
        assert at_rest.reason == "pain"
        assert (await station.ask(lambda number: CloseSession(number=number))).accepted
        closed = await station.event(SessionClosed, 10)
        assert closed.recording == str(path)
    assert station.process.returncode == 0
    recorded = read_recording(path)
    assert {stream.sensor for stream in recorded.skeleton_streams} == {"127.0.1.1", "127.0.1.2"}
    ticks = _recorded_ticks(path)
    assert all(after.index == before.index + 1 for before, after in pairwise(ticks))
    assert {tick.state for tick in ticks} >= {DriveState.READY, DriveState.ENGAGED, DriveState.STOPPED}
    assert not list(tmp_path.glob("logs/*Traceback*"))
    assert "Traceback" not in (tmp_path / "logs" / "realtime.log").read_text()


async def test_the_demonstrations_sensors_are_started_again_when_they_die(tmp_path: Path) -> None:
    async with LiveStation(tmp_path, demo=True) as station:
        (sensors,) = psutil.Process(station.process.pid).children()
        sensors.kill()
        seen = await station.tick(lambda tick: len(tick.sensors) == 2, 20)
        assert {sensor.sensor for sensor in seen.sensors} == {"127.0.1.1", "127.0.1.2"}
        assert "started again" in (tmp_path / "logs" / "realtime.log").read_text()


async def test_sr8_kill_9_loses_at_most_about_the_last_second(tmp_path: Path) -> None:
    path = tmp_path / "session.mcap"
    async with LiveStation(tmp_path) as station:
        await station.ask(station.session(path))
        await asyncio.sleep(2.5)
        station.process.kill()
        await station.process.wait()
        killed_s = time.monotonic()
    ticks = _recorded_ticks(path)
    assert ticks
    assert killed_s - ticks[-1].t_s < 1.7  # a flush a second, and what a busy machine adds


async def test_a_terminated_station_finishes_its_recording(tmp_path: Path) -> None:
    path = tmp_path / "session.mcap"
    async with LiveStation(tmp_path) as station:
        await station.ask(station.session(path))
        station.process.terminate()
        assert await asyncio.wait_for(station.process.wait(), 10) == 0
    with path.open("rb") as file:
        assert file.read()[-8:] == b"\x89MCAP0\r\n"  # whole to its last byte


async def test_a_second_station_on_the_same_data_folder_is_refused_in_words(tmp_path: Path) -> None:
    async with LiveStation(tmp_path) as station:
        code, words = await _run(_start(tmp_path, {PORT: 0}))
        assert code == 2
        assert f"process {station.process.pid}" in words
        assert str(tmp_path) in words
        assert "--data" in words


async def test_a_port_in_use_is_refused_in_words_without_a_traceback(tmp_path: Path) -> None:
    with socket.socket(socket.AF_INET, socket.SOCK_DGRAM) as taken:
        taken.bind(("127.0.0.1", 0))
        port = taken.getsockname()[1]
        code, words = await _run(_start(tmp_path, {PORT: port}))
    assert code == 2
    assert str(port) in words
    assert "already in use" in words
    assert "Traceback" not in words


@pytest.mark.parametrize(
    ("content", "named"),
    [('{"data": "d"}', "channels"), ("{", "not well-formed"), ('{"data": "d", "channels": "c", "dmeo": true}', "dmeo")],
)
async def test_a_broken_start_file_is_named(tmp_path: Path, content: str, named: str) -> None:
    path = tmp_path / "start.json"
    path.write_text(content)
    code, words = await _run(path)
    assert code == 2
    assert named in words
    assert "Traceback" not in words


def _start(data: Path, ports: dict[str, int]) -> Path:
    start = data / "start.json"  # it is refused before it opens a channel
    config = StationConfig(sensors=SensorsConfig(ports=ports))
    write_start(StationStart(data=str(data), channels=str(start.parent), station=config), start)
    return start


async def _run(start: Path) -> tuple[int | None, str]:
    """Run a station that should refuse to start; its code and what it says."""
    process = await asyncio.create_subprocess_exec(
        sys.executable, "-m", "server.station", "--config", str(start), stderr=asyncio.subprocess.PIPE
    )
    try:
        _, words = await asyncio.wait_for(process.communicate(), 30)
    except TimeoutError:
        process.send_signal(signal.SIGKILL)
        raise
    return process.returncode, words.decode()
