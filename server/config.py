"""The configuration of `mirrorlimb serve`: typed, read once at the door, each part handed only its own piece."""

from __future__ import annotations

import re
import tomllib
from math import isfinite
from pathlib import Path
from typing import Annotated, Any, TypeVar

import msgspec
from msgspec import Meta

from fusion.errors import InputError
from server.messages import EXO_JOINTS, JointLimits

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


def _device_limits() -> tuple[JointLimits, ...]:
    ranges = ((-0.7, 2.3), (-0.1, 2.6), (-1.6, 1.6), (-0.1, 2.6))
    return tuple(
        JointLimits(joint=joint, min_rad=low, max_rad=high, velocity_rad_s=2.0, acceleration_rad_s2=10.0)
        for joint, (low, high) in zip(EXO_JOINTS, ranges, strict=True)
    )


class StationConfig(msgspec.Struct, frozen=True, kw_only=True, forbid_unknown_fields=True):
    """What the real-time process needs to know."""

    rate_hz: Annotated[int, Meta(ge=20, le=1000)] = 100
    """Ticks a second."""
    drive: str = "simulated"
    """Drive family, a name of `server.station.exo.drives`."""
    method: str = "set-membership"
    """How the sensors are fused."""
    reference: str | None = None
    """Sensor whose frame is the room; None = the first that is seen."""
    sensors: SensorsConfig = SensorsConfig()
    gate: GateConfig = GateConfig()
    device: tuple[JointLimits, ...] = msgspec.field(default_factory=_device_limits)
    """What the exoskeleton itself may do; a patient's limits lie inside (SR-1)."""


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
    demo: bool = False
    station: StationConfig = StationConfig()


Form = TypeVar("Form", Config, StationStart)


def default_data_folder(demo: bool) -> Path:
    """The folder for data where none is named; the demonstration has one of its own."""
    return Path.home() / ".local" / "share" / ("mirrorlimb-demo" if demo else "mirrorlimb")


def read_config(path: Path) -> Config:
    """Read a configuration file (TOML).

    Raises:
        InputError: the file cannot be read, or a key or value in it cannot be used; names file and key.
    """
    config = _read(path, Config)
    _check_station(config.station, path)
    return config


def read_start(path: Path) -> StationStart:
    """Read what the service wrote for the station (JSON or TOML).

    Raises:
        InputError: the file cannot be read, or a key or value in it cannot be used; names file and key.
    """
    start = _read(path, StationStart)
    _check_station(start.station, path)
    return start


def write_start(start: StationStart, path: Path) -> None:
    """Write the station's start file (JSON), readable by this account only."""
    path.touch(mode=0o600)
    path.write_bytes(msgspec.json.encode(start))


def _read(path: Path, form: type[Form]) -> Form:
    try:
        text = path.read_text("utf-8")
    except (OSError, UnicodeDecodeError) as error:
        why = error.strerror if isinstance(error, OSError) else "it is not UTF-8 text"
        raise InputError(f"The configuration '{path}' cannot be read: {why}", "a TOML file", "check --config") from None
    try:
        content = msgspec.json.decode(text) if path.suffix == ".json" else tomllib.loads(text)
        return msgspec.convert(content, form)
    except msgspec.ValidationError as error:
        raise _bad_value(path, str(error), form) from None
    except (tomllib.TOMLDecodeError, msgspec.DecodeError) as error:
        raise InputError(f"'{path}' is not well-formed: {error}", "TOML, as in docs/station.md") from None


def _bad_value(path: Path, message: str, form: type[Form]) -> InputError:
    """Turn "Expected `int`, got `str` - at `$.station.rate_hz`" into a sentence that names file and key."""
    expected, _, place = message.partition(" - at ")
    inside = place.strip("`").removeprefix("$").lstrip(".")
    unknown = re.match(r"Object contains unknown field `(.+)`", expected)
    if unknown:
        known = ", ".join(field.name for field in msgspec.structs.fields(_form_at(form, inside)))
        key = f"{inside}.{unknown[1]}".lstrip(".")
        return InputError(f"'{path}': there is no key '{key}'", f"one of {known}")
    return InputError(
        f"'{path}': the value of '{inside or 'the file'}' cannot be used", expected.removeprefix("Expected ")
    )


def _form_at(form: type[Any], inside: str) -> type[Any]:
    for name in filter(None, re.sub(r"\[.*?\]", "", inside).split(".")):
        inner = next(field.type for field in msgspec.structs.fields(form) if field.name == name)
        form = JointLimits if inner == tuple[JointLimits, ...] else inner
    return form


def _check_station(station: StationConfig, path: Path) -> None:
    _check_device(station.device, path)
    numbers = msgspec.structs.asdict(station.gate)
    endless = [key for key, value in numbers.items() if not isfinite(value)]
    if endless:
        raise InputError(f"'{path}': station.gate.{endless[0]} is not finite", "a number")
    for slow, hold in (("slow_from_rad", "hold_from_rad"), ("slow_from_s", "stale_s")):
        if numbers[slow] >= numbers[hold]:
            raise InputError(f"'{path}': station.gate.{slow} is not below {hold}", "slower first, then held")


def _check_device(device: tuple[JointLimits, ...], path: Path) -> None:
    joints = tuple(limits.joint for limits in device)
    if joints != EXO_JOINTS:
        raise InputError(
            f"'{path}': station.device names the joints {', '.join(joints) or '(none)'}",
            f"each of {', '.join(EXO_JOINTS)}, once, in this order",
        )
    for limits in device:
        numbers = (limits.min_rad, limits.max_rad, limits.velocity_rad_s, limits.acceleration_rad_s2)
        if not all(map(isfinite, numbers)) or limits.min_rad >= limits.max_rad or min(numbers[2:]) <= 0:
            raise InputError(
                f"'{path}': station.device: the limits of '{limits.joint}' leave no movement",
                "min_rad below max_rad, velocity_rad_s and acceleration_rad_s2 above 0",
            )
