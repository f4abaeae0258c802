"""Single faults around a real station: each ends safely and in its time, by the log of the drive's own process."""

from __future__ import annotations

from pathlib import Path

import pytest

from server.experiments.rig.drive_log import commands
from server.experiments.rig.scene import scene
from server.experiments.rig.station_faults import FAULTS
from server.messages import DriveState, Warned

pytestmark = pytest.mark.asyncio(loop_scope="module")


async def test_sr8_sr9_a_service_that_sends_nothing_any_more_holds_within_its_heartbeat(a_scene, shown) -> None:
    found = await shown(a_scene, FAULTS, "service-silent")
    assert "silent" in found.reason


async def test_sr8_sr11_nobody_in_charge_holds(a_scene, shown) -> None:
    await shown(a_scene, FAULTS, "nobody-in-charge")


async def test_sr8_sr4_both_sensors_unplugged_hold(a_scene, shown) -> None:
    await shown(a_scene, FAULTS, "sensors-unplugged")


@pytest.mark.parametrize("which", ["first", "second"])
async def test_sr8_one_sensor_unplugged_leaves_the_arm_within_its_limits(a_scene, shown, which) -> None:
    found = await shown(a_scene, FAULTS, f"{which}-sensor-unplugged")
    assert found.commands > 0


@pytest.mark.parametrize("trouble", ["half-dropped", "doubled", "reordered", "corrupted"])
async def test_sr8_troubled_datagrams_leave_the_arm_within_its_limits(a_scene, shown, trouble) -> None:
    found = await shown(a_scene, FAULTS, trouble)
    assert found.commands > 0


@pytest.mark.parametrize("step", ["clock-ahead", "clock-back"])
async def test_sr8_a_wall_clock_that_is_set_changes_nothing(a_scene, shown, step) -> None:
    assert (await shown(a_scene, FAULTS, step)).state is DriveState.ENGAGED


async def test_sr8_sr9_a_full_disk_costs_the_recording_and_is_said(a_scene, shown) -> None:
    await shown(a_scene, FAULTS, "disk-full")
    warned = await a_scene.station.event(Warned, 20, lambda event: event.code == "recorder")
    assert "cannot be written" in warned.text


async def test_sr8_a_drive_that_answers_nothing_is_a_fault_that_a_person_resets(a_scene, shown) -> None:
    await shown(a_scene, FAULTS, "drive-silent")


async def test_sr8_sr3_a_frozen_loop_leaves_the_drive_to_stop_and_holds_when_it_goes_on(a_scene, shown) -> None:
    found = await shown(a_scene, FAULTS, "station-frozen")
    assert found.commands <= 1


async def test_sr8_sr3_a_killed_station_leaves_the_drive_to_stop(tmp_path: Path, shown) -> None:
    async with scene(tmp_path) as opened:
        await shown(opened, FAULTS, "station-killed")
        assert commands(opened.drive.log.notes())
