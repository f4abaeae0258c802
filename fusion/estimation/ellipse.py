"""An ellipse in [position; velocity] that holds an unknown state: outer sum and least-area cut by a strip.

E(c, P) = {x : (x-c)' P^-1 (x-c) <= 1}. The cut is the parallel cut of Fogel and Huang (On the value of information
in system identification, Automatica 18(2), 1982), the strip first narrowed to where it touches the ellipse
(Belforte, Bona and Cerone, Automatica 26(5), 1990); without that it is not of least area.
"""

from __future__ import annotations

from math import sqrt
from typing import Final, NamedTuple, TypeAlias

from fusion.compiled import kernel

LEAST_WIDTH: Final = 0.02
"""Share of the ellipse's own half-width below which no single cut goes, so that shapes stay well conditioned."""
DIMENSION: Final = 2.0
Normal: TypeAlias = tuple[float, float]


class Ellipse(NamedTuple):
    """Centre (p, v) and shape [[pp, pv], [pv, vv]], symmetric because it is written once, and positive definite."""

    p: float
    v: float
    pp: float
    pv: float
    vv: float


@kernel
def outer_sum(first: Ellipse, pp: float, pv: float, vv: float) -> Ellipse:
    """Hold every x + w with x in `first` and w in the ellipse around 0 of the given shape Q.

    P/(1-b) + Q/b with b = √q/(√p + √q), for any p, q > 0 [Du2016 §2.4]. They are traces weighed by the first set's own
    axes, p = 2 and q = Σ Q_ii/P_ii, so that metres are not added to metres per second.
    """
    ratio = sqrt((pp / first.pp + vv / first.vv) / DIMENSION)  # √q/√p
    ours, theirs = 1 + ratio, 1 + 1 / ratio
    return Ellipse(
        first.p, first.v, first.pp * ours + pp * theirs, first.pv * ours + pv * theirs, first.vv * ours + vv * theirs
    )


@kernel
def cut(body: Ellipse, normal: Normal, middle: float, half: float) -> tuple[Ellipse, bool]:
    """Cut with the strip |n'x - middle| <= half and say whether the ellipse met it.

    Args:
        body: what is cut.
        normal: n, any length above 0.
        middle: in units of n'x.
        half: likewise; infinite for no cut.

    Returns:
        The least ellipse that holds what is in both, and whether there is any such point. Where there is none the
        ellipse is returned as it was.
    """
    reach_p = body.pp * normal[0] + body.pv * normal[1]  # P n
    reach_v = body.pv * normal[0] + body.vv * normal[1]
    width = sqrt(reach_p * normal[0] + reach_v * normal[1])
    offset = (middle - body.p * normal[0] - body.v * normal[1]) / width
    low, high = max(offset - half / width, -1.0), min(offset + half / width, 1.0)
    if not low < high:
        return body, False
    narrow = max((high - low) / 2, LEAST_WIDTH)
    return _posterior(body, reach_p / width, reach_v / width, narrow, (high + low) / 2 / narrow), True


@kernel
def _posterior(body: Ellipse, reach_p: float, reach_v: float, narrow: float, tilt: float) -> Ellipse:
    """The cut: c + q δ P n / (γ k) and z (P - q β P n n' P / k), with β = 1/γ², k = 1 + q β,
    z = 1 + q - q δ²/k.

    Here n is scaled so that n'P n = 1; γ is the strip's half-width, δ its middle over γ.
    """
    beta = 1 / narrow**2
    q = _least_area_weight(beta, tilt)
    k = 1 + q * beta
    shift = q * tilt / (narrow * k)
    z, less = 1 + q - q * tilt**2 / k, q * beta / k
    return Ellipse(
        body.p + shift * reach_p,
        body.v + shift * reach_v,
        z * (body.pp - less * reach_p * reach_p),
        z * (body.pv - less * reach_p * reach_v),
        z * (body.vv - less * reach_v * reach_v),
    )


@kernel
def _least_area_weight(beta: float, tilt: float) -> float:
    """Root q >= 0 of (D-1) β² q² + (2D-1-β+δ²) β q + D(1-δ²) - β = 0 with D = 2; 0 where the strip does not help."""
    a = (DIMENSION - 1) * beta**2
    b = (2 * DIMENSION - 1 - beta + tilt**2) * beta
    c = DIMENSION * (1 - tilt**2) - beta
    if not c < 0:
        return 0.0
    return max((-b + sqrt(max(b * b - 4 * a * c, 0.0))) / (2 * a), 0.0)
