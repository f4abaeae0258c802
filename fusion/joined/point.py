"""The point inside the sets: least squares over all joints at once, from cameras, known bones and the tag.

min Σ_j |x_j − c_j|²/σ_j² + Σ_bones |x_b − x_a − o|²/σ_o² + Σ_places |x_j − p|²/σ_p². Every error is taken alike on
all three axes, so one (J, J) matrix serves them; bones whose vector nobody measured keep the one the cameras told
last, weakly: what nobody sees comes along with what is seen.
"""

from __future__ import annotations

from collections.abc import Sequence
from typing import Final

import numpy as np
from numpy.typing import NDArray

from fusion.joined.boxes import Offset, Place
from fusion.messages import Flags, Floats
from fusion.skeleton import BONE_INDICES, JOINT_COUNT

BOUND_SIGMAS: Final = 4.0
"""A camera's or a tag's bound is so many of its deviations."""
TOLERANCE_SIGMAS: Final = 3.0
"""And a bone's tolerance so many of its own."""
COMES_ALONG_STD_M: Final = 0.15
NOTHING: Final = 1e-9
"""Weight of what is not to be believed, so that there is an inverse: 30 km."""


def solve(
    told: Floats, bound_m: Floats, offsets: Sequence[Offset], places: Sequence[Place], bones_hold: bool
) -> tuple[Floats, Floats]:
    """The point of every joint, (J, 3) m, and its standard deviation per axis, (J,) m, if all errors were independent.

    Args:
        told: (J, 3) m, what cameras make of it; NaN for a joint never seen, which stays so.
        bound_m: (J,) of it; infinite where cameras are not to be believed.
        offsets: bones whose vector is known.
        places: joints whose place is known.
        bones_hold: whether what nobody sees comes along with what is seen.
    """
    known: Flags = np.asarray(np.isfinite(told).all(axis=1))
    start = np.where(known[:, None], told, 0.0)
    weight = np.where(known, (BOUND_SIGMAS / bound_m) ** 2, 0.0)
    matrix, right = np.diag(np.where(weight > 0, weight, NOTHING)), np.zeros((JOINT_COUNT, 3))
    ends, vectors, std_m = _bones(start, known, offsets, BONE_INDICES if bones_hold else BONE_INDICES[:0])
    apart = np.zeros((len(ends), JOINT_COUNT))  # apart @ x is every child less its parent
    rows = np.arange(len(ends))
    apart[rows, ends[:, 1]], apart[rows, ends[:, 0]] = 1.0, -1.0
    weighted = apart.T / std_m**2
    matrix += weighted @ apart
    right += weighted @ (vectors - apart @ start)
    for place in places:
        share = (BOUND_SIGMAS / place.tolerance_m) ** 2
        matrix[place.joint, place.joint] += share
        right[place.joint] += share * (place.position - start[place.joint])
    covariance = np.linalg.inv(matrix)
    moved = start + covariance @ right
    return np.where(known[:, None], moved, np.nan), np.sqrt(np.diagonal(covariance))


def _bones(
    start: Floats, known: Flags, offsets: Sequence[Offset], holding: NDArray[np.int64]
) -> tuple[NDArray[np.int64], Floats, Floats]:
    """Every bone between joints that are known: (N, 2) its ends, (N, 3) vector and (N,) standard deviation.

    Holding bones are among them even where an inertial sensor tells the vector: so weak a word does no harm.
    """
    ends = np.concatenate([holding, np.array([(o.parent, o.child) for o in offsets], np.int64).reshape(-1, 2)])
    told = start[holding[:, 1]] - start[holding[:, 0]]
    vectors = np.concatenate([told, np.array([o.offset for o in offsets]).reshape(-1, 3)])
    std_m = [o.tolerance_m / TOLERANCE_SIGMAS for o in offsets]
    both = known[ends].all(axis=1)
    return ends[both], vectors[both], np.array([COMES_ALONG_STD_M] * len(told) + std_m)[both]
