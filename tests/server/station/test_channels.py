"""The channels: order, newest-wins, and that nothing blocks or is kept for a station that is not there."""

from __future__ import annotations

import asyncio
import os
import stat
from collections.abc import Iterator
from pathlib import Path

import pytest
from station_samples import live_tick

from server.channels import DemonstrationChannels, ServiceChannels, StationChannels, encoded, private_folder
from server.messages import DemoGoal, Enable, Hold, Pain, Stop, Warned, Wish


@pytest.fixture
def folder() -> Iterator[Path]:
    made = private_folder()
    yield made
    for left in made.iterdir():
        left.unlink()
    made.rmdir()


def test_private_folder_is_closed_to_others(folder: Path) -> None:
    assert stat.S_IMODE(os.stat(folder).st_mode) == 0o700


def test_private_folder_stays_short_enough_for_unix_sockets(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    deep = tmp_path / ("d" * 90)
    deep.mkdir()
    monkeypatch.delenv("XDG_RUNTIME_DIR", raising=False)
    monkeypatch.setenv("TMPDIR", str(deep))
    monkeypatch.setattr("tempfile.tempdir", None)
    made = private_folder()
    assert len(str(made / "events")) < 107
    made.rmdir()


async def test_sr7_wishes_arrive_in_order_and_stop_and_pain_have_their_own_channel(folder: Path) -> None:
    station, service = StationChannels(folder), ServiceChannels(folder)
    assert await service.connected(5)
    for number in range(3):
        assert service.send(Hold(number=number, reason="pause"))
    assert service.send(Stop(number=9, reason="enough"))
    assert service.send(Pain(number=10, reason="my shoulder"))
    wishes: list[Wish] = []
    stops: list[Stop | Pain] = []
    while len(wishes) < 3 or len(stops) < 2:
        await asyncio.sleep(0.005)
        wishes += station.wishes()
        stops += station.stops()
    assert [wish.number for wish in wishes] == [0, 1, 2]
    assert [stop.number for stop in stops] == [9, 10]
    service.close()
    station.close()


async def test_a_wish_is_not_kept_for_a_station_that_starts_later(folder: Path) -> None:
    service = ServiceChannels(folder)
    assert not service.send(Enable(number=1))
    station = StationChannels(folder)
    assert await service.connected(5)
    await asyncio.sleep(0.05)
    assert station.wishes() == []
    service.close()
    station.close()


async def test_a_slow_listener_gets_the_newest_tick_and_counts_the_missed(folder: Path) -> None:
    station, service = StationChannels(folder), ServiceChannels(folder)
    assert await service.connected(5)
    index = 0
    first = asyncio.ensure_future(service.tick())
    while not first.done():  # the subscription takes a moment to arrive
        station.publish(encoded(live_tick(index)))
        index += 1
        await asyncio.sleep(0.005)
    for last in range(index, index + 500):
        station.publish(encoded(live_tick(last)))
    await asyncio.sleep(0.2)
    seen = (await service.tick()).index
    while seen < index + 499:  # one may already have been fetched ahead
        newer = (await service.tick()).index
        assert newer > seen
        seen = newer
    assert service.ticks_missed >= 490
    service.close()
    station.close()


async def test_events_wait_for_the_service_in_order_and_never_block(folder: Path) -> None:
    station = StationChannels(folder)
    service = ServiceChannels(folder)
    assert await service.connected(5)
    for number in range(200):
        station.tell(encoded(Warned(t_s=float(number), code="test", text="")))
    assert [(await service.event()).t_s for _ in range(200)] == [float(number) for number in range(200)]
    service.close()
    for number in range(30_000):
        station.tell(encoded(Warned(t_s=float(number), code="test", text="")))
    assert station.events_dropped > 0
    station.close()


async def test_garbage_on_the_wish_channel_is_counted_and_changes_nothing(folder: Path) -> None:
    station, service = StationChannels(folder), ServiceChannels(folder)
    assert await service.connected(5)
    service._wishes.send(b"\xc1garbage")
    while station.wishes_refused == 0:
        assert station.wishes() == []
        await asyncio.sleep(0.005)
    service.close()
    station.close()


async def test_the_demonstration_hears_the_newest_goal_and_the_pause(folder: Path) -> None:
    station, demo, service = StationChannels(folder), DemonstrationChannels(folder), ServiceChannels(folder)
    heard = None
    while heard is None or heard.hand_in_trunk != (0.0, 0.0, 1.0):
        service.steer_demonstration(DemoGoal(hand_in_trunk=(0.0, 0.0, 1.0)))
        await asyncio.sleep(0.005)
        heard = demo.goal()
    assert not demo.is_paused()
    while not demo.is_paused():
        station.pause_demonstration(True)
        await asyncio.sleep(0.005)
    for end in (station, demo, service):
        end.close()
