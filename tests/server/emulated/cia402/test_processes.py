"""Station and drives as processes of their own, on the bus between them: what is left when one is killed."""

from __future__ import annotations

import os
import signal
import time
from collections.abc import Iterator
from contextlib import ExitStack
from pathlib import Path

import pytest
from drive_process import Drives, drives_in, moving_station

from server.emulated.cia402.control import order
from server.exoskeleton_file import read_exoskeleton
from server.station.exo.cia402 import Cia402Drive
from server.station.exo.driver import ZERO, DriveCommand, DriveMode

HEARTBEAT_S = 0.4
"""Longer than in life: a busy machine is not a dead one."""


@pytest.fixture
def drives(tmp_path: Path) -> Iterator[Drives]:
    with drives_in(tmp_path, HEARTBEAT_S) as running:
        yield running


def test_sr3_drives_of_a_station_that_was_killed_stop_by_themselves_inside_their_time(drives: Drives) -> None:
    with moving_station(drives) as station:
        time.sleep(1.5)
        killed_s = time.monotonic()
        os.kill(station.pid, signal.SIGKILL)
    time.sleep(2.0)
    elbow = drives.lines("elbow")
    assert any(line.velocity_rad_s > 0.2 for line in elbow if line.t_s < killed_s), "it was moving"
    late = [line for line in elbow if line.t_s > killed_s + 2 * HEARTBEAT_S + 0.3]
    assert {line.state for line in late} == {"quick stop active"}
    assert max(abs(line.velocity_rad_s) for line in late) < 0.01
    assert late[-1].angle_rad == pytest.approx(late[0].angle_rad, abs=1e-3)


def test_sr8_drives_that_were_killed_are_a_fault_of_the_station(drives: Drives) -> None:
    with Cia402Drive(read_exoskeleton(drives.file)) as drive:
        said = _fault(drive, 0.5)
        assert said == ""
        drives.process.kill()
        drives.process.wait()
        assert _fault(drive, 6.0)


def test_orders_reach_drives_in_another_process(drives: Drives) -> None:
    with ExitStack() as stack:
        drive = stack.enter_context(Cia402Drive(read_exoskeleton(drives.file)))
        assert _fault(drive, 0.5) == ""
        order(drives.control, "fault elbow 0x4310")
        assert "the motor is too hot" in _fault(drive, 6.0)


def _fault(drive: Cia402Drive, seconds: float) -> str:
    end_s, reading = time.monotonic() + seconds, drive.read(time.monotonic())
    start = reading.angle_rad
    while not reading.fault and time.monotonic() < end_s:
        drive.command(DriveCommand(DriveMode.HOLD, start, ZERO, "test"), time.monotonic())
        time.sleep(0.01)
        reading = drive.read(time.monotonic())
    return reading.fault
