"""Single faults around a whole service: page, database, disk and processes, each ending safely and in its time."""

from __future__ import annotations

import psutil
import pytest

from server.experiments.rig.live_service import until
from server.experiments.rig.service_faults import FAULTS

pytestmark = pytest.mark.asyncio(loop_scope="module")
WHOLE = b"\x89MCAP0\r\n"


async def test_sr8_sr11_the_page_in_charge_closed_holds(a_service, shown) -> None:
    await shown(a_service, FAULTS, "page-closed")


async def test_sr8_sr9_a_locked_database_leaves_the_arm_to_go_on(a_service, shown) -> None:
    await shown(a_service, FAULTS, "database-locked")


async def test_sr8_sr7_a_stop_comes_through_while_the_database_is_locked(a_service, shown) -> None:
    await shown(a_service, FAULTS, "stop-database-locked")


async def test_sr8_sr9_a_full_disk_under_everything_leaves_the_arm_to_go_on(a_service, shown) -> None:
    await shown(a_service, FAULTS, "disk-full")


async def test_sr8_sr9_a_frozen_service_holds_within_its_heartbeat(a_service, shown) -> None:
    await shown(a_service, FAULTS, "service-frozen")


async def test_sr8_sr3_a_killed_station_stops_at_the_drive_and_the_next_one_moves_nothing(a_service, shown) -> None:
    await shown(a_service, FAULTS, "station-killed")


async def test_sr8_a_killed_service_holds_at_once_and_its_station_ends_with_the_recording_whole(
    a_service, shown
) -> None:
    await a_service.mirroring()
    station = a_service.station
    await shown(a_service, FAULTS, "service-killed")
    await until(lambda: not psutil.pid_exists(station.pid) or station.status() == psutil.STATUS_ZOMBIE)
    newest = max(a_service.data.rglob("*.mcap"), key=lambda path: path.stat().st_mtime)
    assert newest.read_bytes().endswith(WHOLE)
