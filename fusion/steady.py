"""The body as it is told: it never steps further than a limb could move, whatever is learnt of the past meanwhile."""

from __future__ import annotations

from dataclasses import replace
from typing import Final

import numpy as np

from fusion.compiled import kernel
from fusion.estimation.vectors import distance, row
from fusion.messages import Floats, FusedFrame

SPEED_MAX: Final = 6.0
"""m/s, what a limb can do; half a metre is caught up within three frames of 30 Hz."""


def follow(last: FusedFrame | None, target: FusedFrame) -> FusedFrame:
    """Move on from what was told `last` towards `target`, no joint faster than 6 m/s.

    A sensor that comes back, a late sample put in its place, a joint begun anew: each may move the best estimate by
    centimetres in no time. What is left to go is added to the bound, and the set becomes the ball of that radius, so
    whatever lay in the target's set lies in the one told.
    """
    if last is None:
        return target
    reach_m = SPEED_MAX * max(target.t_s - last.t_s, 0.0)
    if _farthest_m(last.positions_in_room, target.positions_in_room) <= reach_m:
        return target
    return _towards(last, target, reach_m)


@kernel
def _farthest_m(last: Floats, target: Floats) -> float:
    """How far the joints (J, 3) go at most; 0 for a joint not known in both."""
    farthest_m = 0.0
    for j in range(len(last)):
        away_m = distance(row(last, j), row(target, j))
        farthest_m = away_m if away_m > farthest_m else farthest_m
    return farthest_m


def _towards(last: FusedFrame, target: FusedFrame, reach_m: float) -> FusedFrame:
    """As far towards `target` as `reach_m` allows."""
    away = target.positions_in_room - last.positions_in_room
    away_m = np.linalg.norm(away, axis=1)
    too_far = away_m > reach_m  # False where either is not known
    share = reach_m / np.where(too_far, away_m, 1.0)
    short_m = np.where(too_far, (1 - share) * away_m, 0.0)
    bound_m = target.bound_m + short_m
    ball = too_far & np.isfinite(bound_m)
    radius_m = np.where(ball, bound_m, 0.0)[:, None, None]
    told = last.positions_in_room + share[:, None] * away
    return replace(
        target,
        positions_in_room=np.where(too_far[:, None], told, target.positions_in_room),
        bound_m=bound_m,
        shape_m2=np.where(ball[:, None, None], radius_m**2 * np.eye(3), target.shape_m2),
    )
