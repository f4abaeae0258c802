"""The loop cranked by hand: scripted sensors and mailbox, simulated time, everything else real."""

from __future__ import annotations

from collections.abc import Callable
from itertools import count
from pathlib import Path
from typing import TypeVar

import msgspec
from station_samples import patient_limits

from fusion.formats.registry import dialect_named
from fusion.messages import Packet, SkeletonSample
from fusion.pipeline import PipelineSettings
from fusion.skeleton import Side
from fusion.virtual_patient.anatomy import ArmPose
from fusion.virtual_patient.patient import PoseGoal, VirtualPatient
from fusion.virtual_patient.trial import sensors_for
from server.config import StationConfig
from server.messages import AnyEvent, Heartbeat, LiveTick, OpenSession, Pain, Stop, Wish, WishAnswer
from server.station.demonstration import Demonstration
from server.station.exo.simulated import SimulatedDrive
from server.station.loop import Loop
from server.station.perception import Perception
from server.station.sources.source import Losses

DT_S = 0.01
Event = TypeVar("Event")
_decode = msgspec.msgpack.Decoder(AnyEvent).decode


class ScriptedSource:
    """A source that gives what a test put into it."""

    losses = Losses()

    def __init__(self) -> None:
        self.ports = {"any": 0}
        self.waiting: list[Packet] = []

    def drain(self) -> list[Packet]:
        packets, self.waiting = self.waiting, []
        return packets


class ScriptedMailbox:
    """The station's channels, without sockets."""

    def __init__(self) -> None:
        self.wanted: list[Wish] = []
        self.told: list[AnyEvent] = []
        self.published = 0
        self.paused = False

    def stops(self) -> list[Wish]:
        return self._taken(lambda wish: isinstance(wish, Stop | Pain))

    def wishes(self) -> list[Wish]:
        return self._taken(lambda wish: not isinstance(wish, Stop | Pain))

    def publish(self, tick: bytes) -> None:
        self.published += 1

    def tell(self, event: bytes) -> None:
        self.told.append(_decode(event))

    def pause_demonstration(self, paused: bool) -> None:
        self.paused = paused

    def _taken(self, wanted: Callable[[Wish], bool]) -> list[Wish]:
        taken = [wish for wish in self.wanted if wanted(wish)]
        self.wanted = [wish for wish in self.wanted if not wanted(wish)]
        return taken


class HandCranked:
    """A loop with a virtual patient before two sensors, in simulated time."""

    def __init__(self, demonstration: Demonstration | None = None, addresses: tuple[str, str] = ("s1", "s2")) -> None:
        self.config = StationConfig()
        self.source, self.mailbox = ScriptedSource(), ScriptedMailbox()
        self.drive = SimulatedDrive(self.config.exoskeleton)
        self.now_s = 100.0
        self.loop = Loop(
            self.config,
            self.source,
            Perception(PipelineSettings(Side.LEFT)),
            self.drive,
            self.mailbox,  # type: ignore[arg-type]  # has the methods that are called
            demonstration,
            clock=lambda: self.now_s,
        )
        self.addresses = addresses
        self.dialect = dialect_named("kinectv2-osc")
        self.patient = VirtualPatient(Side.RIGHT, 3)
        self.sensors = sensors_for(Side.RIGHT, 3)
        self.seeing, self.beating = [True, True], True
        self.goal: PoseGoal | None = None
        self.ticks: list[LiveTick] = []
        self._numbers = count(1)

    @property
    def last(self) -> LiveTick:
        return self.ticks[-1]

    def run(self, seconds: float) -> LiveTick:
        for _ in range(round(seconds / DT_S)):
            self.tick()
        return self.last

    def tick(self) -> LiveTick:
        self.now_s += DT_S
        positions = self.patient.step(DT_S, self.goal, ArmPose(*self.drive.read(self.now_s).angle_rad))
        for k, sensor in enumerate(self.sensors):
            sample = sensor.see(positions, self.patient.t_s)
            if sample is not None and self.seeing[k]:
                self.send(self.addresses[k], sample)
        if self.beating:
            self.mailbox.wanted.append(Heartbeat(number=0, authority="test"))
        self.ticks.append(self.loop.step(self.now_s))
        return self.last

    def send(self, address: str, sample: SkeletonSample) -> None:
        for datagram in self.dialect.encode(sample, 0):
            self.source.waiting.append(Packet(address, self.now_s - 0.003, datagram))

    def ask(self, make: Callable[..., Wish], **fields: object) -> WishAnswer:
        number = next(self._numbers)
        self.mailbox.wanted.append(make(number=number, **fields))
        self.tick()
        return next(e for e in self.mailbox.told if isinstance(e, WishAnswer) and e.number == number)

    def open(self, recording: Path | str = "", **change: object) -> WishAnswer:
        return self.ask(OpenSession, **{**self.opening(), "recording": str(recording), **change})

    @staticmethod
    def opening() -> dict[str, object]:
        """What a session is usually opened with."""
        return {
            "session": "7",
            "patient": "P-7",
            "healthy_side": Side.RIGHT,
            "side_confirmed": True,
            "limits": patient_limits(),
            "limits_set_by": "therapist",
            "recording": "",
        }

    def told(self, kind: type[Event]) -> list[Event]:
        return [event for event in self.mailbox.told if isinstance(event, kind)]
