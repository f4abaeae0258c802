"""The real service as a process, with its real station, and a therapist's page that asks and watches."""

from __future__ import annotations

import asyncio
import os
import signal
import sys
import time
from collections.abc import AsyncIterator, Callable
from contextlib import AsyncExitStack, asynccontextmanager, suppress
from dataclasses import dataclass, field
from pathlib import Path
from typing import Final

import httpx
import msgspec
import psutil
from websockets.asyncio.client import connect
from websockets.exceptions import ConnectionClosed

from fusion.errors import MachineError
from server.api.live import Screen
from server.experiments.rig.drive_link import ADDRESS
from server.experiments.rig.drive_log import follows, told_after_s
from server.experiments.rig.scene import DriveProcess, running_drive
from server.experiments.rig.station_process import INSIDE_FILE
from server.messages import DriveState, JointLimits

PAGE: Final = "therapist"
SERVICE: Final = ("-m", "server.experiments.rig.service_process")
START_WITHIN_S: Final = 120.0
ENGAGED_WITHIN_S: Final = 60.0
MOVING_RAD_S: Final = 0.2
WAYS_ON: Final = {
    DriveState.READY: "start",
    DriveState.HOLD: "resume",
    DriveState.STOPPED: "reset",
    DriveState.FAULT: "reset",
}


class ShortTick(msgspec.Struct, frozen=True):
    """Of `LiveTick`: what the page goes by."""

    index: int
    t_s: float
    state: DriveState
    reason: str
    blockers: tuple[str, ...]
    limits: tuple[JointLimits, ...]


class ShortMessage(msgspec.Struct, frozen=True):
    """Of `LiveMessage`."""

    tick: ShortTick


_message_from = msgspec.json.Decoder(ShortMessage).decode


def acknowledged(tick: ShortTick) -> str:
    """What a page says that has drawn a tick."""
    return f'{{"ack": {tick.index}, "drawn_on": "{Screen.DASHBOARD}"}}'


@dataclass
class LiveService:
    """A running service and one page of it, logged in and in charge."""

    process: asyncio.subprocess.Process
    url: str
    data: Path
    drive: DriveProcess
    page: httpx.AsyncClient
    patient: int = 0
    session: int = 0
    loop_port: int = 0
    """Where the loop in a thread of the service hears sensors, if there is one."""
    ticks: list[ShortTick] = field(default_factory=list)
    _watching: asyncio.Task[None] | None = None

    @property
    def cookie(self) -> str:
        """What a page of the same person sends."""
        return "; ".join(f"{name}={value}" for name, value in self.page.cookies.items())

    @property
    def station(self) -> psutil.Process:
        """The station's process.

        Raises:
            MachineError: there is none.
        """
        for child in psutil.Process(self.process.pid).children():
            if any("station_process" in word for word in child.cmdline()):
                return child
        raise MachineError("the service has no station")

    async def open_session(self) -> None:
        """Open a session for the demonstration's patient."""
        form = {"patient_id": self.patient, "confirmed_affected_side": "left"}
        opened = await self.page.post("/api/sessions", json=form)
        self.session = opened.raise_for_status().json()["id"]

    async def end_session(self) -> None:
        """End the open session."""
        ended = await self.page.post(f"/api/sessions/{self.session}/end", json={})
        ended.raise_for_status()

    async def heard_again(self) -> None:
        """Wait for a station that has been started again."""
        heard = len(self.ticks)
        await until(lambda: len(self.ticks) > heard + 10, START_WITHIN_S)

    async def control(self, action: str, page: httpx.AsyncClient | None = None) -> bool:
        """Ask as the buttons do; whether it was granted."""
        asked = page or self.page
        answer = await asked.post(f"/api/sessions/{self.session}/control", json={"action": action})
        return answer.status_code == httpx.codes.OK

    def another_page(self) -> httpx.AsyncClient:
        """A page of the same person that has no connection yet."""
        headers = {"Mirrorlimb-Client": "another", "Cookie": self.cookie}
        return httpx.AsyncClient(base_url=self.url, timeout=20, trust_env=False, headers=headers)

    async def engaged(self) -> None:
        """Bring the arm to follow, as often as a busy machine makes that necessary.

        Raises:
            MachineError: it does not come to that.
        """
        ends_s = time.monotonic() + ENGAGED_WITHIN_S
        while time.monotonic() < ends_s:
            tick = self.ticks[-1]
            if tick.state is DriveState.ENGAGED:
                return
            if tick.state in WAYS_ON:
                await self.control(WAYS_ON[tick.state])
            await asyncio.sleep(0.02)
        raise MachineError(f"the arm does not follow: {self.ticks[-1].state} {self.ticks[-1].blockers}")

    @property
    def limits(self) -> tuple[JointLimits, ...]:
        """Of the patient."""
        return self.ticks[-1].limits

    def heard(self) -> tuple[DriveState | None, str]:
        """What the page shows; where the service or the page is gone, the reason that came with the drive's command."""
        if self.process.returncode is not None or self._watching is None or self._watching.done():
            return None, self.drive.log.notes()[-1].reason
        return self.ticks[-1].state, self.ticks[-1].reason

    def decided_after_s(self, since_s: float) -> float | None:
        """From a moment to the first command that does not follow any more."""
        return told_after_s(self.drive.log.since(since_s), since_s)

    async def mirroring(self) -> None:
        """Wait until the arm follows and moves, as often as a busy machine makes that necessary.

        Raises:
            MachineError: it does not come to that.
        """
        ends_s = time.monotonic() + ENGAGED_WITHIN_S
        while time.monotonic() < ends_s:
            await self.engaged()
            if follows(self.drive.log, MOVING_RAD_S):
                return
            await asyncio.sleep(0.01)
        raise MachineError("the arm does not move")

    def freeze(self) -> None:
        """SIGSTOP."""
        self.process.send_signal(signal.SIGSTOP)

    def thaw(self) -> None:
        """SIGCONT."""
        self.process.send_signal(signal.SIGCONT)

    async def open_page(self) -> None:
        """Follow the live stream, as an open page does, until it is closed."""
        shown = len(self.ticks)
        self._watching = asyncio.create_task(self._watch())
        await until(lambda: len(self.ticks) > shown)

    async def close_page(self) -> None:
        """Close the page."""
        if self._watching is not None:
            self._watching.cancel()
            await asyncio.gather(self._watching, return_exceptions=True)

    async def _watch(self) -> None:
        address = f"{self.url.replace('http', 'ws')}/api/stream?client={PAGE}"
        async with connect(address, additional_headers={"Cookie": self.cookie}, proxy=None) as socket:
            with suppress(ConnectionClosed):
                async for text in socket:
                    self.ticks.append(_message_from(text).tick)
                    await socket.send(acknowledged(self.ticks[-1]))


@asynccontextmanager
async def live_service(data: Path, loop_drive: DriveProcess | None = None) -> AsyncIterator[LiveService]:
    """The demonstration with an open session, while the block lasts.

    Args:
        data: an empty folder.
        loop_drive: runs the station's loop in a thread of the service too, on this drive.
    """
    async with AsyncExitStack() as stack:
        drive = stack.enter_context(running_drive(data))
        process = await _started(data, drive, loop_drive)
        stack.push_async_callback(_ended, process)
        loop_port = int(await _line(process)) if loop_drive else 0
        url = (await _line(process)).decode().strip()
        headers = {"Mirrorlimb-Client": PAGE}
        page = httpx.AsyncClient(base_url=url, timeout=20, trust_env=False, headers=headers)
        await stack.enter_async_context(page)
        service = LiveService(process, url, data, drive, page, loop_port=loop_port)
        patient = (await page.post("/api/demo")).raise_for_status().json()["patient"]
        stack.push_async_callback(service.close_page)
        await service.open_page()
        service.patient = patient["id"]
        await service.open_session()
        yield service


async def _started(data: Path, drive: DriveProcess, loop_drive: DriveProcess | None) -> asyncio.subprocess.Process:
    environment = {**os.environ, ADDRESS: str(drive.address), INSIDE_FILE: str(data / "inside.json")}
    command: tuple[str, ...] = (sys.executable, *SERVICE, "--data", str(data / "service"))
    if loop_drive:
        command = (*command, "--loop-drive", str(loop_drive.address))
    return await asyncio.create_subprocess_exec(*command, stdout=asyncio.subprocess.PIPE, env=environment)


async def _line(process: asyncio.subprocess.Process) -> bytes:
    line = await asyncio.wait_for(process.stdout.readline(), START_WITHIN_S) if process.stdout else b""
    if not line:
        raise MachineError("the service did not start; it has said why on the error output")
    return line


async def _ended(process: asyncio.subprocess.Process) -> None:
    if process.returncode is None:
        process.send_signal(signal.SIGCONT)
        process.terminate()
        await asyncio.wait_for(process.wait(), 20)


async def until(right: Callable[[], bool], within_s: float = 20.0) -> None:
    """Wait until something is so.

    Raises:
        TimeoutError: it did not become so.
    """
    async with asyncio.timeout(within_s):
        while not right():
            await asyncio.sleep(0.01)
