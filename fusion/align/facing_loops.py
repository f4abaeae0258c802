"""The loops of the belief about facing, compiled; `facing` says what they are for."""

from __future__ import annotations

import numpy as np
from numba import njit

from fusion.messages import Floats

LEAST = 1e-9
"""No direction is ever ruled out altogether."""


@njit(cache=True)
def spread(beliefs: Floats, std: float) -> Floats:
    """Beliefs (M, N) on the circle, each smeared by a Gaussian; the first stays a distribution.

    Args:
        beliefs: the first is a distribution over directions, the others parts of it.
        std: of the Gaussian, in directions.
    """
    rows, count = beliefs.shape
    reach = min(int(4.0 * std) + 1, count // 2 - 1)
    tap = np.exp(-0.5 * (np.arange(reach + 1) / std) ** 2)
    tap /= 2.0 * tap.sum() - tap[0]
    smeared = np.empty_like(beliefs)
    for m in range(rows):
        for n in range(count):
            total = tap[0] * beliefs[m, n]
            for k in range(1, reach + 1):
                total += tap[k] * (beliefs[m, (n + k) % count] + beliefs[m, n - k])
            smeared[m, n] = max(total, LEAST)
    smeared /= smeared[0].sum()
    return smeared


@njit(cache=True)
def looked(
    share: Floats,
    exchanged: Floats,
    direction: Floats,
    line: float,
    concentration: Floats,
    misled: float,
    looks: float,
) -> tuple[Floats, Floats]:
    """Bayes' rule for one line: the new share of each direction (N,), and P(exchanged) given each (N,).

    p(line | ψ, right) = (1 − misled) √(κ/2π) exp(κ (cos(ψ − line) − 1)) + misled / 2π, to the power of `looks`;
    exchanged names turn the line by half a turn, which reverses the cosine's sign.
    """
    new_share, new_exchanged = np.empty_like(share), np.empty_like(share)
    for n in range(len(share)):
        kappa, cosine = concentration[n], np.cos(direction[n] - line)
        height, floor = (1.0 - misled) * np.sqrt(kappa / (2 * np.pi)), misled / (2 * np.pi)
        right = (height * np.exp(kappa * (cosine - 1.0)) + floor) ** looks
        other = (height * np.exp(kappa * (-cosine - 1.0)) + floor) ** looks
        both = (1.0 - exchanged[n]) * right + exchanged[n] * other
        new_exchanged[n] = min(max(exchanged[n] * other / both, 1e-6), 1.0 - 1e-6)
        new_share[n] = share[n] * both
    new_share /= new_share.sum()
    return new_share, new_exchanged
