"""The loops of the belief about facing, compiled; `facing` says what they are for and gives the figures.

Directions ψ are N equal steps from −π; beliefs over them are (N,).
"""

from __future__ import annotations

import numpy as np

from fusion.compiled import kernel
from fusion.messages import Floats

LEAST = 1e-9
"""No direction is ever ruled out altogether."""
SURE = 1e-6
"""Nor a sensor's names."""
MOST_OFTEN = 0.95


@kernel
def turned(share: Floats, exchanged: Floats, std: float) -> tuple[Floats, Floats]:
    """The belief once the person may have turned: P(ψ) and P(ψ, exchanged) of each sensor smeared by a Gaussian.

    Args:
        share: (N,) of each direction.
        exchanged: (M, N) probability that a sensor's names are exchanged, given each direction.
        std: of the Gaussian, in directions.
    """
    reach = min(int(4.0 * std) + 1, len(share) // 2 - 1)
    taps = np.exp(-0.5 * (np.arange(reach + 1) / std) ** 2)
    taps /= 2.0 * taps.sum() - taps[0]
    new_share, new_exchanged = _smeared(share, taps), np.empty_like(exchanged)
    for m in range(len(exchanged)):
        new_exchanged[m] = _smeared(share * exchanged[m], taps) / new_share
    return new_share / new_share.sum(), new_exchanged


@kernel
def _smeared(belief: Floats, taps: Floats) -> Floats:
    """A belief (N,) on the circle, each direction's part spread to both sides by `taps`."""
    count, reach = len(belief), len(taps) - 1
    around = np.concatenate((belief[count - reach :], belief, belief[:reach]))
    smeared = taps[0] * belief
    for k in range(1, reach + 1):
        for n in range(count):
            smeared[n] += taps[k] * (around[reach + n + k] + around[reach + n - k])
    least: Floats = np.maximum(smeared, LEAST)
    return least


@kernel
def renamed(
    exchanged: Floats, towards_lens: float, usual: tuple[float, float], often: tuple[float, float], certain: float
) -> Floats:
    """P(names exchanged) given each direction, once the sensor may have named anew.

    Named anew, names are exchanged as often as is usual for that view: twice `often` goes by the usual share, so that
    the usual share is where it settles. `certain` is the probability that exchanged names were put right or right ones
    exchanged, whatever is usual.

    Args:
        exchanged: (N,) before.
        towards_lens: direction to the sensor, rad.
        usual: how often names are exchanged of somebody who faces the sensor, and of a back.
        often: how often it names anew between two frames: in any view, and besides that side-on.
        certain: see above.
    """
    count = len(exchanged)
    found = np.empty_like(exchanged)
    for n in range(count):
        ahead = np.cos(2.0 * np.pi * n / count - np.pi - towards_lens)
        here = usual[0] + (usual[1] - usual[0]) / (1.0 + np.exp(4.0 * (ahead + 0.2)))
        anew = 2.0 * (often[0] + often[1] * np.exp(-((ahead / 0.4) ** 2)))
        to_right = min(max(anew * (1.0 - here), certain), MOST_OFTEN)
        to_exchanged = min(max(anew * here, certain), MOST_OFTEN)
        found[n] = exchanged[n] * (1.0 - to_right) + (1.0 - exchanged[n]) * to_exchanged
    return found


@kernel
def looked(
    share: Floats,
    exchanged: Floats,
    line: float,
    towards_lens: float,
    errors: tuple[float, float, float],
    looks: float,
) -> tuple[Floats, Floats]:
    """Bayes' rule for one line: the new share of each direction, and P(names exchanged) given each.

    p(line | ψ, right) = (1 − misled) √(κ/2π) exp(κ (cos(ψ − line) − 1)) + misled / 2π, to the power of `looks`;
    exchanged names turn the line by half a turn, which reverses the cosine's sign. κ goes from side-on to ahead with
    |cos(ψ − lens)|.

    Args:
        share: (N,) before.
        exchanged: (N,) before.
        line: the facing by the sensor's names, rad.
        towards_lens: direction to the sensor, rad.
        errors: κ ahead or behind, κ side-on, share of misleading lines.
        looks: how many looks of independent errors it is worth.
    """
    count = len(share)
    ahead, aside, misled = errors
    new_share, new_exchanged = np.empty_like(share), np.empty_like(share)
    for n in range(count):
        direction = 2.0 * np.pi * n / count - np.pi
        kappa = aside + (ahead - aside) * abs(np.cos(direction - towards_lens))
        height, floor = (1.0 - misled) * np.sqrt(kappa / (2 * np.pi)), misled / (2 * np.pi)
        cosine = np.cos(direction - line)
        right = np.exp(looks * np.log(height * np.exp(kappa * (cosine - 1.0)) + floor))
        other = np.exp(looks * np.log(height * np.exp(kappa * (-cosine - 1.0)) + floor))
        both = (1.0 - exchanged[n]) * right + exchanged[n] * other
        new_exchanged[n] = min(max(exchanged[n] * other / both, SURE), 1.0 - SURE)
        new_share[n] = share[n] * both
    new_share /= new_share.sum()
    return new_share, new_exchanged
