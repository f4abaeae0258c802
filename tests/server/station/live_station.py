"""The real station process with a small service in front of it, for tests and measurements."""

from __future__ import annotations

import asyncio
import shutil
import sys
import tempfile
from collections.abc import Callable
from itertools import count
from pathlib import Path
from types import TracebackType
from typing import Self, TypeVar

from fusion.skeleton import Side
from server.channels import ServiceChannels, private_folder
from server.config import SensorsConfig, StationConfig, StationStart, write_start
from server.messages import (
    AnyEvent,
    DemoGoal,
    Heartbeat,
    LiveTick,
    OpenSession,
    StationUp,
    Wish,
    WishAnswer,
)

PORT = "kinectv2-osc"
Event = TypeVar("Event")


class LiveStation:
    """`python -m server.station` as a child, and everything it says.

    Args:
        data: its data folder.
        demo: with the virtual patient.
    """

    def __init__(self, data: Path, demo: bool = False) -> None:
        self.data, self.demo = data, demo
        self.config = StationConfig(sensors=SensorsConfig(ports={PORT: 0}))
        self.ticks: list[LiveTick] = []
        self.events: list[AnyEvent] = []
        self.beats = True
        self._numbers = count(1)
        self._tasks: list[asyncio.Task[None]] = []

    async def __aenter__(self) -> Self:
        self.folder = private_folder()
        self.channels = ServiceChannels(self.folder)
        start = self.folder / "start.json"
        write_start(
            StationStart(data=str(self.data), channels=str(self.folder), demo=self.demo, station=self.config), start
        )
        self.process = await asyncio.create_subprocess_exec(
            sys.executable, "-m", "server.station", "--config", str(start), stderr=asyncio.subprocess.PIPE
        )
        self._tasks = [asyncio.create_task(work()) for work in (self._beat, self._listen, self._watch)]
        self.up = await self.event(StationUp, 30)
        await self.channels.connected(5)
        return self

    async def __aexit__(
        self, kind: type[BaseException] | None, error: BaseException | None, trace: TracebackType | None
    ) -> None:
        if self.process.returncode is None:
            self.process.terminate()
            await asyncio.wait_for(self.process.wait(), 10)
        for task in self._tasks:
            task.cancel()
        await asyncio.gather(*self._tasks, return_exceptions=True)
        self.channels.close()
        shutil.rmtree(self.folder, ignore_errors=True)

    @property
    def port(self) -> int:
        return self.up.ports[PORT]

    async def ask(self, make: Callable[[int], Wish]) -> WishAnswer:
        number = next(self._numbers)
        assert self.channels.send(make(number))
        return await self.event(WishAnswer, 5, lambda answer: answer.number == number)

    async def event(self, kind: type[Event], within_s: float, right: Callable[[Event], bool] = lambda _: True) -> Event:
        seen = 0
        async with asyncio.timeout(within_s):
            while True:
                for event in self.events[seen:]:
                    if isinstance(event, kind) and right(event):
                        return event
                seen = len(self.events)
                await asyncio.sleep(0.01)

    async def tick(self, right: Callable[[LiveTick], bool], within_s: float) -> LiveTick:
        """The next tick that is as wanted."""
        seen = len(self.ticks)
        async with asyncio.timeout(within_s):
            while True:
                for tick in self.ticks[seen:]:
                    if right(tick):
                        return tick
                seen = len(self.ticks)
                await asyncio.sleep(0.01)

    def session(self, recording: Path, healthy_side: Side = Side.RIGHT) -> Callable[[int], OpenSession]:
        return lambda number: OpenSession(
            number=number,
            session="7",
            patient="P-7",
            healthy_side=healthy_side,
            side_confirmed=True,
            limits=self.config.device,
            limits_set_by="therapist",
            recording=str(recording),
        )

    async def reach(self, hands: list[tuple[float, float, float] | None], seconds_each: float) -> None:
        """Let the virtual patient reach here and there."""
        for hand in hands:
            angles = self.ticks[-1].exo.angle_rad
            self.channels.steer_demonstration(DemoGoal(hand_in_trunk=hand, exo_rad=angles))
            await asyncio.sleep(seconds_each)

    async def _beat(self) -> None:
        while True:
            if self.beats:
                self.channels.send(Heartbeat(number=0, ticks_missed=self.channels.ticks_missed, authority="test"))
            await asyncio.sleep(0.05)

    async def _listen(self) -> None:
        async for event in self.channels.events():
            self.events.append(event)

    async def _watch(self) -> None:
        async for tick in self.channels.ticks():
            self.ticks.append(tick)


def temporary_data() -> Path:
    return Path(tempfile.mkdtemp(prefix="mirrorlimb-data-"))
