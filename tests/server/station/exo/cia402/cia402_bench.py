"""Emulated drives on python-can's virtual bus, in a thread, and a station's ticks in real time."""

from __future__ import annotations

import threading
import time
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from dataclasses import dataclass, field
from itertools import count

import can
import msgspec

from server.emulated.cia402.control import obey
from server.emulated.cia402.node import EmulatedNode
from server.emulated.cia402.serve import Emulator
from server.exoskeleton import BUILT_IN, Cia402Settings, Exoskeleton
from server.station.exo.cia402 import Cia402Drive
from server.station.exo.driver import ZERO, DriveCommand, DriveMode, DriveReading

HEARTBEAT_S = 0.5
"""Longer than in life: a busy machine is not a dead one."""
_channels = count()


def four_joints(**settings: object) -> Exoskeleton:
    """The built-in device's first four joints, each with a node; the elbow turns the other way."""
    joints = [msgspec.structs.replace(joint, node=i + 1) for i, joint in enumerate(BUILT_IN.joints[:4])]
    joints[3] = msgspec.structs.replace(joints[3], sign=-1, offset_rad=0.2, min_rad=-2.4, max_rad=0.3)
    bus = {"interface": "virtual", "channel": f"cia402-{next(_channels)}", "heartbeat_s": HEARTBEAT_S}
    return msgspec.structs.replace(
        BUILT_IN, drive="cia402", joints=tuple(joints), cia402=Cia402Settings(**{**bus, **settings})
    )


@dataclass
class Bench:
    """Emulated drives that run, and everything that was on their bus."""

    exoskeleton: Exoskeleton
    nodes: dict[str, EmulatedNode]
    heard: list[can.Message] = field(default_factory=list)
    _orders: list[str] = field(default_factory=list)

    def order(self, line: str) -> None:
        """Ask the emulation for something; done when this returns."""
        self._orders.append(line)
        while self._orders:
            time.sleep(0.001)

    def do_orders(self) -> None:
        """In the emulation's thread."""
        while self._orders:
            assert obey(self._orders[0], self.nodes) == ""
            self._orders.pop(0)

    def states(self) -> set[str]:
        return {node.drive.state.value for node in self.nodes.values()}

    def angles(self) -> dict[str, float]:
        return {name: node.drive.motor.angle_rad for name, node in self.nodes.items()}


@contextmanager
def emulated(exoskeleton: Exoskeleton) -> Iterator[Bench]:
    """Run the drives of an exoskeleton until the block ends."""
    ended = threading.Event()
    with can.Bus(interface="virtual", channel=exoskeleton.cia402.channel) as bus:
        emulator = Emulator(exoskeleton, bus)
        bench = Bench(exoskeleton, emulator.nodes)

        def run() -> None:
            while not ended.is_set():
                emulator.cycle()
                bench.do_orders()

        thread = threading.Thread(target=run)
        thread.start()
        try:
            yield bench
        finally:
            ended.set()
            thread.join()


@contextmanager
def listening(channel: str) -> Iterator[list[can.Message]]:
    """Everything that is sent on a bus."""
    heard: list[can.Message] = []
    with can.Bus(interface="virtual", channel=channel) as bus:
        yield heard
        while (message := bus.recv(0)) is not None:
            heard.append(message)


def hold(reading: DriveReading) -> DriveCommand:
    return DriveCommand(DriveMode.HOLD, reading.angle_rad, ZERO, "held by the test")


def follow(angle_rad: tuple[float, ...], **more: object) -> DriveCommand:
    return DriveCommand(DriveMode.FOLLOW, angle_rad, ZERO, "", **more)


def tick(
    drive: Cia402Drive,
    seconds: float,
    decide: Callable[[DriveReading, float], DriveCommand] = lambda reading, _: hold(reading),
    until: Callable[[DriveReading], bool] = lambda _: False,
) -> list[DriveReading]:
    """The station's ticks at 100 Hz by the real clock, for so long or until something is read."""
    readings, next_s = [], time.monotonic()
    for index in range(round(seconds * 100)):
        now_s = time.monotonic()
        readings.append(drive.read(now_s))
        if until(readings[-1]):
            break
        drive.command(decide(readings[-1], index * 0.01), now_s)
        next_s = max(next_s + 0.01, time.monotonic() + 0.005)  # slots that were missed are left out, as in life
        time.sleep(max(next_s - time.monotonic(), 0.0))
    return readings


def powered(drive: Cia402Drive, bench: Bench) -> DriveReading:
    """Ticks until every drive is in operation, and the station knows."""
    enabled = {"operation enabled"}
    readings = tick(drive, 5.0, until=lambda reading: bench.states() == enabled and not reading.fault)
    assert bench.states() == enabled, readings[-1].fault
    return tick(drive, 0.03)[-1]


def fault_of(drive: Cia402Drive, seconds: float = 5.0) -> str:
    """Ticks until the drive reports a fault."""
    return tick(drive, seconds, until=lambda reading: bool(reading.fault))[-1].fault
