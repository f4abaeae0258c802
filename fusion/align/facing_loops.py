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
def usually_named(usual: tuple[float, float], towards_lens: float, count: int) -> Floats:
    """P(names exchanged) given each of `count` directions, for a sensor that names somebody for the first time.

    Args:
        usual: how often names are exchanged of somebody who faces the sensor, and of a back.
        towards_lens: direction to the sensor, rad.
        count: N.
    """
    found = np.empty(count)
    for n in range(count):
        found[n] = _renamed(0.5, np.cos(_direction(n, count) - towards_lens), usual, (0.5, 0.0), 0.0)
    return found


@kernel
def heard(
    share: Floats,
    exchanged: Floats,
    row: int,
    lines: tuple[float, float],
    usual: tuple[float, float],
    anew: tuple[float, float, float],
    errors: tuple[float, float, float],
    looks: float,
) -> tuple[Floats, Floats]:
    """The belief after a sensor's frame: its names may have changed since its last one, then Bayes' rule for its line.

    Args:
        share: (N,) of each direction.
        exchanged: (M, N) probability that a sensor's names are exchanged, given each direction.
        row: of the sensor.
        lines: the facing by the sensor's names, and the direction to the sensor, rad.
        usual: how often names are exchanged of somebody who faces the sensor, and of a back.
        anew: see `_renamed`: `often`, in any view and besides that side-on, and `certain`.
        errors: κ ahead or behind, κ side-on, share of misleading lines.
        looks: how many looks of independent errors the line is worth.
    """
    count, (line, towards_lens) = len(share), lines
    new_share, new_exchanged = np.empty_like(share), exchanged.copy()
    for n in range(count):
        direction = _direction(n, count)
        ahead = np.cos(direction - towards_lens)
        before = _renamed(exchanged[row, n], ahead, usual, (anew[0], anew[1]), anew[2])
        right, other = _likelihoods(np.cos(direction - line), ahead, errors, looks)
        both = (1.0 - before) * right + before * other
        new_exchanged[row, n] = min(max(before * other / both, SURE), 1.0 - SURE)
        new_share[n] = share[n] * both
    new_share /= new_share.sum()
    return new_share, new_exchanged


@kernel
def _renamed(
    exchanged: float, ahead: float, usual: tuple[float, float], often: tuple[float, float], certain: float
) -> float:
    """P(names exchanged) given a direction, once the sensor may have named anew.

    Named anew, names are exchanged as often as is usual for that view: twice `often` goes by the usual share, so that
    the usual share is where it settles. `certain` is the probability that exchanged names were put right or right ones
    exchanged, whatever is usual.

    Args:
        exchanged: before.
        ahead: the cosine between the direction and that to the sensor.
        usual: how often names are exchanged of somebody who faces the sensor, and of a back.
        often: how often it names anew between two frames: in any view, and besides that side-on.
        certain: see above.
    """
    here = usual[0] + (usual[1] - usual[0]) / (1.0 + np.exp(4.0 * (ahead + 0.2)))
    anew = 2.0 * (often[0] + often[1] * np.exp(-((ahead / 0.4) ** 2)))
    to_right = min(max(anew * (1.0 - here), certain), MOST_OFTEN)
    to_exchanged = min(max(anew * here, certain), MOST_OFTEN)
    found: float = exchanged * (1.0 - to_right) + (1.0 - exchanged) * to_exchanged
    return found


@kernel
def _likelihoods(cosine: float, ahead: float, errors: tuple[float, float, float], looks: float) -> tuple[float, float]:
    """Of a line, given a direction ψ, by right names and by exchanged ones.

    p(line | ψ, right) = (1 − misled) √(κ/2π) exp(κ (cos(ψ − line) − 1)) + misled / 2π, to the power of `looks`;
    exchanged names turn the line by half a turn, which reverses the cosine's sign. κ goes from side-on to ahead with
    |cos(ψ − lens)|.
    """
    kappa_ahead, kappa_aside, misled = errors
    kappa = kappa_aside + (kappa_ahead - kappa_aside) * abs(ahead)
    height, floor = (1.0 - misled) * np.sqrt(kappa / (2 * np.pi)), misled / (2 * np.pi)
    right: float = np.exp(looks * np.log(height * np.exp(kappa * (cosine - 1.0)) + floor))
    other: float = np.exp(looks * np.log(height * np.exp(kappa * (-cosine - 1.0)) + floor))
    return right, other


@kernel
def walked(share: Floats, way: float, sure: float, forward_share: float, looks: float) -> Floats:
    """Bayes' rule (N,) for a direction of walking `way`, rad, worth so many looks: mostly people walk forwards.

    p(way | ψ) = forward √(κ/2π) exp(κ (cos(ψ − way) − 1)) + (1 − forward) / 2π, with κ = `sure`.
    """
    height, floor = forward_share * np.sqrt(sure / (2 * np.pi)), (1.0 - forward_share) / (2 * np.pi)
    found = np.empty_like(share)
    for n in range(len(share)):
        off = np.cos(_direction(n, len(share)) - way) - 1.0
        found[n] = share[n] * (height * np.exp(sure * off) + floor) ** looks
    found /= found.sum()
    return found


@kernel
def on_average(share: Floats, exchanged: Floats, row: int) -> float:
    """P(names exchanged) of one sensor, whatever the direction."""
    total = 0.0
    for n in range(len(share)):
        total += share[n] * exchanged[row, n]
    return total


@kernel
def _direction(n: int, count: int) -> float:
    return 2.0 * np.pi * n / count - np.pi
