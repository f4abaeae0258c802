"""The demonstration's own sensors: a process that sends like two real cameras, started beside the station."""

from __future__ import annotations

import asyncio
import logging
import os
from pathlib import Path

from server.api.child import Child
from server.api.station_link import StationLink
from server.messages import AnyEvent, StationUp

log = logging.getLogger(__name__)

SENSORS = ("-m", "server.station.sources.virtual")
DIALECT = "kinectv2-osc"


class DemoSensors:
    """Keeps the virtual sensors sending to wherever the station listens.

    Args:
        link: the station.
        bind: the address that the station listens on.
        data: the data folder, for the log.
    """

    def __init__(self, link: StationLink, bind: str, data: Path) -> None:
        self._link, self._data = link, data
        self._host = "127.0.0.1" if bind == "0.0.0.0" else bind  # noqa: S104 (compared, not bound)
        self._port: int | None = None
        self._child: Child | None = None
        self._moves: asyncio.Queue[int] = asyncio.Queue()
        self._task: asyncio.Task[None] | None = None
        link.on_event.append(self._take_event)

    def start(self) -> None:
        """Begin to follow the station."""
        self._task = asyncio.create_task(self._follow(), name="demonstration's sensors")

    async def close(self) -> None:
        """End the sensors."""
        if self._task is not None:
            self._task.cancel()
            await asyncio.gather(self._task, return_exceptions=True)
        if self._child is not None:
            await self._child.close()

    def _take_event(self, event: AnyEvent) -> None:
        """A station that was started again may have another port."""
        if isinstance(event, StationUp) and event.ports.get(DIALECT, self._port) != self._port:
            self._port = event.ports[DIALECT]
            self._moves.put_nowait(self._port)

    async def _follow(self) -> None:
        while True:
            port = await self._moves.get()
            if self._child is not None:
                await self._child.close()
            self._child = Child("the demonstration's sensors", self._command(port), self._log, _died)
            await self._child.start()

    @property
    def _log(self) -> Path:
        return self._data / "logs" / "sensors.log"

    def _command(self, port: int) -> tuple[str, ...]:
        where = ("--channels", str(self._link.folder), "--host", self._host, "--port", str(port))
        return (*SENSORS, *where, "--parent", str(os.getpid()))


def _died(words: str) -> None:
    log.warning("the demonstration's sensors are started again: %s", words)
