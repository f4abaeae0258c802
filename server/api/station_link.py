"""The service's hold on the station: starts it, beats the heart, carries wishes, spreads ticks and events."""

from __future__ import annotations

import asyncio
import logging
import os
import shutil
from collections.abc import Callable, Coroutine
from itertools import count
from pathlib import Path
from typing import Any

from fusion.errors import MachineError, RefusedError
from server.api.child import Child
from server.channels import ServiceChannels, private_folder
from server.config import Config, StationStart, write_start
from server.messages import AnyEvent, DemoGoal, Heartbeat, LiveTick, StationUp, Wish, WishAnswer

log = logging.getLogger(__name__)

HEARTBEAT_S = 0.1
"""The station holds after 0.25 s without one (SR-9)."""
ANSWER_WITHIN_S = 2.0
SEND_TRIES, SEND_PAUSE_S = 25, 0.02
START_WITHIN_S = 120.0
"""The first start after an update compiles for half a minute, on a slow machine longer."""
STATION = ("-m", "server.station")


class StationLink:
    """The one place in the service that speaks with the station.

    Listeners are plain functions called in the event loop; they must be quick, and an error of theirs stays theirs.

    Args:
        config: the service's configuration.
        data: the data folder.
        command: what Python is told to run.
    """

    def __init__(self, config: Config, data: Path, command: tuple[str, ...] = STATION) -> None:
        self._config, self._data, self._command = config, data, command
        self._folder: Path | None = None
        self._channels: ServiceChannels | None = None
        self._station: Child | None = None
        self._tasks: list[asyncio.Task[None]] = []
        self._numbers = count(1)
        self._waiting: dict[int, asyncio.Future[WishAnswer]] = {}
        self._is_up = asyncio.Event()
        self.up: StationUp | None = None
        """Where the station listens; None while it is not up."""
        self.latest: LiveTick | None = None
        self.trouble = ""
        """Why the station is not up, in words."""
        self.on_tick: list[Callable[[LiveTick], None]] = []
        self.on_event: list[Callable[[AnyEvent], None]] = []
        self.on_death: list[Callable[[str], None]] = []
        self.in_charge: Callable[[], str] = lambda: ""
        """The account that is in charge and connected; "" = nobody (SR-11)."""

    @property
    def restarts(self) -> int:
        """How often the station died and was started again."""
        return 0 if self._station is None else self._station.restarts

    @property
    def station_pid(self) -> int | None:
        """The station's process number."""
        return None if self._station is None else self._station.pid

    async def open(self) -> None:
        """Start the station and wait until it listens.

        Raises:
            MachineError: it does not come up; says why.
        """
        self._folder = private_folder()
        self._channels = ServiceChannels(self._folder)
        start = StationStart(
            data=str(self._data),
            channels=str(self._folder),
            service=os.getpid(),
            demo=self._config.demo,
            station=self._config.station,
        )
        start_file = self._folder / "start.json"
        write_start(start, start_file)
        self._station = Child(
            "the station",
            (*self._command, "--config", str(start_file)),
            self._data / "logs" / "station.log",
            self._died,
        )
        self._tasks = [asyncio.create_task(work) for work in (self._beat(), self._read_ticks(), self._read_events())]
        await self._station.start()
        await self._wait_until_up()

    async def close(self) -> None:
        """End the station and the channels."""
        if self._station is not None:
            await self._station.close()
        for task in self._tasks:
            task.cancel()
        await asyncio.gather(*self._tasks, return_exceptions=True)
        channels, self._channels = self._channels, None  # a page that leaves now has nobody to tell
        if channels is not None:
            channels.close()
        if self._folder is not None:
            shutil.rmtree(self._folder, ignore_errors=True)

    async def ask(self, make: Callable[[int], Wish]) -> WishAnswer:
        """Send a wish and wait for what becomes of it.

        Args:
            make: makes the wish from its number.

        Raises:
            RefusedError: refused by the station (with its reason), or no answer came.
        """
        number = next(self._numbers)
        answer: asyncio.Future[WishAnswer] = asyncio.get_running_loop().create_future()
        self._waiting[number] = answer
        try:
            await self._send(make(number))
            answered = await asyncio.wait_for(answer, ANSWER_WITHIN_S)
        except TimeoutError:
            raise _no_answer("the station did not answer in time") from None
        finally:
            del self._waiting[number]
        if not answered.accepted:
            raise RefusedError(answered.reason or "the station refused", "", "look at what the arm is waiting for")
        return answered

    def beat(self) -> None:
        """Tell the station that the service is alive, and who is in charge; also between beats, when that changes."""
        channels = self._channels
        if channels is not None:
            channels.send(Heartbeat(number=0, ticks_missed=channels.ticks_missed, authority=self.in_charge()))

    def steer_demonstration(self, goal: DemoGoal) -> None:
        """Say where the virtual patient should reach."""
        if self._channels is not None:
            self._channels.steer_demonstration(goal)

    async def _send(self, wish: Wish) -> None:
        """A station that has just come up is heard before it can hear: its channels open one after the other."""
        for _ in range(SEND_TRIES):
            if self._open_channels().send(wish):
                return
            await asyncio.sleep(SEND_PAUSE_S)
        raise _no_answer("the station is not running")

    async def _wait_until_up(self) -> None:
        try:
            await asyncio.wait_for(self._is_up.wait(), START_WITHIN_S)
        except TimeoutError:
            self.trouble = self.trouble or f"it did not come up within {START_WITHIN_S:.0f} s"
        if self.up is None:
            log_path = self._data / "logs" / "station.log"
            raise MachineError(f"The station could not start: {self.trouble.rstrip('.')}. Its log is {log_path}")

    def _died(self, words: str) -> None:
        if self._is_up.is_set():  # before that, whoever starts the service is told why it cannot
            log.error("the station died: %s", words)
        self.up, self.latest, self.trouble = None, None, words
        self._is_up.set()  # whoever waits for the start need not wait any longer
        for answer in self._waiting.values():
            if not answer.done():
                answer.set_exception(_no_answer("the station died"))
        _tell(self.on_death, words)

    async def _beat(self) -> None:
        while True:
            self.beat()
            await asyncio.sleep(HEARTBEAT_S)

    async def _read_ticks(self) -> None:
        await _for_ever(self._read_tick)

    async def _read_tick(self) -> None:
        self.latest = await self._open_channels().tick()
        _tell(self.on_tick, self.latest)

    async def _read_events(self) -> None:
        await _for_ever(self._read_event)

    async def _read_event(self) -> None:
        event = await self._open_channels().event()
        if isinstance(event, StationUp):
            self.up, self.trouble = event, ""
            self._is_up.set()
        elif isinstance(event, WishAnswer):
            self._answered(event)
        _tell(self.on_event, event)

    def _answered(self, event: WishAnswer) -> None:
        waiting = self._waiting.get(event.number)
        if waiting is not None and not waiting.done():
            waiting.set_result(event)

    def _open_channels(self) -> ServiceChannels:
        if self._channels is None:
            raise RefusedError("the station has not been started")
        return self._channels


def _no_answer(what: str) -> RefusedError:
    return RefusedError(what, "a running station", "look at the station's state; it is started again by itself")


def _tell(listeners: list[Callable[[Any], None]], news: Any) -> None:
    for listener in listeners:
        try:
            listener(news)
        except Exception:
            log.exception("a listener failed")


async def _for_ever(step: Callable[[], Coroutine[Any, Any, None]]) -> None:
    """One bad message must not deafen the service."""
    while True:
        try:
            await step()
        except Exception:
            log.exception("a message from the station could not be read")
            await asyncio.sleep(0.1)
