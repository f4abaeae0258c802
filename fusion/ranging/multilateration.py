"""One position from ranges to three or more anchors; anchors that do not fit are dropped."""

from __future__ import annotations

from dataclasses import dataclass
from itertools import combinations
from typing import Final

import numpy as np
from numpy.typing import NDArray
from scipy.optimize import least_squares

from fusion.messages import Floats

MAX_DROPPED: Final = 2
"""So many anchors at a time may be without line of sight; all subsets are tried."""


@dataclass(frozen=True, slots=True)
class Fix:
    """A position and the anchors it stands on."""

    position: Floats  # (3,) m
    used: NDArray[np.bool_]  # (A,)
    residual_m: Floats  # (A,) range − distance; of the dropped anchors too


def solve_position(anchors: Floats, ranges_m: Floats, gate_m: float, height_m: float | None = None) -> Fix | None:
    """The point whose distances fit the ranges best, min Σ (r_i − |p − a_i|)², over the largest set that agrees.

    All anchors are tried first; if a residual is beyond the gate, every set with one anchor less, then two less, and
    the best set counts. An obstacle can only lengthen a range, so of equally good sets the one whose dropped anchors
    measure too long is taken.

    Args:
        anchors: (A, 3) m, z up.
        ranges_m: (A,); NaN where there is none.
        gate_m: the largest residual of an anchor that is believed.
        height_m: the tag's height where it is known; then x and y alone are sought.

    Returns:
        None where no set agrees, or fewer anchors have ranges than unknowns plus one (3 with a height, 4 without: one
        more would be needed to say *which* of them is wrong).
    """
    present = np.flatnonzero(np.isfinite(ranges_m))
    least = 3 if height_m is not None else 4
    for size in range(len(present), max(least, len(present) - MAX_DROPPED) - 1, -1):
        fixes = [_fit(anchors, ranges_m, np.array(chosen), height_m) for chosen in combinations(present, size)]
        agreeing = [fix for fix in fixes if np.abs(fix.residual_m[fix.used]).max() <= gate_m]
        if agreeing:
            return min(agreeing, key=_disbelief)
    return None


def _disbelief(fix: Fix) -> tuple[int, float]:
    """How many dropped anchors measured too short (an obstacle cannot), then the squares of the rest."""
    too_short = int(np.sum(fix.residual_m[~fix.used] < 0))
    return too_short, float(np.sum(fix.residual_m[fix.used] ** 2))


def _fit(anchors: Floats, ranges_m: Floats, chosen: NDArray[np.int64], height_m: float | None) -> Fix:
    stand, wanted = anchors[chosen], ranges_m[chosen]
    free = 3 if height_m is None else 2
    rest = np.array([] if height_m is None else [height_m])

    def off(point: Floats) -> Floats:
        return np.asarray(np.linalg.norm(np.concatenate([point, rest]) - stand, axis=1) - wanted)

    starts = _starts(stand, free)
    best = min((least_squares(off, start, method="lm") for start in starts), key=lambda found: float(found.cost))
    position = np.concatenate([best.x, rest])
    used = np.zeros(len(anchors), dtype=bool)
    used[chosen] = True
    return Fix(position, used, ranges_m - np.linalg.norm(position - anchors, axis=1))


def _starts(stand: Floats, free: int) -> list[Floats]:
    """The anchors' middle, and points to either side of their flattest direction, where a mirror image could hide."""
    middle = stand.mean(axis=0)[:free]
    _, spread, axes = np.linalg.svd(stand[:, :free] - middle)
    return [middle, middle + spread[0] * axes[-1], middle - spread[0] * axes[-1]]
