"""Puts joint messages that come one by one back together into frames, per stream and body.

A frame closes on its second hand message, a repeated joint, a changed sender's time, the end of a bundle, or 12 ms of
silence. Datagrams may be lost, doubled or overtaken on the way: a frame then holds fewer joints, but never joints of
two instants.
"""

from __future__ import annotations

import math
from collections.abc import Iterable
from dataclasses import dataclass, field
from typing import Final

import numpy as np

from fusion.formats.osc import BadDatagram, Reason
from fusion.messages import SkeletonSample, States
from fusion.skeleton import JOINT_COUNT

SILENCE_S: Final = 0.012
"""A frame's messages follow one another within about 2 ms; after this much silence no more will come."""
MAX_BODIES: Final = 8
"""Frames open at once in one stream. A Kinect v2 sees six bodies."""
MAX_REACH_M: Final = 50.0
"""No joint is further from its sensor than this; a metre taken for a millimetre is."""

Point = tuple[float, float, float]


@dataclass(frozen=True, slots=True)
class JointReading:
    """One joint message: position in the sensor's frame in metres, state 0..2, the sender's time if it gives one.

    Raises:
        BadDatagram: a seen joint's position, or the time, cannot be.
    """

    joint: int
    point: Point
    state: int
    t_sender_s: float | None = None

    def __post_init__(self) -> None:
        if self.state:
            check_positions(self.point)
        if self.t_sender_s is not None:
            check_time(self.t_sender_s)


def check_positions(values_m: Iterable[float]) -> None:
    """Refuse coordinates that are NaN, infinite or further away than any sensor sees."""
    for value_m in values_m:
        if not -MAX_REACH_M <= value_m <= MAX_REACH_M:
            raise BadDatagram(Reason.TOO_FAR if math.isfinite(value_m) else Reason.NOT_FINITE)


def check_time(t_s: float) -> None:
    """Refuse a sender's time that is NaN or infinite."""
    if not math.isfinite(t_s):
        raise BadDatagram(Reason.NOT_FINITE)


@dataclass(slots=True, eq=False)
class _Frame:
    opened_s: float
    newest_s: float
    t_sender_s: float | None
    joints: dict[int, JointReading] = field(default_factory=dict)
    hands: set[str] = field(default_factory=set)


@dataclass(slots=True, eq=False)
class FrameAssembler:
    """The open frames of one stream. `sensor` and body together name a frame."""

    _open: dict[tuple[str, str], _Frame] = field(default_factory=dict)
    _closed: dict[tuple[str, str], _Frame] = field(default_factory=dict)

    def joint(self, sensor: str, body: str, reading: JointReading, now_s: float) -> list[SkeletonSample]:
        """Take one joint message; returns the frame that it closes, if any.

        Raises:
            BadDatagram: it belongs to a frame that is closed, or too many bodies are open.
        """
        key = (sensor, body)
        if self._is_late(key, reading, now_s):
            raise BadDatagram(Reason.REPEATED)
        frame = self._open.get(key)
        samples = [self._close(key)] if frame is not None and _is_next(frame, reading) else []
        frame = self._open.get(key) or self._begin(key, reading, now_s)
        frame.joints[reading.joint] = reading
        frame.newest_s = now_s
        return samples

    def hand(
        self, sensor: str, body: str, side: str, now_s: float, t_sender_s: float | None = None
    ) -> list[SkeletonSample]:
        """Take one hand message; the second of a frame closes it. A hand alone begins none."""
        frame = self._open.get((sensor, body))
        if frame is None or frame.t_sender_s != t_sender_s:
            return []
        frame.hands.add(side)
        frame.newest_s = now_s
        return [self._close((sensor, body))] if len(frame.hands) == 2 else []

    def end(self) -> list[SkeletonSample]:
        """A bundle has ended: close every frame."""
        return [self._close(key) for key in list(self._open)]

    def flush(self, now_s: float) -> list[SkeletonSample]:
        """Close the frames that have been silent for 12 ms."""
        silent = [key for key, frame in self._open.items() if now_s - frame.newest_s > SILENCE_S]
        return [self._close(key) for key in silent]

    def _begin(self, key: tuple[str, str], reading: JointReading, now_s: float) -> _Frame:
        if len(self._open) >= MAX_BODIES:
            raise BadDatagram(Reason.TOO_MANY_BODIES)
        frame = self._open[key] = _Frame(now_s, now_s, reading.t_sender_s)
        return frame

    def _close(self, key: tuple[str, str]) -> SkeletonSample:
        frame = self._open.pop(key)
        self._closed.pop(key, None)
        self._closed[key] = frame
        while len(self._closed) > MAX_BODIES:
            del self._closed[next(iter(self._closed))]
        return _sample(key, frame)

    def _is_late(self, key: tuple[str, str], reading: JointReading, now_s: float) -> bool:
        """Whether a joint belongs to the frame that has just closed, or stands in the open one already.

        Without this a doubled or overtaken datagram would close or begin a frame of a few joints.
        """
        frame = self._open.get(key)
        if frame is not None and frame.joints.get(reading.joint) == reading:
            return now_s - frame.opened_s < SILENCE_S
        closed = self._closed.get(key)
        if frame is not None or closed is None or now_s - closed.opened_s >= SILENCE_S:
            return False
        return closed.joints.get(reading.joint, reading) == reading and closed.t_sender_s == reading.t_sender_s


def _is_next(frame: _Frame, reading: JointReading) -> bool:
    return reading.joint in frame.joints or reading.t_sender_s != frame.t_sender_s


def _sample(key: tuple[str, str], frame: _Frame) -> SkeletonSample:
    positions = np.full((JOINT_COUNT, 3), np.nan)
    states: States = np.zeros(JOINT_COUNT, dtype=np.uint8)
    seen = [reading for reading in frame.joints.values() if reading.state]
    if seen:
        where = [reading.joint for reading in seen]
        positions[where] = [reading.point for reading in seen]
        states[where] = [reading.state for reading in seen]
    t_s = frame.opened_s if frame.t_sender_s is None else frame.t_sender_s
    return SkeletonSample(key[0], key[1], t_s, frame.opened_s, positions, states)
