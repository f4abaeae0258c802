"""A position from ranges whose links are known: least squares that a blocked link does not pull."""

from __future__ import annotations

from typing import Final

import numpy as np

from fusion.messages import Floats

ROUNDS: Final = 8
TOO_LONG: Final = 1.5
"""In deviations: what is in the way only lengthens a range, so a longer one is doubted soon."""
TOO_SHORT: Final = 3.0
STIFFNESS: Final = 1e-3
"""Share of the information that holds a direction which no link tells."""


def robust_position(anchors: Floats, range_m: Floats, sigma_m: Floats, start: Floats) -> Floats:
    """The least Σ ρ((r − |p − a|)/σ), by Gauss–Newton with weights anew in every round.

    The weight falls as the square of the residual beyond 1.5σ too long or 3σ too short (Geman and McClure's kind of
    loss), and its width shrinks from wide to narrow, so that the start does not matter.

    Args:
        anchors: (A, 3) m.
        range_m: (A,) m, biases taken off; NaN where there is none.
        sigma_m: (A,) m.
        start: (3,) m; returned where there is nothing to go by.
    """
    there = np.isfinite(range_m)
    stand, wanted, sigma = anchors[there], range_m[there], sigma_m[there]
    position = start
    for k in range(ROUNDS):
        away = position - stand
        distance = np.maximum(np.linalg.norm(away, axis=1), 1e-6)
        left = (wanted - distance) / sigma
        limit = np.where(left > 0, TOO_LONG, TOO_SHORT) * 2.0 ** max(3 - k, 0)
        weight = np.minimum(1.0, (limit / np.maximum(np.abs(left), 1e-9)) ** 2)
        rows = away / (distance * sigma)[:, None]
        information = rows.T @ (weight[:, None] * rows)
        hold = STIFFNESS * np.trace(information) + 1e-9
        position = position + np.linalg.solve(information + hold * np.eye(3), rows.T @ (weight * left))
    return position
