"""The configuration of `mirrorlimb serve`: typed, read once at the door, each part handed only its own piece."""

from __future__ import annotations

from math import isclose, isfinite
from pathlib import Path
from typing import Annotated, Any

import msgspec
from msgspec import Meta

from fusion.errors import InputError
from server.exoskeleton import BUILT_IN, Exoskeleton, device_limits
from server.exoskeleton_file import check, read_exoskeleton
from server.messages import JointLimits
from server.typed_file import read_content, typed

SEE = "docs/station.md"

Port = Annotated[int, Meta(ge=0, le=65535)]
Seconds = Annotated[float, Meta(gt=0)]
Radians = Annotated[float, Meta(gt=0)]
Count = Annotated[int, Meta(gt=0)]


class SensorsConfig(msgspec.Struct, frozen=True, kw_only=True, forbid_unknown_fields=True):
    """Where sensors may send to, and how much of it is taken (SR-15)."""

    bind: str = "127.0.0.1"
    """Address of the one interface that is listened on. Senders on other machines need this machine's own there."""
    ports: dict[str, Port] = msgspec.field(
        default_factory=lambda: {"kinectv2-osc": 12345, "osceleton2": 7110, "k2s": 9090, "mirrorlimb": 7120}
    )
    """UDP port per dialect; every port takes every dialect. 7120, ours, lies below the ports that systems lend to
    outgoing connections. 0 = any free port."""
    allowed_senders: tuple[str, ...] = ()
    """Addresses or networks ("192.168.7.0/24") whose datagrams are read; empty = everyone who reaches `bind`."""
    datagram_bytes: Annotated[int, Meta(ge=64, le=65507)] = 8192
    """Longer datagrams are refused and counted."""
    datagrams_per_tick: Count = 128
    """At most so many datagrams are read in one tick; the rest wait, and what the kernel cannot keep is counted. One
    body of `kinectv2-osc` is 27 datagrams, so two sensors with two bodies each fit even when all come at once."""


class GateConfig(msgspec.Struct, frozen=True, kw_only=True, forbid_unknown_fields=True):
    """The safety gate's numbers (docs/safety.md)."""

    slow_from_rad: Radians = 0.35
    """A joint whose bound is larger moves slower (SR-4)."""
    hold_from_rad: Radians = 0.7
    """A joint whose bound is this large does not move (SR-4)."""
    slow_from_s: Seconds = 0.067
    """Two frames of 30 Hz: older evidence slows."""
    stale_s: Seconds = 0.1
    """Three frames of 30 Hz: older evidence holds (SR-4); a loop that stood still so long holds too (SR-3)."""
    heartbeat_s: Seconds = 0.25
    """A service silent for longer: hold (SR-9)."""
    resume_within_s: Seconds = 2.0
    """A hold for lost sensors that ends within this time resumes by itself (SR-5)."""
    resume_within_rad: Radians = 0.5
    """... if the target is no further than this from the arm."""
    engage_within_rad: Radians = 1.57
    """Enable and resume are refused while the target is further than this from the arm, in any joint (SR-6)."""
    blend_s: Annotated[float, Meta(ge=2)] = 2.0
    """Least time of the blend-in from the measured position to the target (SR-6)."""
    blend_rad_s: Radians = 0.5
    """Mean speed of the blend-in: where the target is far, it takes longer."""
    soft_margin_rad: Radians = 0.1
    """Commands keep this far inside the patient's range (SR-1)."""
    jerk_time_s: Seconds = 0.04
    """Time in which acceleration may go from none to its limit (SR-2)."""


class StationConfig(msgspec.Struct, frozen=True, kw_only=True, forbid_unknown_fields=True):
    """What the real-time process needs to know."""

    rate_hz: Annotated[int, Meta(ge=20, le=1000)] = 100
    """Ticks a second."""
    exoskeleton: Exoskeleton = BUILT_IN
    """The device. In a configuration file the key holds the path of an exoskeleton file, seen from that file."""
    method: str = "set-membership"
    """How the sensors are fused."""
    reference: str | None = None
    """Sensor whose frame is the room; None = the first that is seen."""
    sensors: SensorsConfig = SensorsConfig()
    gate: GateConfig = GateConfig()

    @property
    def device(self) -> tuple[JointLimits, ...]:
        """What the exoskeleton itself may do; a patient's limits lie inside (SR-1)."""
        return device_limits(self.exoskeleton)


class Config(msgspec.Struct, frozen=True, kw_only=True, forbid_unknown_fields=True):
    """Everything `mirrorlimb serve` can be told by a file; its options override."""

    host: str = "127.0.0.1"
    """Address of the web side."""
    port: Port = 8000
    """Port of the web side."""
    data: str = ""
    """Folder for database, recordings and logs; "" = `default_data_folder`."""
    demo: bool = False
    """Virtual patient, simulated exoskeleton, demonstration account; loopback only."""
    station: StationConfig = StationConfig()


class StationStart(msgspec.Struct, frozen=True, kw_only=True, forbid_unknown_fields=True):
    """What the service writes for `python -m server.station --config FILE`."""

    data: str
    """Data folder; one station per folder."""
    channels: str
    """Private folder of the channels (`server.channels.private_folder`)."""
    service: int = 0
    """Process number of the service; 0 = whoever starts the station. One that died before the station was up is
    noticed by it."""
    demo: bool = False
    station: StationConfig = StationConfig()


def default_data_folder(demo: bool) -> Path:
    """The folder for data where none is named; the demonstration has one of its own."""
    return Path.home() / ".local" / "share" / ("mirrorlimb-demo" if demo else "mirrorlimb")


def read_config(path: Path) -> Config:
    """Read a configuration file (TOML).

    Raises:
        InputError: the file, or the exoskeleton file that it names, cannot be read, or a key or value in it cannot be
            used; names file and key.
    """
    content = read_content(path, "configuration", SEE)
    exoskeleton = _named_exoskeleton(content, path)
    config = typed(content, Config, path)
    if exoskeleton is not None:
        config = msgspec.structs.replace(
            config, station=msgspec.structs.replace(config.station, exoskeleton=exoskeleton)
        )
    _check_station(config.station, path)
    return config


def read_start(path: Path) -> StationStart:
    """Read what the service wrote for the station (JSON or TOML).

    Raises:
        InputError: the file cannot be read, or a key or value in it cannot be used; names file and key.
    """
    start = typed(read_content(path, "start file", SEE), StationStart, path)
    check(start.station.exoskeleton, path)
    _check_station(start.station, path)
    return start


def write_start(start: StationStart, path: Path) -> None:
    """Write the station's start file (JSON), readable by this account only."""
    path.touch(mode=0o600)
    path.write_bytes(msgspec.json.encode(start))


def _named_exoskeleton(content: dict[str, Any], path: Path) -> Exoskeleton | None:
    """Take `station.exoskeleton`, the path of a file beside this one, out of the content and read that file."""
    station = content.get("station")
    if not isinstance(station, dict) or "exoskeleton" not in station:
        return None
    named = station.pop("exoskeleton")
    if not isinstance(named, str):
        raise InputError(f"'{path}': the value of 'station.exoskeleton' cannot be used", "the path of a file, as text")
    return read_exoskeleton(path.parent / named)


def _check_station(station: StationConfig, path: Path) -> None:
    _check_gate(station.gate, path)
    period_s, device = station.exoskeleton.cia402.period_s, station.exoskeleton
    if device.drive == "cia402" and not isclose(period_s * station.rate_hz, 1.0, rel_tol=1e-6):
        raise InputError(
            f"'{path}': the drives of '{device.name}' expect a set-point every {period_s:g} s (cia402.period_s), "
            f"but the station gives {station.rate_hz} a second (station.rate_hz)",
            f"cia402.period_s = {1 / station.rate_hz:g}",
        )


def _check_gate(gate: GateConfig, path: Path) -> None:
    numbers = {key: value for key, value in msgspec.structs.asdict(gate).items() if isinstance(value, float | int)}
    endless = [key for key, value in numbers.items() if not isfinite(value)]
    if endless:
        raise InputError(f"'{path}': station.gate.{endless[0]} is not finite", "a number")
    for slow, hold in (("slow_from_rad", "hold_from_rad"), ("slow_from_s", "stale_s")):
        if numbers[slow] >= numbers[hold]:
            raise InputError(f"'{path}': station.gate.{slow} is not below {hold}", "slower first, then held")
