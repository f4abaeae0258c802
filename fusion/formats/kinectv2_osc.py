"""The dialect `kinectv2-osc` (microcosm/KinectV2-OSC): one datagram per joint, metres, no time, no frame number.

/bodies/{TrackingId}/joints/{JointType} ,fffs   x y z Tracked|Inferred|NotTracked
/bodies/{TrackingId}/hands/{Left|Right} ,ss     Open|Closed|Lasso|Unknown|NotTracked, confidence
"""

from __future__ import annotations

from dataclasses import dataclass, field
from typing import Final, cast

from fusion.formats.assembly import FrameAssembler, JointReading, Point
from fusion.formats.dialect import Assembler, body_number, code, expect_tags
from fusion.formats.osc import BadDatagram, Message, Reason, write
from fusion.messages import SkeletonSample
from fusion.skeleton import INDEX, JOINTS

_STATE_NAMES: Final = ("NotTracked", "Inferred", "Tracked")
_STATES: Final = {name: state for state, name in enumerate(_STATE_NAMES)}
_HANDS: Final = ("Left", "Right")
_IDS: Final = 2**64


@dataclass(frozen=True, slots=True)
class KinectV2Osc:
    """microcosm/KinectV2-OSC, unmodified."""

    name: str = "kinectv2-osc"
    port: int = 12345

    def claims(self, address: str) -> bool:
        """Bodies with named joints; numbered joints are another sender's (azure-kinect-osc)."""
        parts = address.split("/")
        if len(parts) != 5 or parts[1] != "bodies":
            return False
        return parts[3] == "hands" or (parts[3] == "joints" and not parts[4].isdigit())

    def assembler(self, stream: str) -> Assembler:
        """A fresh assembler; the sensor is the sender."""
        return _Assembler(stream)

    def encode(self, sample: SkeletonSample, sequence: int) -> list[bytes]:
        """25 joint messages, then both hands; lost joints are said as NotTracked at the origin."""
        body = f"/bodies/{body_number(sample.body, _IDS)}"
        joints = [
            write(f"{body}/joints/{name}", "fffs", *(point if state else (0.0, 0.0, 0.0)), _STATE_NAMES[state])
            for name, point, state in zip(
                JOINTS, sample.positions_in_sensor.tolist(), sample.state.tolist(), strict=True
            )
        ]
        return joints + [write(f"{body}/hands/{side}", "ss", "Unknown", "Low") for side in _HANDS]


@dataclass(slots=True)
class _Assembler:
    stream: str
    frames: FrameAssembler = field(default_factory=FrameAssembler)

    def take(self, message: Message, now_s: float) -> list[SkeletonSample]:
        _, _, body, kind, what = message.address.split("/")
        _check_body(body)
        if kind == "hands":
            return self._hand(message, body, what, now_s)
        expect_tags(message, "fffs")
        point = cast(Point, message.arguments[:3])  # the tags have shown it
        state = code(_STATES, message.arguments[3], Reason.UNKNOWN_STATE)
        reading = JointReading(code(INDEX, what, Reason.UNKNOWN_JOINT), point, state)
        return self.frames.joint(self.stream, body, reading, now_s)

    def _hand(self, message: Message, body: str, side: str, now_s: float) -> list[SkeletonSample]:
        expect_tags(message, "ss")
        if side not in _HANDS:
            raise BadDatagram(Reason.UNKNOWN_JOINT)
        return self.frames.hand(self.stream, body, side, now_s)

    def end_of_bundle(self) -> list[SkeletonSample]:
        return self.frames.end()

    def flush(self, now_s: float) -> list[SkeletonSample]:
        return self.frames.flush(now_s)


def _check_body(body: str) -> None:
    if not (body.isascii() and body.isdigit() and len(body) <= 20 and int(body) < _IDS):
        raise BadDatagram(Reason.UNKNOWN_BODY)
