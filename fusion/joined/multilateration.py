"""A position from ranges whose links are known, when one or two of them may be blocked."""

from __future__ import annotations

from functools import cache
from itertools import combinations
from typing import Final

import numpy as np
from numpy.typing import NDArray

from fusion.messages import Floats

MOST_BLOCKED: Final = 2
BLOCKED_COST: Final = 9.0
"""Twice the negative logarithm of how probable a blocked link is, one time in twenty, and of its range, which may then
be anything up to some decimetres too long."""
TOO_SHORT_COST: Final = 16.0
"""More, where it measured too short: what is in the way only lengthens."""
IN_QUESTION: Final = 0.01
"""What is less probable is left out of the tolerance."""
ROUNDS: Final = 5


def position_of(
    anchors: Floats, range_m: Floats, sigma_m: Floats, usual: Floats, usual_std_m: Floats
) -> tuple[Floats, float] | None:
    """Where the tag is, averaged over which links may be blocked.

    Every set with up to two links left out is solved by Gauss–Newton, all at once. How probable each is follows from
    Σ (r − |p − a|)²/σ² over the links used and a cost for each that is not. Often a blocked link can be explained away
    by another place: then both count.

    Args:
        anchors: (A, 3) m.
        range_m: (A,) m, biases taken off; NaN where there is none.
        sigma_m: (A,) m.
        usual: (3,) m, where the tag usually is.
        usual_std_m: (3,) m, by how much it may be elsewhere.

    Returns:
        (3,) m, the mean over the sets, and how far from it the farthest is that is not out of the question, m. None
        where fewer than three links have a range.
    """
    there = np.isfinite(range_m)
    stand, wanted, sigma = anchors[there], range_m[there], sigma_m[there]
    if len(stand) < 3:
        return None
    used = _choices(len(stand))  # (C, A)
    usually = np.diag(usual_std_m**-2)
    position = np.tile(usual, (len(used), 1))
    for _ in range(ROUNDS):
        rows, left = _linear(stand, wanted, sigma, position)
        information = np.einsum("ca,cai,caj->cij", used, rows, rows) + usually
        pull = np.einsum("ca,cai,ca->ci", used, rows, left) + (usual - position) @ usually
        step = np.linalg.solve(information, pull[..., None])
        position = position + step[..., 0]
    rows, left = _linear(stand, wanted, sigma, position)
    without = BLOCKED_COST + np.where(left < 0, TOO_SHORT_COST, 0.0)
    away = (position - usual) / usual_std_m
    cost = np.where(used > 0, left**2, without).sum(axis=1) + np.sum(away**2, axis=1)
    probable = np.exp(-0.5 * (cost - cost.min()))
    probable /= probable.sum()
    mean = probable @ position
    return mean, float(np.linalg.norm(position - mean, axis=1)[probable >= IN_QUESTION].max())


@cache
def _choices(links: int) -> NDArray[np.float64]:
    """(C, A) which links each set uses, 1 or 0."""
    most = max(min(MOST_BLOCKED, links - 3), 0)
    left_out = [chosen for size in range(most + 1) for chosen in combinations(range(links), size)]
    used = np.ones((len(left_out), links))
    for row, chosen in zip(used, left_out, strict=True):
        row[list(chosen)] = 0.0
    return used


def _linear(stand: Floats, wanted: Floats, sigma: Floats, position: Floats) -> tuple[Floats, Floats]:
    """(C, A, 3) unit vectors over σ, and (C, A) residuals over σ."""
    away = position[:, None] - stand
    distance = np.maximum(np.linalg.norm(away, axis=2), 1e-6)
    return away / (distance * sigma)[..., None], (wanted - distance) / sigma
