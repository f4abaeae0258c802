"""The loop cranked by hand with a virtual patient before two sensors: simulated time, everything else real."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path

from station_samples import patient_limits

from fusion.formats.registry import dialect_named
from fusion.messages import Packet, SkeletonSample
from fusion.skeleton import Side
from fusion.virtual_patient.anatomy import ArmPose
from fusion.virtual_patient.patient import PoseGoal, VirtualPatient
from fusion.virtual_patient.trial import sensors_for
from server.config import StationConfig
from server.experiments.cranked.station import DT_S, CrankedStation
from server.messages import LiveTick, OpenSession, Wish, WishAnswer
from server.station.demonstration import Demonstration
from server.station.exo.simulated import SimulatedDrive
from server.station.exo.simulated_arm.person import Spasticity


class HandCranked(CrankedStation):
    """A cranked station that keeps its ticks."""

    def __init__(
        self,
        demonstration: Demonstration | None = None,
        addresses: tuple[str, str] = ("s1", "s2"),
        spasticity: Spasticity | None = None,
    ) -> None:
        self.config = StationConfig()
        self.drive = SimulatedDrive(self.config.exoskeleton, spasticity=spasticity)
        super().__init__(self.config, self.drive, demonstration)
        self.addresses = addresses
        self.dialect = dialect_named("kinectv2-osc")
        self.patient = VirtualPatient(Side.RIGHT, 3)
        self.sensors = sensors_for(Side.RIGHT, 3)
        self.seeing = [True, True]
        self.goal: PoseGoal | None = None
        self.ticks: list[LiveTick] = []

    @property
    def last(self) -> LiveTick:
        return self.ticks[-1]

    def run(self, seconds: float) -> LiveTick:
        for _ in range(round(seconds / DT_S)):
            self.tick()
        return self.last

    def tick(self) -> LiveTick:
        positions = self.patient.step(DT_S, self.goal, ArmPose(*self.drive.read(self.now_s + DT_S).angle_rad))
        for k, sensor in enumerate(self.sensors):
            sample = sensor.see(positions, self.patient.t_s)
            if sample is not None and self.seeing[k]:
                self.send(self.addresses[k], sample)
        self.ticks.append(self.step())
        return self.last

    def send(self, address: str, sample: SkeletonSample) -> None:
        for datagram in self.dialect.encode(sample, 0):
            self.source.waiting.append(Packet(address, self.now_s + DT_S - 0.003, datagram))

    def ask(self, make: Callable[..., Wish], **fields: object) -> WishAnswer:
        number = self.wish(make, **fields)
        self.tick()
        return self.answer(number)

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
