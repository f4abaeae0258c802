"""A patient who moves, a real station and a drive with a process of its own: what faults are put into."""

from __future__ import annotations

import asyncio
import subprocess
import sys
import time
from collections.abc import AsyncIterator, Callable, Iterator
from contextlib import AsyncExitStack, asynccontextmanager, contextmanager
from dataclasses import dataclass
from itertools import count
from pathlib import Path
from typing import Final

from fusion.errors import MachineError
from server.experiments.rig.drive_link import ADDRESS
from server.experiments.rig.drive_log import DriveLog, follows
from server.experiments.rig.live_station import LiveStation
from server.experiments.rig.patient import LivePatient
from server.experiments.rig.station_process import STEP_FILE, SteppedClock
from server.messages import DriveState, Enable, JointLimits, Reset, Resume, StateChanged, Wish

COMMAND: Final = ("-m", "server.experiments.rig.station_process")
MOVING_RAD_S: Final = 0.3
ENGAGED_WITHIN_S: Final = 60.0
SEED: Final = 3
_WAYS_ON: Final[dict[DriveState, Callable[[int], Wish]]] = {
    DriveState.READY: lambda number: Enable(number=number),
    DriveState.HOLD: lambda number: Resume(number=number),
    DriveState.STOPPED: lambda number: Reset(number=number),
    DriveState.FAULT: lambda number: Reset(number=number),
}


@dataclass
class DriveProcess:
    """The drive's process and what it writes."""

    process: subprocess.Popen[bytes]
    address: Path
    log: DriveLog


@dataclass
class Scene:
    """Everything that a fault may be put into."""

    data: Path
    drive: DriveProcess
    station: LiveStation
    patient: LivePatient
    clock: SteppedClock
    """The station's wall clock."""
    moving_rad_s: float = MOVING_RAD_S
    """A fault is put in while some joint is measured faster than this."""

    @property
    def limits(self) -> tuple[JointLimits, ...]:
        """Of the patient: as wide as the device's."""
        return self.station.config.device

    async def mirroring(self) -> None:
        """Bring the arm to follow the patient, as often as a busy machine makes that necessary.

        Raises:
            MachineError: it does not come to that.
        """
        ends_s = time.monotonic() + ENGAGED_WITHIN_S
        while time.monotonic() < ends_s:
            tick = self.station.last
            if tick.state is DriveState.ENGAGED:
                if follows(self.drive.log, self.moving_rad_s):
                    return
            elif way_on := _WAYS_ON.get(tick.state):
                await self.station.ask(way_on)
            await asyncio.sleep(0.01)
        raise MachineError(f"the arm does not follow: {self.station.last.state} {self.station.last.blockers}")

    def heard(self) -> tuple[DriveState | None, str]:
        """The station's state and reason; None when it is gone."""
        if self.station.process.returncode is not None:
            return None, ""
        return self.station.last.state, self.station.last.reason

    def decided_after_s(self, since_s: float) -> float | None:
        """From a moment to the station's first change of state, by its own clock."""
        changes = (event.t_s for event in self.station.events if isinstance(event, StateChanged))
        return next((t_s - since_s for t_s in changes if t_s >= since_s), None)


@asynccontextmanager
async def scene(data: Path, moving_rad_s: float = MOVING_RAD_S) -> AsyncIterator[Scene]:
    """A scene with an open session, while the block lasts."""
    async with AsyncExitStack() as stack:
        drive = stack.enter_context(running_drive(data))
        clock = SteppedClock(data / "clock")
        environment = {ADDRESS: str(drive.address), STEP_FILE: str(data / "clock")}
        station = await stack.enter_async_context(LiveStation(data, command=COMMAND, environment=environment))
        patient = stack.enter_context(LivePatient(station.port, SEED))
        answer = await station.ask(station.session(data / "session.mcap"))
        if not answer.accepted:
            raise MachineError(f"no session can be opened: {answer.reason}")
        yield Scene(data, drive, station, patient, clock, moving_rad_s)


_drives = count(1)


@contextmanager
def running_drive(data: Path) -> Iterator[DriveProcess]:
    """A drive's process, while the block lasts."""
    number = next(_drives)
    address, log = data / f"drive-{number}", data / f"drive-{number}.log"
    words = ["--address", str(address), "--log", str(log)]
    command = [sys.executable, "-m", "server.experiments.rig.drive_process", *words]
    process = subprocess.Popen(command, stdin=subprocess.DEVNULL)  # noqa: S603 - our own module
    try:
        while not address.exists():
            if process.poll() is not None:
                raise MachineError("the drive's process did not start")
            time.sleep(0.01)
        yield DriveProcess(process, address, DriveLog(log))
    finally:
        process.kill()
        process.wait()
