"""The real station process with a small service in front of it that says who is in charge."""

from __future__ import annotations

import asyncio
import os
import shutil
import sys
from collections.abc import Callable, Mapping
from itertools import count
from pathlib import Path
from types import TracebackType
from typing import Final, Self, TypeVar

from fusion.errors import MachineError
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

PORT: Final = "kinectv2-osc"
STATION: Final = ("-m", "server.station")
AUTHORITY: Final = "therapist"
START_WITHIN_S: Final = 120.0
"""The first start after an update compiles for half a minute."""
Event = TypeVar("Event")


class LiveStation:
    """`python -m server.station` as a child, and everything it says.

    Args:
        data: its data folder.
        demo: with the virtual patient.
        config: of the station; by default it listens on a free port.
        command: what Python is told to run as the station.
        environment: what its environment has besides ours.
    """

    def __init__(
        self,
        data: Path,
        demo: bool = False,
        config: StationConfig | None = None,
        command: tuple[str, ...] = STATION,
        environment: Mapping[str, str] | None = None,
    ) -> None:
        self.data, self.demo, self._command = data, demo, command
        self.config = config or StationConfig(sensors=SensorsConfig(ports={PORT: 0}))
        self._environment = {**os.environ, **(environment or {})}
        self.ticks: list[LiveTick] = []
        self.events: list[AnyEvent] = []
        self.beats = True
        self.authority = AUTHORITY
        """Who is in charge, as the heartbeat says."""
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
            *(sys.executable, *self._command, "--config", str(start)),
            stderr=asyncio.subprocess.PIPE,
            env=self._environment,
        )
        self._tasks = [asyncio.create_task(work()) for work in (self._beat, self._listen, self._watch)]
        self.up = await self._start()
        await self.channels.connected(5)
        await self.tick(lambda _: True, 5)
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
        """Where it listens for sensors."""
        return self.up.ports[PORT]

    @property
    def last(self) -> LiveTick:
        """The newest tick."""
        return self.ticks[-1]

    async def ask(self, make: Callable[[int], Wish]) -> WishAnswer:
        """Send a wish and wait for what becomes of it.

        Raises:
            MachineError: the station does not take it.
        """
        number = next(self._numbers)
        if not self.channels.send(make(number)):
            raise MachineError("the station takes no wishes", "a running station")
        return await self.event(WishAnswer, 10, lambda answer: answer.number == number)

    async def event(self, kind: type[Event], within_s: float, right: Callable[[Event], bool] = lambda _: True) -> Event:
        """The first event that is as wanted, also one that has come already.

        Raises:
            TimeoutError: none came.
        """
        seen = 0
        async with asyncio.timeout(within_s):
            while True:
                for event in self.events[seen:]:
                    if isinstance(event, kind) and right(event):
                        return event
                seen = len(self.events)
                await asyncio.sleep(0.01)

    async def tick(self, right: Callable[[LiveTick], bool], within_s: float) -> LiveTick:
        """The next tick that is as wanted.

        Raises:
            TimeoutError: none came.
        """
        seen = len(self.ticks)
        async with asyncio.timeout(within_s):
            while True:
                for tick in self.ticks[seen:]:
                    if right(tick):
                        return tick
                seen = len(self.ticks)
                await asyncio.sleep(0.005)

    def session(self, recording: Path, healthy_side: Side = Side.RIGHT) -> Callable[[int], OpenSession]:
        """The wish that opens a session with nothing missing."""
        return lambda number: OpenSession(
            number=number,
            session="7",
            patient="P-7",
            healthy_side=healthy_side,
            side_confirmed=True,
            limits=self.config.device,
            limits_set_by=AUTHORITY,
            recording=str(recording),
        )

    async def reach(self, hands: list[tuple[float, float, float] | None], seconds_each: float) -> None:
        """Let the virtual patient reach here and there."""
        for hand in hands:
            angles = self.last.exo.angle_rad
            self.channels.steer_demonstration(DemoGoal(hand_in_trunk=hand, exo_rad=angles))
            await asyncio.sleep(seconds_each)

    async def _start(self) -> StationUp:
        waiting = [asyncio.create_task(self.event(StationUp, START_WITHIN_S)), asyncio.create_task(self.process.wait())]
        done, left = await asyncio.wait(waiting, return_when=asyncio.FIRST_COMPLETED)
        for task in left:
            task.cancel()
        if waiting[0] in done:
            return await self.event(StationUp, 1)
        words = await self.process.stderr.read() if self.process.stderr else b""
        raise MachineError(f"the station did not start: {words.decode(errors='replace').strip()}")

    async def _beat(self) -> None:
        while True:
            if self.beats:
                beat = Heartbeat(number=0, ticks_missed=self.channels.ticks_missed, authority=self.authority)
                self.channels.send(beat)
            await asyncio.sleep(0.05)

    async def _listen(self) -> None:
        async for event in self.channels.events():
            self.events.append(event)

    async def _watch(self) -> None:
        async for tick in self.channels.ticks():
            self.ticks.append(tick)
