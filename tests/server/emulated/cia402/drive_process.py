"""Emulated drives in a process of their own, for tests and measurements."""

from __future__ import annotations

import socket
import subprocess
import sys
from collections.abc import Iterator
from contextlib import contextmanager
from dataclasses import dataclass
from pathlib import Path

MOVING_STATION = Path(__file__).with_name("moving_station.py")
HEAD = """
name = "emulated arm"
drive = "cia402"

[cia402]
interface = "socketcand"
channel = "can0"
options = {{ host = "127.0.0.1", port = {port} }}
heartbeat_s = {heartbeat_s}
"""
JOINT = """
[[joints]]
name = "{name}"
follows = "{follows}"
sign = 1
node = {node}
gear_ratio = 100.0
min_rad = {low}
max_rad = 2.3
velocity_rad_s = {speed}
acceleration_rad_s2 = {speed}0.0
torque_nm = 30.0
"""
LED = (("plane", -0.7, 2), ("elevation", -0.1, 2), ("axial_rotation", -3.9, 4), ("elbow", -0.1, 2))
RESTING = ("forearm", "wrist flexion", "wrist deviation")


@dataclass(frozen=True)
class Line:
    """One of the journal's."""

    t_s: float
    joint: str
    angle_rad: float
    velocity_rad_s: float
    state: str


@dataclass(frozen=True)
class Drives:
    """A running emulation."""

    file: Path
    control: Path
    journal: Path
    process: subprocess.Popen[str]

    def lines(self, joint: str) -> list[Line]:
        """What the journal says of a joint."""
        rows = [row.split(",") for row in self.journal.read_text().splitlines()[1:]]
        return [Line(float(r[0]), r[1], float(r[2]), float(r[3]), r[4]) for r in rows if len(r) == 5 and r[1] == joint]


@contextmanager
def drives_in(folder: Path, heartbeat_s: float, resting: tuple[str, ...] = ()) -> Iterator[Drives]:
    """Run the drives of an arm, with files in a folder, until the block ends."""
    file = folder / "exoskeleton.toml"
    file.write_text(_text(heartbeat_s, resting))
    drives = (file, folder / "orders", folder / "journal.csv")
    command = [sys.executable, "-m", "server.emulated.cia402", str(file)]
    places = ["--control", str(drives[1]), "--journal", str(drives[2])]
    with subprocess.Popen([*command, *places], stdout=subprocess.PIPE, text=True) as process:
        assert process.stdout.readline() == "listening\n"
        try:
            yield Drives(*drives, process)
        finally:
            process.terminate()


@contextmanager
def moving_station(drives: Drives) -> Iterator[subprocess.Popen[str]]:
    """A station process that moves them until it is killed."""
    command = [sys.executable, str(MOVING_STATION), str(drives.file)]
    with subprocess.Popen(command, stdout=subprocess.PIPE, text=True) as station:
        assert station.stdout.readline() == "ticking\n"
        try:
            yield station
        finally:
            station.kill()


def _text(heartbeat_s: float, resting: tuple[str, ...]) -> str:
    with socket.create_server(("127.0.0.1", 0)) as probe:
        text = HEAD.format(port=probe.getsockname()[1], heartbeat_s=heartbeat_s)
    for node, (name, low, speed) in enumerate(LED, start=1):
        text += JOINT.format(name=name, follows=name, node=node, low=low, speed=speed)
    for node, name in enumerate(resting, start=len(LED) + 1):
        text += JOINT.format(name=name, follows="none", node=node, low=-1.0, speed=2)
    return text
