"""Learns an arm's segment lengths from the frames in which it is well seen."""

from __future__ import annotations

from collections import deque
from typing import Final

import numpy as np

from fusion.messages import ArmLengths, Floats, FusedFrame
from fusion.skeleton import Side, TrackingState, arm

EVERY_S: Final = 0.1
MEMORY: Final = 300
"""Samples remembered: 30 s. Old ones leave, so another patient's arm is forgotten."""
ENOUGH: Final = 10
USUAL_HAND_M: Final = 0.08
"""Wrist to the hand's centre for sensors that give no hand."""


class LengthLearner:
    """Medians of the segment lengths over the last half minute of well-seen frames.

    The median is taken because a joint that wanders makes a segment longer or shorter for a while; up to half of the
    frames may be wrong. Memory is finite.
    """

    def __init__(self) -> None:
        self._samples: deque[Floats] = deque(maxlen=MEMORY)
        self._next_s = -np.inf
        self._lengths: ArmLengths | None = None

    @property
    def lengths(self) -> ArmLengths | None:
        """What is known so far; None until a second's worth of frames has been seen."""
        return self._lengths

    def update(self, frame: FusedFrame, side: Side) -> None:
        """Take a frame in, if the arm is seen and the last one was long enough ago."""
        joints = list(arm(side))
        if frame.t_s < self._next_s or (frame.state[joints[:3]] != TrackingState.TRACKED).any():
            return
        self._next_s = frame.t_s + EVERY_S
        points = frame.positions_in_room[joints]  # (4, 3)
        measured = np.linalg.norm(np.diff(points, axis=0), axis=1)  # (3,)
        if frame.state[joints[3]] != TrackingState.TRACKED or np.isnan(measured[2]):
            measured[2] = USUAL_HAND_M
        self._samples.append(measured)
        if len(self._samples) >= ENOUGH:
            self._lengths = ArmLengths(*(float(m) for m in np.median(np.array(self._samples), axis=0)))
