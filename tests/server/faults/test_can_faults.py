"""Single faults on a CAN bus between processes: unchanged station, emulated CiA 402 drives, judged by their journal."""

from __future__ import annotations

import pytest

from server.experiments.rig.can_faults import FAULTS

pytestmark = pytest.mark.asyncio(loop_scope="module")


async def test_sr8_one_silent_drive_on_the_bus_is_a_fault_of_the_whole_arm(a_can_scene, shown) -> None:
    found = await shown(a_can_scene, FAULTS, "node-silent")
    assert "shoulder elevation" in found.reason


async def test_sr8_one_faulty_drive_on_the_bus_stops_the_whole_arm(a_can_scene, shown) -> None:
    found = await shown(a_can_scene, FAULTS, "node-fault")
    assert "shoulder elevation" in found.reason


async def test_sr8_a_dead_bus_is_a_fault(a_can_scene, shown) -> None:
    await shown(a_can_scene, FAULTS, "bus-dead")


async def test_sr8_sr3_drives_on_the_bus_stop_when_the_station_is_frozen(a_can_scene, shown) -> None:
    await shown(a_can_scene, FAULTS, "station-frozen")


async def test_sr8_sr3_drives_on_the_bus_stop_when_the_station_is_killed(a_can_scene, shown) -> None:
    await shown(a_can_scene, FAULTS, "station-killed")
