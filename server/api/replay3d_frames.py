"""What is drawn of a recorded session, thinned and held as arrays, so that any instant of it can be shown at once."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass
from pathlib import Path

import msgspec
import numpy as np
from numpy.typing import NDArray

from fusion.errors import RecordingError, RefusedError
from fusion.recording.log_reader import LogEntry, LogReader
from server.api.view3d_picture import NO_ARM, NO_PLACE, NOWHERE, Picture, SensorPicture
from server.api.view3d_shapes import Array, as_array
from server.messages import DriveState, Point

KEPT_EVERY_S = 0.04
"""25 pictures a second, joined by straight lines; an hour of them takes 90 MB."""
LONGEST_GAP_S = 0.2
"""Over a longer hole in the recording nothing is drawn in between: nobody knows what happened there."""
ASKED_EVERY = 500
"""After so many pictures it is asked whether they are still wanted."""


class _Sensor(msgspec.Struct, frozen=True, gc=False):
    """Of `SensorView`."""

    sensor: str
    position_in_room: Point | None
    joints_in_room: tuple[Point | None, ...]


class _Body(msgspec.Struct, frozen=True, gc=False):
    """Of `BodyView`."""

    joints_in_room: tuple[Point | None, ...]


class _Arm(msgspec.Struct, frozen=True, gc=False):
    """Of `ArmView`."""

    valid: bool
    points_in_room: tuple[Point, Point, Point, Point] | None


class _Tick(msgspec.Struct, frozen=True):
    """Of `LiveTick`."""

    t_s: float
    state: DriveState
    sensors: tuple[_Sensor, ...]
    body: _Body | None
    target: _Arm | None
    affected: _Arm


_decoder = msgspec.msgpack.Decoder(_Tick)


@dataclass(frozen=True, slots=True)
class Frames:
    """A session as it is drawn; positions in the room, metres, NaN where something is missing."""

    t_s: NDArray[np.float64]  # (T,) since the first one
    state: tuple[DriveState, ...]  # (T,)
    sensors: tuple[str, ...]
    sensor_joints: Array  # (T, S, 25, 3)
    sensor_places: Array  # (T, S, 3)
    body: Array  # (T, 25, 3)
    mirrored: Array  # (T, 4, 3)
    exo: Array  # (T, 4, 3)

    @property
    def duration_s(self) -> float:
        """From the first picture to the last."""
        return float(self.t_s[-1])

    def at(self, t_s: float) -> Picture:
        """The picture at an instant: between two recorded ones on the straight line, across a hole the earlier one."""
        before, after, share = self._around(t_s)

        def between(values: Array) -> Array:
            mixed = (1.0 - share) * values[before] + share * values[after]
            return np.asarray(mixed, np.float32)

        joints, places = between(self.sensor_joints), between(self.sensor_places)
        return Picture(
            sensors=tuple(SensorPicture(name, joints[k], places[k]) for k, name in enumerate(self.sensors)),
            body=between(self.body),
            mirrored=between(self.mirrored),
            exo=between(self.exo),
        )

    def _around(self, t_s: float) -> tuple[int, int, float]:
        last = len(self.t_s) - 1
        before = int(np.clip(np.searchsorted(self.t_s, t_s, side="right") - 1, 0, last))
        after = min(before + 1, last)
        step_s = float(self.t_s[after] - self.t_s[before])
        if not 0.0 < step_s <= LONGEST_GAP_S or t_s <= self.t_s[before]:
            return before, before, 0.0
        return before, after, float(np.clip((t_s - self.t_s[before]) / step_s, 0.0, 1.0))


def read_frames(recording: Path, wanted: Callable[[], bool]) -> Frames:
    """Read what is drawn of a recording, also of one that was cut off.

    Args:
        recording: the file.
        wanted: asked now and then while reading; False ends it.

    Raises:
        RecordingError: it cannot be read, or holds no tick.
        RefusedError: it was no longer wanted.
    """
    ticks: list[_Tick] = []
    for entry in _thinned(LogReader(recording).ticks()):
        if len(ticks) % ASKED_EVERY == 0 and not wanted():
            raise RefusedError("the recording was put away", "no session open", "try again when it has ended")
        ticks.append(_decoded(recording, entry))
    if not ticks:
        raise RecordingError(f"{recording} holds no tick", "a session that lasted a moment", "there is nothing to see")
    return _stacked(ticks)


def _thinned(entries: Iterator[LogEntry]) -> Iterator[LogEntry]:
    due_s = -np.inf
    for entry in entries:
        if entry.t_s >= due_s:
            due_s = max(due_s, entry.t_s - KEPT_EVERY_S / 2) + KEPT_EVERY_S
            yield entry


def _decoded(recording: Path, entry: LogEntry) -> _Tick:
    try:
        return _decoder.decode(entry.data)
    except msgspec.MsgspecError as error:
        raise RecordingError(f"{recording}: a tick cannot be read ({error})", "ticks of this version") from None


def _stacked(ticks: Sequence[_Tick]) -> Frames:
    names = tuple(sorted({sensor.sensor for tick in ticks for sensor in tick.sensors}))
    seen = [_by_name(tick, names) for tick in ticks]
    return Frames(
        t_s=np.array([tick.t_s for tick in ticks]) - ticks[0].t_s,
        state=tuple(tick.state for tick in ticks),
        sensors=names,
        sensor_joints=np.stack([joints for joints, _ in seen]),
        sensor_places=np.stack([places for _, places in seen]),
        body=np.stack([NOWHERE if tick.body is None else as_array(tick.body.joints_in_room) for tick in ticks]),
        mirrored=np.stack([_points(tick.target) for tick in ticks]),
        exo=np.stack([_points(tick.affected) for tick in ticks]),
    )


def _by_name(tick: _Tick, names: tuple[str, ...]) -> tuple[Array, Array]:
    joints = np.stack([NOWHERE] * len(names)) if names else np.empty((0, *NOWHERE.shape), np.float32)
    places = np.stack([NO_PLACE] * len(names)) if names else np.empty((0, 3), np.float32)
    for sensor in tick.sensors:
        k = names.index(sensor.sensor)
        joints[k] = as_array(sensor.joints_in_room) if sensor.joints_in_room else NOWHERE
        places[k] = NO_PLACE if sensor.position_in_room is None else sensor.position_in_room
    return joints, places


def _points(arm: _Arm | None) -> Array:
    return NO_ARM if arm is None or not arm.valid or arm.points_in_room is None else as_array(arm.points_in_room)
