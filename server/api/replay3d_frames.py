"""What is drawn of a recorded session, thinned and held as arrays, so that any instant of it can be shown at once."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from dataclasses import dataclass, field
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
class SensorFrames:
    """One sensor over the session."""

    sensor: str
    joints: Array  # (T, 25, 3)
    place: Array  # (T, 3)


@dataclass(frozen=True, slots=True)
class Frames:
    """A session as it is drawn; positions in the room, metres, NaN where something is missing."""

    t_s: NDArray[np.float64]  # (T,) since the first one
    state: tuple[DriveState, ...]  # (T,)
    sensors: tuple[SensorFrames, ...]
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

        return Picture(
            sensors=tuple(SensorPicture(one.sensor, between(one.joints), between(one.place)) for one in self.sensors),
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
    film = _Film()
    for entry in _thinned(LogReader(recording).ticks()):
        if len(film.t_s) % ASKED_EVERY == 0 and not wanted():
            raise RefusedError("the recording was put away", "no session open", "try again when it has ended")
        film.take(_decoded(recording, entry))
    if not film.t_s:
        raise RecordingError(f"{recording} holds no tick", "a session that lasted a moment", "there is nothing to see")
    return film.frames()


def _thinned(entries: Iterator[LogEntry]) -> Iterator[LogEntry]:
    due_s: float | None = None
    for entry in entries:
        if due_s is None or entry.t_s >= due_s:
            # On an even beat; after a hole the beat begins anew.
            due_s = (
                entry.t_s + KEPT_EVERY_S if due_s is None else max(due_s, entry.t_s - KEPT_EVERY_S / 2) + KEPT_EVERY_S
            )
            yield entry


def _decoded(recording: Path, entry: LogEntry) -> _Tick:
    try:
        return _decoder.decode(entry.data)
    except msgspec.MsgspecError as error:
        raise RecordingError(f"{recording}: a tick cannot be read ({error})", "ticks of this version") from None


@dataclass(slots=True)
class _Film:
    """Frames while they are read, as plain bytes: the ticks as objects would take ten times the memory."""

    t_s: list[float] = field(default_factory=list)
    state: list[DriveState] = field(default_factory=list)
    body: bytearray = field(default_factory=bytearray)
    mirrored: bytearray = field(default_factory=bytearray)
    exo: bytearray = field(default_factory=bytearray)
    joints: dict[str, bytearray] = field(default_factory=dict)
    place: dict[str, bytearray] = field(default_factory=dict)

    def take(self, tick: _Tick) -> None:
        """One further picture."""
        seen = {sensor.sensor: sensor for sensor in tick.sensors}
        for name in seen.keys() - self.joints.keys():  # it was not there until now
            self.joints[name] = bytearray(NOWHERE.tobytes() * len(self.t_s))
            self.place[name] = bytearray(NO_PLACE.tobytes() * len(self.t_s))
        for name in self.joints:
            joints, place = _sensor(seen.get(name))
            self.joints[name] += joints.tobytes()
            self.place[name] += place.tobytes()
        self.body += (NOWHERE if tick.body is None else as_array(tick.body.joints_in_room)).tobytes()
        self.mirrored += _points(tick.target).tobytes()
        self.exo += _points(tick.affected).tobytes()
        self.t_s.append(tick.t_s)
        self.state.append(tick.state)

    def frames(self) -> Frames:
        """All pictures taken."""
        return Frames(
            t_s=np.array(self.t_s) - self.t_s[0],
            state=tuple(self.state),
            sensors=tuple(
                SensorFrames(name, _rows(self.joints[name], NOWHERE), _rows(self.place[name], NO_PLACE))
                for name in sorted(self.joints)
            ),
            body=_rows(self.body, NOWHERE),
            mirrored=_rows(self.mirrored, NO_ARM),
            exo=_rows(self.exo, NO_ARM),
        )


def _rows(values: bytearray, like: Array) -> Array:
    return np.frombuffer(values, np.float32).reshape(-1, *like.shape)


def _sensor(seen: _Sensor | None) -> tuple[Array, Array]:
    if seen is None:
        return NOWHERE, NO_PLACE
    joints = as_array(seen.joints_in_room) if seen.joints_in_room else NOWHERE
    return joints, NO_PLACE if seen.position_in_room is None else np.array(seen.position_in_room, np.float32)


def _points(arm: _Arm | None) -> Array:
    return NO_ARM if arm is None or not arm.valid or arm.points_in_room is None else as_array(arm.points_in_room)
