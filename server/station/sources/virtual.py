"""The demonstration's sensors: a virtual patient before two virtual cameras that send real OSC over real UDP."""

from __future__ import annotations

import argparse
import os
import socket
import sys
import time
from collections.abc import Sequence
from math import pi
from pathlib import Path

from fusion.errors import MachineError, MirrorlimbError
from fusion.formats.registry import dialect_named
from fusion.messages import SkeletonSample
from fusion.skeleton import Side
from fusion.virtual_patient.anatomy import ArmPose
from fusion.virtual_patient.patient import HandGoal, VirtualPatient
from fusion.virtual_patient.sensor import SensorPose, VirtualSensor
from server.channels import DemonstrationChannels
from server.messages import EXO_JOINTS, DemoGoal
from server.station.demonstration import ADDRESSES

STEP_S = 1 / 60
SECOND_LATE_S = 0.02
"""The second sensor's frames are under way for so long: a clock offset that alignment has to find."""
APART_RAD = pi / 2 - 0.07
"""Near 90°, as people mount things."""
SEED = 7
LONGEST_PAUSE_S = 0.25
"""A process that was stopped for longer does not try to catch up."""


class VirtualStage:
    """The patient, the two cameras and their sockets.

    Args:
        host: where the station listens.
        port: its port for `kinectv2-osc`.

    Raises:
        MachineError: the loopback addresses cannot be used.
    """

    def __init__(self, host: str, port: int) -> None:
        self._dialect = dialect_named("kinectv2-osc")
        self._sockets = tuple(_socket(address, host, port) for address in ADDRESSES)
        self._under_way: list[tuple[float, int, SkeletonSample]] = []
        self._sequence = 0
        self._goal = DemoGoal(hand_in_trunk=None)
        self._patient = VirtualPatient(Side.RIGHT, SEED)
        self._cameras = (
            VirtualSensor("virtual-1", SensorPose.around(0.0), SEED),
            VirtualSensor("virtual-2", SensorPose.around(APART_RAD, 1.9, 0.9, 0.02), SEED + 1, body="2"),
        )

    def take(self, goal: DemoGoal) -> None:
        """Where the patient should reach now; another healthy side is another patient before the same cameras."""
        if goal.healthy_side is not self._patient.healthy_side:
            t_s = self._patient.t_s
            self._patient = VirtualPatient(goal.healthy_side, SEED)
            self._patient.t_s = t_s
        self._goal = goal

    def step(self, dt_s: float, speaking: bool) -> None:
        """Live on; the cameras send what is due, unless they are to be silent."""
        goal = self._goal
        affected = ArmPose(*goal.exo_rad) if len(goal.exo_rad) == len(EXO_JOINTS) else None
        reach = None if goal.hand_in_trunk is None else HandGoal(goal.hand_in_trunk)
        positions = self._patient.step(dt_s, reach, affected)
        now_s = self._patient.t_s
        for camera, sensor in enumerate(self._cameras):
            sample = sensor.see(positions, now_s)
            if sample is not None:
                self._under_way.append((now_s + camera * SECOND_LATE_S, camera, sample))
        due = [entry for entry in self._under_way if entry[0] <= now_s]
        self._under_way = [entry for entry in self._under_way if entry[0] > now_s]
        for _, camera, sample in due if speaking else ():
            self._send(camera, sample)

    def close(self) -> None:
        """Close the sockets."""
        for opened in self._sockets:
            opened.close()

    def _send(self, camera: int, sample: SkeletonSample) -> None:
        self._sequence += 1
        for datagram in self._dialect.encode(sample, self._sequence):
            try:
                self._sockets[camera].send(datagram)
            except OSError:
                return  # nobody listens just now; the next frame is as good


def play(stage: VirtualStage, channels: DemonstrationChannels, parent: int) -> None:
    """Run in real time until the process that started this one has gone."""
    due_s = time.monotonic()
    while os.getppid() == parent:
        goal = channels.goal()
        if goal is not None:
            stage.take(goal)
        stage.step(STEP_S, speaking=not channels.is_paused())
        due_s += STEP_S
        wait_s = due_s - time.monotonic()
        if wait_s > 0:
            time.sleep(wait_s)
        elif wait_s < -LONGEST_PAUSE_S:
            due_s = time.monotonic()


def main(arguments: Sequence[str] | None = None) -> int:
    """Entry point of the demonstration's own process."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--channels", type=Path, required=True, help="private folder of the channels")
    parser.add_argument("--host", required=True, help="where the station listens")
    parser.add_argument("--port", type=int, required=True, help="its port for kinectv2-osc")
    parser.add_argument("--parent", type=int, required=True, help="process to end with")
    options = parser.parse_args(arguments)
    try:
        channels, stage = DemonstrationChannels(options.channels), VirtualStage(options.host, options.port)
    except MirrorlimbError as error:
        print(f"mirrorlimb: {error}", file=sys.stderr)
        return 2
    play(stage, channels, options.parent)
    stage.close()
    channels.close()
    return 0


def _socket(address: str, host: str, port: int) -> socket.socket:
    opened = socket.socket(socket.AF_INET, socket.SOCK_DGRAM)
    try:
        opened.bind((address, 0))
        opened.connect((host, port))
    except OSError as error:
        opened.close()
        raise MachineError(
            f"The demonstration's sensors cannot send from {address} to {host}: {error.strerror}",
            "a loopback interface that has every address of 127.0.0.0/8",
            f"on macOS: sudo ifconfig lo0 alias {address}",
        ) from None
    opened.setblocking(False)
    return opened


if __name__ == "__main__":
    sys.exit(main())
