"""Reads a session's ticks back, only the parts that figures and curves are made of."""

from __future__ import annotations

from itertools import islice
from pathlib import Path

import msgspec

from fusion.errors import RecordingError
from fusion.recording.log_reader import LogReader
from server.messages import Assistance, DriveState, Point

EVERY = 2
"""Every second tick: 50 Hz are enough for every figure, and half the work."""


Joints = tuple[float, float, float, float]


class RecordedArm(msgspec.Struct, frozen=True, gc=False):
    """Of `ArmView`."""

    plane_rad: float
    elevation_rad: float
    rotation_rad: float
    elbow_rad: float
    valid: bool
    points_in_trunk: tuple[Point, Point, Point, Point]


class RecordedExo(msgspec.Struct, frozen=True, gc=False):
    """Of `ExoView`."""

    angle_rad: Joints
    velocity_rad_s: Joints
    torque_nm: Joints
    interaction_nm: tuple[float, ...] = ()
    """Empty in recordings from before it was told, as is `share`."""
    share: tuple[float, ...] = ()
    assistance: Assistance = Assistance.PASSIVE
    level: float = 1.0


class RecordedSensor(msgspec.Struct, frozen=True, gc=False):
    """Of `SensorView`."""

    sensor: str
    frames_per_s: float
    residual_m: float | None
    age_s: float


class RecordedTick(msgspec.Struct, frozen=True):
    """Of `LiveTick`; an hour of whole ticks would fill a small machine's memory."""

    t_s: float
    state: DriveState
    healthy: RecordedArm | None
    exo: RecordedExo
    trunk_lean_m: float
    sensors: tuple[RecordedSensor, ...]
    shoulder_hitch_m: float | None = None
    """None in recordings from before it was told."""


_decoder = msgspec.msgpack.Decoder(RecordedTick)


def read_ticks(recording: Path) -> list[RecordedTick]:
    """The ticks of a recording, also of one that was cut off.

    Raises:
        RecordingError: it cannot be read, or holds no tick.
    """
    try:
        ticks = [_decoder.decode(entry.data) for entry in islice(LogReader(recording).ticks(), None, None, EVERY)]
    except msgspec.MsgspecError as error:
        raise RecordingError(f"{recording}: a tick cannot be read ({error})", "ticks of this version") from None
    if not ticks:
        raise RecordingError(f"{recording} holds no tick", "a session that lasted a moment", "nothing can be measured")
    return ticks
