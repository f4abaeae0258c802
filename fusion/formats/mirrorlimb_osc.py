"""Our own dialect, `mirrorlimb`: everything one sensor says of one body at one instant, in one datagram.

    /mirrorlimb/1/skeleton ,sidsss + 3 J × f
        sensor    s   the sender's name for the sensor; together with the sender's address it is the sensor's identity
        sequence  i   counts this sensor's datagrams, wraps from 2^31-1 to 0
        t         d   seconds on the sensor's own clock
        body      s   the sensor's own name for the body
        skeleton  s   names the joints and their order: "kinect-v2" (J = 25)
        states    s   J digits: 0 lost, 1 inferred, 2 tracked
        x y z …   f   metres in the sensor's frame, joint after joint; of a lost joint they mean nothing

The 1 is the version. docs/formats.md keeps the addresses of other sensors (`imu`, `range`).
"""

from __future__ import annotations

from dataclasses import dataclass, field
from typing import Final, cast

import numpy as np

from fusion.formats.assembly import check_positions, check_time
from fusion.formats.dialect import Assembler, expect_tags
from fusion.formats.osc import BadDatagram, Message, Reason, write
from fusion.messages import SkeletonSample, States
from fusion.skeleton import JOINT_COUNT

_ADDRESS: Final = "/mirrorlimb/1/skeleton"
_TAGS: Final = "sidsss" + "fff" * JOINT_COUNT
_SKELETON: Final = "kinect-v2"
_DIGITS: Final = frozenset("012")
_WRAP: Final = 2**31
_OVERTAKEN: Final = 1000
"""A number at most this far behind the newest is late; further behind, the sender has started anew."""
_MAX_SENSORS: Final = 16
_MAX_NAME: Final = 64


@dataclass(frozen=True, slots=True)
class MirrorlimbOsc:
    """Our own dialect."""

    name: str = "mirrorlimb"
    port: int = 7120

    def claims(self, address: str) -> bool:
        """The address above."""
        return address == _ADDRESS

    def assembler(self, stream: str) -> Assembler:
        """A fresh assembler; a sensor is named "sender/its own name"."""
        return _Assembler(stream)

    def encode(self, sample: SkeletonSample, sequence: int) -> list[bytes]:
        """One datagram."""
        states = "".join(map(str, sample.state.tolist()))
        points = np.where(sample.state[:, None] > 0, sample.positions_in_sensor, 0.0).ravel().tolist()
        head = (sample.sensor[-_MAX_NAME:], sequence % _WRAP, sample.t_s, sample.body[-_MAX_NAME:], _SKELETON, states)
        return [write(_ADDRESS, _TAGS, *head, *points)]


@dataclass(slots=True)
class _Assembler:
    stream: str
    newest: dict[str, int] = field(default_factory=dict)

    def take(self, message: Message, now_s: float) -> list[SkeletonSample]:
        expect_tags(message, _TAGS)
        # The tags have shown the types.
        sensor, sequence, t_s, body, skeleton, states = cast(
            tuple[str, int, float, str, str, str], message.arguments[:6]
        )
        if skeleton != _SKELETON:
            raise BadDatagram(Reason.UNKNOWN_SKELETON)
        if not (_is_name(sensor) and _is_name(body)):
            raise BadDatagram(Reason.BAD_NAME)
        check_time(t_s)
        state = _states(states)
        positions = _positions(cast(tuple[float, ...], message.arguments[6:]), state)
        self._count(sensor, sequence)
        return [SkeletonSample(f"{self.stream}/{sensor}", body, t_s, now_s, positions, state)]

    def _count(self, sensor: str, sequence: int) -> None:
        """Refuse a datagram that came twice or was overtaken."""
        newest = self.newest.get(sensor)
        if newest is None and len(self.newest) >= _MAX_SENSORS:
            raise BadDatagram(Reason.TOO_MANY_SENDERS)
        if newest is not None and (newest - sequence) % _WRAP <= _OVERTAKEN:
            raise BadDatagram(Reason.REPEATED)
        self.newest[sensor] = sequence

    def end_of_bundle(self) -> list[SkeletonSample]:
        return []

    def flush(self, now_s: float) -> list[SkeletonSample]:
        return []


def _is_name(text: str) -> bool:
    return 0 < len(text) <= _MAX_NAME and text.isprintable()  # names are shown to people and written to files


def _states(digits: str) -> States:
    if len(digits) != JOINT_COUNT or not _DIGITS.issuperset(digits):
        raise BadDatagram(Reason.UNKNOWN_STATE)
    return np.frombuffer(digits.encode(), dtype=np.uint8) - ord("0")


def _positions(values: tuple[float, ...], state: States) -> np.ndarray:  # (J, 3)
    positions = np.array(values).reshape(JOINT_COUNT, 3)
    check_positions(positions[state > 0].ravel().tolist())
    positions[state == 0] = np.nan
    return positions
