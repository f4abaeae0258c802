"""Learns an arm's segment lengths, and how constant they are, from the frames in which it is well seen."""

from __future__ import annotations

from collections import deque
from typing import Final

import numpy as np

from fusion.kinematics.direction_sets import SAFETY, distance_m, spread
from fusion.messages import ArmLengths, Floats, FusedFrame
from fusion.skeleton import Side, TrackingState, arm

EVERY_S: Final = 0.1
MEMORY: Final = 300
"""Samples remembered: 30 s. Old ones leave, so another patient's arm is forgotten."""
ENOUGH: Final = 10
ENOUGH_TO_JUDGE: Final = 20
"""Samples before the lengths' constancy says anything about the sets."""
NEARLY_ALL: Final = 95.0
LEAST_SPREAD_M: Final = 0.05
"""No segment is believed to be known better than this, however constant it looks: an arm at rest, seen wrongly in the
same way all the time, looks constant too."""
USUAL_HAND_M: Final = 0.08
"""Wrist to the hand's centre for sensors that give no hand."""


class LengthLearner:
    """Medians of the segment lengths over the last half minute of well-seen frames.

    The median is taken because a joint that wanders makes a segment longer or shorter for a while; up to half of the
    frames may be wrong. Memory is finite. The share of the joints' sets that the lengths use is 1.5 times the 95th
    percentile of |length − median| over the sets' extent along the segment.
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
        if frame.t_s < self._next_s or (frame.state[list(arm(side)[:3])] != TrackingState.TRACKED).any():
            return
        self._next_s = frame.t_s + EVERY_S
        self._samples.append(_measured(frame, side))
        if len(self._samples) >= ENOUGH:
            self._lengths = _learnt(np.array(self._samples))


def _measured(frame: FusedFrame, side: Side) -> Floats:
    """(5,) lengths of upper arm, forearm and hand, and the sets' extent along the first two."""
    shoulder, elbow, wrist, hand = arm(side)
    hand_m = distance_m(frame, wrist, hand)
    if frame.state[hand] != TrackingState.TRACKED or np.isnan(hand_m):
        hand_m = USUAL_HAND_M
    lengths_m = distance_m(frame, shoulder, elbow), distance_m(frame, elbow, wrist), hand_m
    return np.array([*lengths_m, spread(frame, shoulder, elbow).along_m, spread(frame, elbow, wrist).along_m])


def _learnt(samples: Floats) -> ArmLengths:
    upper_m, forearm_m, hand_m = (float(m) for m in np.median(samples[:, :3], axis=0))
    shares = [_share(samples[:, k], samples[:, 3 + k]) for k in (0, 1)]
    return ArmLengths(upper_m, forearm_m, hand_m, *shares)


def _share(lengths_m: Floats, along_m: Floats) -> float:
    """How much of the sets a segment's length uses, at most 1."""
    if len(lengths_m) < ENOUGH_TO_JUDGE or not (np.isfinite(along_m) & (along_m > 0)).all():
        return 1.0
    used = np.percentile(np.abs(lengths_m - np.median(lengths_m)) / along_m, NEARLY_ALL)
    return min(1.0, max(SAFETY * float(used), LEAST_SPREAD_M / float(np.median(along_m))))
