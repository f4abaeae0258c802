"""The scene with emulated CiA 402 drives on a CAN bus, a process of their own; the station is the unchanged one."""

from __future__ import annotations

import socket
import subprocess
import sys
import time
from collections.abc import AsyncIterator, Iterator
from contextlib import AsyncExitStack, asynccontextmanager, closing, contextmanager
from pathlib import Path
from typing import Final

import msgspec

from fusion.errors import MachineError
from server.config import SensorsConfig, StationConfig
from server.emulated.cia402.bridge import LOOPBACK
from server.exoskeleton import BUILT_IN, Cia402Settings, Exoskeleton
from server.experiments.rig.drive_log import DriveLog, Note
from server.experiments.rig.live_station import PORT, LiveStation
from server.experiments.rig.patient import LivePatient
from server.experiments.rig.scene import MOVING_RAD_S, SEED, DriveProcess, Scene
from server.experiments.rig.station_process import SteppedClock
from server.station.exo.joint_map import JointMap

JOINTS: Final = 4
START_WITHIN_S: Final = 20.0


def four_joints(port: int) -> Exoskeleton:
    """The built-in device's joints that follow an angle, each with a node; the elbow turns the other way."""
    joints = [msgspec.structs.replace(joint, node=k + 1) for k, joint in enumerate(BUILT_IN.joints[:JOINTS])]
    elbow = {"sign": -1, "offset_rad": 0.2, "min_rad": -2.4, "max_rad": 0.3}
    joints[3] = msgspec.structs.replace(joints[3], **elbow)
    bus = Cia402Settings(interface="socketcand", channel="emulated", options={"host": LOOPBACK, "port": port})
    return msgspec.structs.replace(BUILT_IN, drive="cia402", joints=tuple(joints), cia402=bus)


class JournalLog(DriveLog):
    """The emulated drives' own journal, joint by joint, as notes in anatomical angles.

    Args:
        path: of the journal.
        exoskeleton: whose joints it names.
    """

    def __init__(self, path: Path, exoskeleton: Exoskeleton) -> None:
        super().__init__(path)
        self._map = JointMap(exoskeleton)
        self._rows: list[list[bytes]] = []

    def _noted(self, lines: list[bytes]) -> list[Note]:
        """A moment is one line per joint; the journal's first line is a heading."""
        self._rows += [line.split(b",") for line in lines if not line.startswith(b"t_s")]
        whole = len(self._rows) // JOINTS * JOINTS
        rows, self._rows = self._rows[:whole], self._rows[whole:]
        return [self._moment(rows[k : k + JOINTS]) for k in range(0, whole, JOINTS)]

    def _moment(self, rows: list[list[bytes]]) -> Note:
        angle_rad, velocity_rad_s = ([float(row[column]) for row in rows] for column in (2, 3))
        at_s = float(rows[0][0])
        angles, speeds = self._map.anatomical_rad(angle_rad), self._map.anatomical_rad_s(velocity_rad_s)
        return Note(at_s, None, False, None, "", angles, speeds)


@asynccontextmanager
async def can_scene(data: Path, moving_rad_s: float = MOVING_RAD_S) -> AsyncIterator[Scene]:
    """A scene with an open session, while the block lasts."""
    async with AsyncExitStack() as stack:
        exoskeleton = four_joints(_free_port())
        drive = stack.enter_context(_running_drives(data, exoskeleton))
        config = StationConfig(sensors=SensorsConfig(ports={PORT: 0}), exoskeleton=exoskeleton)
        station = await stack.enter_async_context(LiveStation(data, config=config))
        patient = stack.enter_context(LivePatient(station.port, SEED))
        answer = await station.ask(station.session(data / "session.mcap"))
        if not answer.accepted:
            raise MachineError(f"no session can be opened: {answer.reason}")
        yield Scene(data, drive, station, patient, SteppedClock(data / "clock"), moving_rad_s)


@contextmanager
def _running_drives(data: Path, exoskeleton: Exoskeleton) -> Iterator[DriveProcess]:
    described, control, journal = data / "exoskeleton.json", data / "can", data / "can.csv"
    described.write_bytes(msgspec.json.encode(exoskeleton))
    words = ["--exoskeleton", str(described), "--control", str(control), "--journal", str(journal)]
    command = [sys.executable, "-m", "server.experiments.rig.can_process", *words]
    process = subprocess.Popen(command, stdin=subprocess.DEVNULL)  # noqa: S603 - our own module
    try:
        _wait_for(journal, process)
        yield DriveProcess(process, control, JournalLog(journal, exoskeleton))
    finally:
        process.kill()
        process.wait()


def _wait_for(journal: Path, process: subprocess.Popen[bytes]) -> None:
    ends_s = time.monotonic() + START_WITHIN_S
    while not journal.exists():
        if process.poll() is not None or time.monotonic() > ends_s:
            raise MachineError("the emulated drives did not start")
        time.sleep(0.01)


def _free_port() -> int:
    with closing(socket.create_server((LOOPBACK, 0))) as listener:
        port: int = listener.getsockname()[1]
        return port
