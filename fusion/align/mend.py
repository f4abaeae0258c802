"""Left and right exchanged in a single sensor's frame: mended where that explains it, refused where it does not.

A Kinect takes a back for a front, and from the side it may take either arm for the other ([Yao]; 15 % of walking frames
at 90°). Its own word is worth nothing then, so each frame is held against the body as predicted.
"""

from __future__ import annotations

from dataclasses import replace
from enum import StrEnum

import numpy as np
from numpy.typing import NDArray

from fusion.align.loops import middle_distance
from fusion.messages import AlignedSample, FusedFrame
from fusion.skeleton import INDEX, SIDES_SWAPPED, TrackingState

SIDED = np.nonzero(np.arange(len(SIDES_SWAPPED)) != SIDES_SWAPPED)[0]
AS_NAMED, EXCHANGED = np.column_stack([SIDED, SIDED]), np.column_stack([SIDES_SWAPPED[SIDED], SIDED])
"""(K, 2): which joint of a sample is held against which one of the prediction."""
FEWEST = 4
CLEARLY_BETTER = 0.6
LEAST_ERROR_M = 0.10
"""Exchanging sides is considered only when the joints are this far off as they are."""
OPPOSED_COSINE = -0.3
"""Shoulder lines further apart than about 107° cannot be the same shoulders."""
SHOULDERS = INDEX["ShoulderLeft"], INDEX["ShoulderRight"]


class Mending(StrEnum):
    """What was done to a frame; the words are what a report shows."""

    NONE = "none"
    SWAPPED_BACK = "left and right were exchanged, put back"
    SIDES_REFUSED = "left and right cannot be told, sided joints not used"


def mend(sample: AlignedSample, predicted: FusedFrame | None) -> tuple[AlignedSample, Mending]:
    """Put exchanged sides back, or leave the sided joints out, by the body predicted for that moment.

    Args:
        sample: a frame in the room.
        predicted: the body at that time; None while it is not known well enough to judge by.
    """
    if predicted is None:
        return sample, Mending.NONE
    plain = _distance(sample, predicted, AS_NAMED)
    if plain < LEAST_ERROR_M:
        return sample, Mending.NONE
    if _distance(sample, predicted, EXCHANGED) < CLEARLY_BETTER * plain:
        return _swapped(sample), Mending.SWAPPED_BACK
    if _opposed(sample, predicted):
        return _without_sides(sample), Mending.SIDES_REFUSED
    return sample, Mending.NONE


def _distance(sample: AlignedSample, predicted: FusedFrame, joints: NDArray[np.int64]) -> float:
    """Median distance of the sided joints to the prediction; 0 where too few are known to say anything."""
    seen, expected = (sample.positions_in_room, sample.state), (predicted.positions_in_room, predicted.state)
    apart_m, known = middle_distance(*seen, *expected, joints, TrackingState.TRACKED)
    return apart_m if known >= FEWEST else 0.0


def _opposed(sample: AlignedSample, predicted: FusedFrame) -> bool:
    """Whether the shoulder lines point against one another in the horizontal."""
    left, right = SHOULDERS
    ours = (sample.positions_in_room[right] - sample.positions_in_room[left])[[0, 2]]
    theirs = (predicted.positions_in_room[right] - predicted.positions_in_room[left])[[0, 2]]
    norm = float(np.linalg.norm(ours) * np.linalg.norm(theirs))
    return bool(float(ours @ theirs) < OPPOSED_COSINE * norm)


def _swapped(sample: AlignedSample) -> AlignedSample:
    return replace(sample, positions_in_room=sample.positions_in_room[SIDES_SWAPPED], state=sample.state[SIDES_SWAPPED])


def _without_sides(sample: AlignedSample) -> AlignedSample:
    state = sample.state.copy()
    state[SIDED] = TrackingState.LOST
    return replace(sample, state=state)
