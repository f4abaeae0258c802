"""The cuts of `boxes`, compiled: each rule shrinks two joints' boxes in place, or leaves them and says so."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from fusion.compiled import kernel
from fusion.messages import Floats

PLACE, OFFSET, DISTANCE = 0, 1, 2


@kernel
def contract(
    low: Floats,
    high: Floats,
    kind: NDArray[np.int64],
    joints: NDArray[np.int64],
    vector: Floats,
    limits: Floats,
    sweeps: int,
) -> NDArray[np.bool_]:
    """Apply N rules forth and back, `sweeps` times, to boxes (J, 3) in place.

    Args:
        low: of the boxes.
        high: of the boxes.
        kind: (N,) PLACE, OFFSET or DISTANCE.
        joints: (N, 2) a place uses the first only.
        vector: (N, 3) a place's position or an offset.
        limits: (N, 2) a distance's least and most; else the tolerance comes second.
        sweeps: how often.

    Returns:
        (N,) which rules would have left nothing; they are not used again.
    """
    count = len(kind)
    unused = np.zeros(count, dtype=np.bool_)
    for step in range(2 * sweeps * count):
        at = step % (2 * count)
        rule = at if at < count else 2 * count - 1 - at
        if not unused[rule]:
            a, b = joints[rule]
            unused[rule] = not _apply(low, high, kind[rule], a, b, vector[rule], limits[rule])
    return unused


@kernel
def _apply(low: Floats, high: Floats, kind: int, a: int, b: int, vector: Floats, limits: Floats) -> bool:
    slack = limits[1]
    if kind == PLACE:
        return _cut(low, high, a, vector - slack, vector + slack)
    if kind == OFFSET:
        least, most = vector - slack, vector + slack
    else:
        least, most = low[b] - high[a], high[b] - low[a]
        if not _shell(least, most, limits[0], limits[1]):
            return False
    if not _cut(low, high, b, low[a] + least, high[a] + most):
        return False
    return _cut(low, high, a, low[b] - most, high[b] - least)


@kernel
def _cut(low: Floats, high: Floats, joint: int, least: Floats, most: Floats) -> bool:
    """Cut one joint's box, unless nothing would be left."""
    for i in range(3):
        if max(low[joint, i], least[i]) > min(high[joint, i], most[i]):
            return False
    for i in range(3):
        low[joint, i] = max(low[joint, i], least[i])
        high[joint, i] = min(high[joint, i], most[i])
    return True


@kernel
def _shell(least: Floats, most: Floats, shortest: float, longest: float) -> bool:
    """Cut a vector's axes (3,) by its length: x² = |d|² − y² − z², with what the other two axes may be.

    An axis that may still have either sign is cut from outside only.
    """
    nearest, farthest = np.empty(3), np.empty(3)
    for i in range(3):
        nearest[i] = max(least[i], -most[i], 0.0) ** 2
        farthest[i] = max(-least[i], most[i]) ** 2
    for i in range(3):
        j, k = (i + 1) % 3, (i + 2) % 3
        room = longest**2 - nearest[j] - nearest[k]
        if room < 0.0:
            return False
        outer = np.sqrt(room)
        inner = np.sqrt(max(shortest**2 - farthest[j] - farthest[k], 0.0))
        least[i], most[i] = max(least[i], -outer), min(most[i], outer)
        if least[i] > -inner:
            least[i] = max(least[i], inner)
        if most[i] < inner:
            most[i] = min(most[i], -inner)
        if least[i] > most[i]:
            return False
    return True


@kernel
def shrink_balls(
    radius: Floats, first: NDArray[np.int64], second: NDArray[np.int64], slack: Floats, sweeps: int
) -> None:
    """Triangle inequality along N links, forth and back, in place: radius_b <= radius_a + slack, and the other way."""
    count = len(first)
    for step in range(2 * sweeps * count):
        at = step % (2 * count)
        link = at if at < count else 2 * count - 1 - at
        a, b = first[link], second[link]
        radius[b] = min(radius[b], radius[a] + slack[link])
        radius[a] = min(radius[a], radius[b] + slack[link])
