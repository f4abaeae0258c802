"""Learns an arm's segment lengths from the frames in which it is well seen."""

from __future__ import annotations

from math import isnan
from typing import Final

import numpy as np

from fusion.kinematics.lately import Lately
from fusion.kinematics.vectors import length, step
from fusion.messages import ArmLengths, FusedFrame
from fusion.skeleton import Side, TrackingState, arm

EVERY_S: Final = 0.1
MEMORY: Final = 300
"""Samples remembered: 30 s. Old ones leave, so another patient's arm is forgotten."""
ENOUGH: Final = 10
USUAL_HAND_M: Final = 0.08
"""Wrist to the hand's centre for sensors that give no hand."""
_JOINTS: Final = {side: arm(side) for side in Side}


class LengthLearner:
    """Medians of the segment lengths over the last half minute of well-seen frames.

    The median is taken because a joint that wanders makes a segment longer or shorter for a while; up to half of the
    frames may be wrong. Memory is finite.
    """

    def __init__(self) -> None:
        self._segments = (Lately(MEMORY), Lately(MEMORY), Lately(MEMORY))  # upper arm, forearm, hand
        self._next_s = -np.inf
        self._lengths: ArmLengths | None = None

    @property
    def lengths(self) -> ArmLengths | None:
        """What is known so far; None until a second's worth of frames has been seen."""
        return self._lengths

    def update(self, frame: FusedFrame, side: Side) -> None:
        """Take a frame in, if the arm is seen and the last one was long enough ago."""
        joints = _JOINTS[side]
        if frame.t_s < self._next_s or any(frame.state[joint] != TrackingState.TRACKED for joint in joints[:3]):
            return
        self._next_s = frame.t_s + EVERY_S
        measured = _measured(frame, joints)
        if isnan(measured[0] + measured[1]):
            return
        for segment, length_m in zip(self._segments, measured, strict=True):
            segment.take(length_m)
        if self._segments[0].count >= ENOUGH:
            self._lengths = ArmLengths(*(segment.median for segment in self._segments))


def _measured(frame: FusedFrame, joints: tuple[int, int, int, int]) -> tuple[float, float, float]:
    """Lengths of upper arm, forearm and hand."""
    shoulder, elbow, wrist, hand = joints
    positions = frame.positions_in_room
    hand_m = length(step(positions, wrist, hand, 1.0))
    if frame.state[hand] != TrackingState.TRACKED or isnan(hand_m):
        hand_m = USUAL_HAND_M
    return length(step(positions, shoulder, elbow, 1.0)), length(step(positions, elbow, wrist, 1.0)), hand_m
