"""The lengths of an arm's segments, where a camera has seen them or nobody has said."""

from __future__ import annotations

from collections.abc import Iterable
from typing import Final

import numpy as np

from fusion.messages import ArmLengths, SkeletonSample
from fusion.skeleton import Side, TrackingState, arm

USUAL: Final = ArmLengths(0.316, 0.248, 0.08)
"""Somebody 1.70 m tall: 0.186 and 0.146 of the stature (Drillis and Contini 1966), and a Kinect's wrist to hand."""
ENOUGH: Final = 10


def lengths_seen(samples: Iterable[SkeletonSample], side: Side) -> ArmLengths | None:
    """Medians over the samples that saw the whole arm; None where too few did."""
    joints = list(arm(side))
    seen = [s.positions_in_sensor[joints] for s in samples if (s.state[joints] == TrackingState.TRACKED).all()]
    if len(seen) < ENOUGH:
        return None
    upper_arm, forearm, hand = np.median(np.linalg.norm(np.diff(np.array(seen), axis=1), axis=2), axis=0).tolist()
    return ArmLengths(upper_arm, forearm, hand)
