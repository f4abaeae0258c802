"""The point inside the sets: least squares over all joints at once, from cameras, known bones and the tag.

min Σ_j |x_j − c_j|²/σ_j² + Σ_bones |x_b − x_a − o|²/σ_o² + Σ_places |x_j − p|²/σ_p². Every error is taken alike on
all three axes, so one (J, J) matrix serves them; bones whose vector nobody measured keep the one the cameras told
last, weakly: what nobody sees comes along with what is seen.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from typing import Final

import numpy as np
from numpy.typing import NDArray

from fusion.joined.boxes import Offset, Place
from fusion.messages import Floats
from fusion.skeleton import BONE_INDICES, JOINT_COUNT

Flags = NDArray[np.bool_]
BOUND_SIGMAS: Final = 4.0
"""A camera's or a tag's bound is so many of its deviations."""
TOLERANCE_SIGMAS: Final = 3.0
"""And a bone's tolerance so many of its own."""
COMES_ALONG_STD_M: Final = 0.15


def solve(told: Floats, bound_m: Floats, offsets: Sequence[Offset], places: Sequence[Place]) -> tuple[Floats, Floats]:
    """The point of every joint, (J, 3) m, and its standard deviation per axis, (J,) m, if all errors were independent.

    Args:
        told: (J, 3) m, what cameras make of it; NaN for a joint never seen, which stays so.
        bound_m: (J,) of it; infinite where cameras are not to be believed.
        offsets: bones whose vector is known.
        places: joints whose place is known.
    """
    known: Flags = np.asarray(np.isfinite(told).all(axis=1))
    start = np.where(known[:, None], told, 0.0)
    weight = np.where(known, (BOUND_SIGMAS / bound_m) ** 2, 0.0)
    matrix, right = np.diag(weight), np.zeros((JOINT_COUNT, 3))
    for a, b, vector, std_m in _bones(start, known, offsets):
        share = std_m**-2
        matrix[[a, b], [a, b]] += share
        matrix[[a, b], [b, a]] -= share
        left = share * (vector - start[b] + start[a])
        right[b] += left
        right[a] -= left
    for place in places:
        share = (BOUND_SIGMAS / place.tolerance_m) ** 2
        matrix[place.joint, place.joint] += share
        right[place.joint] += share * (place.position - start[place.joint])
    matrix[~known, ~known] += 1.0
    covariance = np.linalg.inv(matrix)
    moved = start + covariance @ right
    return np.where(known[:, None], moved, np.nan), np.sqrt(np.diagonal(covariance))


def _bones(start: Floats, known: Flags, offsets: Sequence[Offset]) -> Iterator[tuple[int, int, Floats, float]]:
    """Every bone between joints that are known: its ends, vector and standard deviation."""
    measured = {(offset.parent, offset.child): offset for offset in offsets}
    for a, b in BONE_INDICES.tolist():
        if known[a] and known[b] and (a, b) not in measured:
            yield a, b, start[b] - start[a], COMES_ALONG_STD_M
    for (a, b), offset in measured.items():
        if known[a] and known[b]:
            yield a, b, offset.offset, offset.tolerance_m / TOLERANCE_SIGMAS
