"""Ellipsoids that hold an unknown point: outer sum and least-volume cut by a strip, for any number of them at once.

E(c, P) = {x : (x-c)' P^-1 (x-c) <= 1}. The cut is the parallel cut of Fogel and Huang (On the value of information
in system identification, Automatica 18(2), 1982), the strip first narrowed to where it touches the ellipsoid
(Belforte, Bona and Cerone, Automatica 26(5), 1990); without that it is not of least volume.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Final

import numpy as np

from fusion.estimation.measurement import Flags
from fusion.messages import Floats

LEAST_WIDTH: Final = 0.02
"""Share of the ellipsoid's own half-width below which no single cut goes, so that shapes stay well conditioned."""


@dataclass(frozen=True, slots=True)
class Ellipsoids:
    """Ellipsoids of dimension D."""

    centre: Floats  # (..., D)
    shape: Floats  # (..., D, D), symmetric and positive definite


def half_width(body: Ellipsoids) -> Floats:
    """(..., D) half the ellipsoid's extent along each coordinate."""
    squares: Floats = np.einsum("...ii->...i", body.shape)
    return np.sqrt(squares)


def outer_sum(first: Ellipsoids, second: Floats) -> Ellipsoids:
    """Hold every x + w with x in `first` and w in the ellipsoid around 0 of shape `second` (D, D).

    P/(1-b) + Q/b with b = √q/(√p + √q), for any p, q > 0 [Du2016 §2.4]. They are traces weighed by the first set's own
    axes, p = D and q = Σ Q_ii/P_ii, so that metres are not added to metres per second.
    """
    diagonal = np.einsum("...ii->...i", first.shape)
    ratio = np.sqrt((np.diagonal(second) / diagonal).mean(axis=-1))[..., None, None]  # √q/√p
    return Ellipsoids(first.centre, first.shape * (1 + ratio) + second * (1 + 1 / ratio))


def cut(body: Ellipsoids, normal: Floats, middle: Floats, half: Floats) -> tuple[Ellipsoids, Flags]:
    """Cut with the strips |n'x - middle| <= half and say which ellipsoids met their strip.

    Args:
        body: dimension D.
        normal: (D,), any length above 0.
        middle: (...) in units of n'x.
        half: (...) likewise; infinite for no cut.

    Returns:
        The least ellipsoids that hold what is in both, and (...) whether there is any such point. Where there is none
        the ellipsoid is returned as it was.
    """
    reach = body.shape @ normal  # P n
    width = np.sqrt(reach @ normal)
    offset = (middle - body.centre @ normal) / width
    low, high = np.maximum(offset - half / width, -1.0), np.minimum(offset + half / width, 1.0)
    met = low < high
    narrow = np.where(met, np.maximum((high - low) / 2, LEAST_WIDTH), 1.0)
    tilt = np.where(met, (high + low) / 2, 0.0) / narrow
    return _posterior(body, reach / width[..., None], narrow, tilt), met


def _posterior(body: Ellipsoids, reach: Floats, narrow: Floats, tilt: Floats) -> Ellipsoids:
    """The cut: c + q δ P n / (γ k) and z (P - q β P n n' P / k), with β = 1/γ², k = 1 + q β,
    z = 1 + q - q δ²/k.

    Here n is scaled so that n'P n = 1; γ is the strip's half-width, δ its middle over γ.
    """
    beta = 1 / narrow**2
    q = _least_volume_weight(reach.shape[-1], beta, tilt)
    k = 1 + q * beta
    centre = body.centre + (q * tilt / (narrow * k))[..., None] * reach
    outer = reach[..., :, None] * reach[..., None, :]
    grown = (1 + q - q * tilt**2 / k)[..., None, None]
    return Ellipsoids(centre, grown * (body.shape - (q * beta / k)[..., None, None] * outer))


def _least_volume_weight(dimension: int, beta: Floats, tilt: Floats) -> Floats:
    """Root q >= 0 of (D-1) β² q² + (2D-1-β+δ²) β q + D(1-δ²) - β = 0; 0 where the strip does not help."""
    a = (dimension - 1) * beta**2
    b = (2 * dimension - 1 - beta + tilt**2) * beta
    c = dimension * (1 - tilt**2) - beta
    root = (-b + np.sqrt(np.maximum(b**2 - 4 * a * c, 0.0))) / (2 * a)
    return np.where(c < 0, np.maximum(root, 0.0), 0.0)


def choose(which: Flags, yes: Ellipsoids, no: Ellipsoids) -> Ellipsoids:
    """One by one, the first where `which` (...), else the second."""
    centre = np.where(which[..., None], yes.centre, no.centre)
    return Ellipsoids(centre, np.where(which[..., None, None], yes.shape, no.shape))
