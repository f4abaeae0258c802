"""A virtual patient who never rests, before two virtual cameras whose wires can be cut, in real time."""

from __future__ import annotations

import socket
import threading
import time
from itertools import cycle
from typing import Final, Self

from fusion.formats.registry import dialect_named
from fusion.messages import SkeletonSample
from fusion.skeleton import Side
from fusion.virtual_patient.anatomy import ArmPose
from fusion.virtual_patient.patient import PoseGoal, VirtualPatient
from fusion.virtual_patient.trial import sensors_for
from server.experiments.rig.wires import Wire, whole

STEP_S: Final = 1 / 120
GOAL_S: Final = 0.9
"""Long enough to arrive, short enough that the arm is nearly always under way."""
POSES: Final = (ArmPose(0.9, 0.75, 0.2, 1.35), ArmPose(0.6, 0.35, 0.0, 0.75), ArmPose(1.1, 0.9, 0.1, 0.9))
SENSORS: Final = ("127.0.0.1", "127.0.0.2")
LONGEST_PAUSE_S: Final = 0.25


class LivePatient:
    """Moves and is seen while the block lasts.

    Args:
        port: where the station listens for `kinectv2-osc`.
        seed: of patient and cameras.
    """

    def __init__(self, port: int, seed: int) -> None:
        self._patient = VirtualPatient(Side.RIGHT, seed)
        self._cameras = sensors_for(Side.RIGHT, seed)
        self._dialect = dialect_named("kinectv2-osc")
        self._sockets = [_socket(address, port) for address in SENSORS]
        self.wires: list[Wire] = [whole, whole]
        """What happens to each camera's datagrams; replace one to break it."""
        self._ended = threading.Event()
        self._thread = threading.Thread(target=self._live, name="patient", daemon=True)

    def __enter__(self) -> Self:
        self._thread.start()
        return self

    def __exit__(self, *_: object) -> None:
        self._ended.set()
        self._thread.join()
        for opened in self._sockets:
            opened.close()

    def mend(self) -> None:
        """Every wire is whole again."""
        self.wires = [whole, whole]

    def _live(self) -> None:
        poses = cycle(POSES)
        goal, until_s, due_s = PoseGoal(next(poses)), time.monotonic() + GOAL_S, time.monotonic()
        while not self._ended.wait(max(due_s - time.monotonic(), 0.0)):
            now_s = time.monotonic()
            if now_s > until_s:
                goal, until_s = PoseGoal(next(poses)), now_s + GOAL_S
            self._step(goal)
            due_s = max(due_s + STEP_S, now_s - LONGEST_PAUSE_S)

    def _step(self, goal: PoseGoal) -> None:
        positions = self._patient.step(STEP_S, goal)
        for camera, sensor in enumerate(self._cameras):
            sample = sensor.see(positions, self._patient.t_s)
            if sample is not None:
                self._send(camera, sample)

    def _send(self, camera: int, sample: SkeletonSample) -> None:
        wire = self.wires[camera]
        for datagram in self._dialect.encode(sample, 0):
            for arriving in wire(datagram):
                try:
                    self._sockets[camera].send(arriving)
                except OSError:
                    return  # nobody listens just now; the next frame is as good


def _socket(address: str, port: int) -> socket.socket:
    opened = socket.socket(socket.AF_INET, socket.SOCK_DGRAM)
    opened.bind((address, 0))
    opened.connect(("127.0.0.1", port))
    opened.setblocking(False)
    return opened
