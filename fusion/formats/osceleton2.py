"""The dialect `osceleton2` (Zillode/OSCeleton-KinectSDK2): one message per joint, millimetres, y negated.

    /osceleton2/joint ,siiffffd    name sensor user x y z confidence t
    /osceleton2/hand  ,iiiffffifd  sensor user hand x y z confidence state stateConfidence t

t is in milliseconds and equal for one frame; confidence 1, 0.5, 0.1 means tracked, inferred, not tracked. Neck, hand
tips and thumbs are not sent.
"""

from __future__ import annotations

from dataclasses import dataclass, field
from typing import Final, cast

from fusion.formats.assembly import FrameAssembler, JointReading, Point, check_time
from fusion.formats.dialect import Assembler, body_number, code, expect_tags
from fusion.formats.osc import BadDatagram, Message, Reason, write
from fusion.messages import SkeletonSample
from fusion.skeleton import INDEX, TrackingState

_JOINT: Final = "/osceleton2/joint"
_HAND: Final = "/osceleton2/hand"
_SIDES: Final = (("l", "Left"), ("r", "Right"))
_LIMBS: Final = (("shoulder", "elbow", "wrist", "hand"), ("hip", "knee", "ankle", "foot"))
NAMES: Final[dict[str, int]] = {
    "head": INDEX["Head"],
    "neck": INDEX["SpineShoulder"],
    "torso": INDEX["SpineMid"],
    "waist": INDEX["SpineBase"],
} | {
    f"{side}_{part}": INDEX[f"{part.capitalize()}{suffix}"]
    for limb in _LIMBS
    for side, suffix in _SIDES
    for part in limb
}
"""The sender's joint names in its order, and which joint each is."""
_CONFIDENCE: Final = (0.1, 0.5, 1.0)
_MM_PER_M: Final = 1000.0
_MS_PER_S: Final = 1000.0
_USERS: Final = 2**31


@dataclass(frozen=True, slots=True)
class Osceleton2:
    """Zillode/OSCeleton-KinectSDK2, unmodified."""

    name: str = "osceleton2"
    port: int = 7110

    def claims(self, address: str) -> bool:
        """The two addresses above."""
        return address in (_JOINT, _HAND)

    def assembler(self, stream: str) -> Assembler:
        """A fresh assembler; the sensor is the sender, with the message's own number added where it is not 0."""
        return _Assembler(stream)

    def encode(self, sample: SkeletonSample, sequence: int) -> list[bytes]:
        """20 joint messages, then both hands; the other five joints cannot be said."""
        user, t_ms = body_number(sample.body, _USERS), sample.t_s * _MS_PER_S
        joints = [
            write(_JOINT, "siiffffd", name, 0, user, *_wire(sample, joint), t_ms) for name, joint in NAMES.items()
        ]
        hands = [
            write(_HAND, "iiiffffifd", 0, user, number, *_wire(sample, INDEX[f"Hand{suffix}"]), 0, 0.0, t_ms)
            for number, (_, suffix) in enumerate(_SIDES)
        ]
        return joints + hands


@dataclass(slots=True)
class _Assembler:
    stream: str
    frames: FrameAssembler = field(default_factory=FrameAssembler)

    def take(self, message: Message, now_s: float) -> list[SkeletonSample]:
        return self._joint(message, now_s) if message.address == _JOINT else self._hand(message, now_s)

    def _joint(self, message: Message, now_s: float) -> list[SkeletonSample]:
        expect_tags(message, "siiffffd")
        joint = code(NAMES, message.arguments[0], Reason.UNKNOWN_JOINT)
        # The tags have shown that these are numbers.
        sensor, user = cast(tuple[int, int], message.arguments[1:3])
        x, y, z, confidence, t_ms = cast(tuple[float, float, float, float, float], message.arguments[3:])
        point: Point = (x / _MM_PER_M, -y / _MM_PER_M, z / _MM_PER_M)
        reading = JointReading(joint, point, _state(confidence), t_ms / _MS_PER_S)
        return self.frames.joint(self._sensor(sensor), str(user), reading, now_s)

    def _hand(self, message: Message, now_s: float) -> list[SkeletonSample]:
        expect_tags(message, "iiiffffifd")
        sensor, user, hand = cast(tuple[int, int, int], message.arguments[:3])
        t_ms = cast(float, message.arguments[-1])
        check_time(t_ms)
        return self.frames.hand(self._sensor(sensor), str(user), str(hand), now_s, t_ms / _MS_PER_S)

    def _sensor(self, number: int) -> str:
        return f"{self.stream}/{number}" if number else self.stream

    def end_of_bundle(self) -> list[SkeletonSample]:
        return self.frames.end()

    def flush(self, now_s: float) -> list[SkeletonSample]:
        return self.frames.flush(now_s)


def _wire(sample: SkeletonSample, joint: int) -> tuple[float, float, float, float]:
    """Position in the sender's millimetres, and confidence."""
    state = int(sample.state[joint])
    x, y, z = (0.0, 0.0, 0.0) if state == TrackingState.LOST else sample.positions_in_sensor[joint].tolist()
    return x * _MM_PER_M, -y * _MM_PER_M, z * _MM_PER_M, _CONFIDENCE[state]


def _state(confidence: float) -> int:
    if not 0.0 <= confidence <= 1.0:
        raise BadDatagram(Reason.UNKNOWN_STATE)
    if confidence >= 0.75:
        return TrackingState.TRACKED
    return TrackingState.INFERRED if confidence >= 0.3 else TrackingState.LOST
