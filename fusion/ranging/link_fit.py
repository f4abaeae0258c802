"""The link model that explains some seconds of ranges best, held by what is plausible of radios.

Least squares over all links together, min Σ w (e − X θ)² / s² + Σ θ² / σ_θ²: some seconds visit few distances and
bearings, and what they do not show is better thought small. Cauchy weights w keep wrong echoes from counting.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Final

import numpy as np

from fusion.errors import InputError
from fusion.messages import Floats
from fusion.ranging.links import HARMONICS, LinkModel, growth, harmonics

OUTLIER_M: Final = 0.4
WRONG_ECHO_M: Final = 0.12
"""Residual at which a range counts half."""
ROUNDS: Final = 4
ONE_RANGE_M: Final = 0.06
ALIKE: Final = 10.0
"""Neighbouring residuals say the same thing: so many count as one."""
_SCALE_M2: Final = ONE_RANGE_M**2 * ALIKE
COMMON_M: Final = 1.0
LINK_M: Final = 0.1
GROWTH_M: Final = (0.05, 0.02)
PATTERN_M: Final = 0.04
"""What is plausible (one sigma) of the bias that all share, of a link's own, of its growth, of each wave's size."""
LEAST_SIGMA_M: Final = 0.03
LEAST_COHERENCE_S: Final = 0.1
MOST_COHERENCE_S: Final = 2.0
UNRELATED: Final = 0.1


@dataclass(frozen=True, slots=True)
class Fitted:
    """A model, and how implausible it leaves things: −2 log of the posterior, but for a constant."""

    links: LinkModel
    cost: float


def fit_links(excess: Floats, distance: Floats, bearing: Floats) -> Fitted:
    """Learn the model.

    Args:
        excess: (E, A, K) range − distance in m, NaN where there is none.
        distance: (E, A, K) m.
        bearing: (E, A, K) rad from the tag to the anchor, counted from where the tag points; NaN where nobody knows.

    Raises:
        InputError: a link has no range while there is truth.
    """
    if not np.isfinite(excess).any(axis=0).all():
        raise InputError("a link has no range while there is truth", "ranges of every link", "calibrate for longer")
    _, anchors, tags = excess.shape
    rows, plausible = _rows(distance, bearing), _plausible(anchors, tags)
    use = np.abs(excess - np.nanmedian(excess, axis=0)) < OUTLIER_M  # NaN compares false
    solved = _solved(rows[use], excess[use], plausible)
    common, link, growing, pattern = np.split(solved, np.cumsum([1, anchors * tags, 2]))
    left_m = (excess - rows @ solved)[use]
    sigma = max(float(np.std(left_m)), LEAST_SIGMA_M)
    bias = common + link.reshape(anchors, tags)
    links = LinkModel(bias, pattern.reshape(tags, 2 * HARMONICS), growing, sigma, wander_m=0.0)
    return Fitted(links, _cost(left_m) + float(np.sum((solved / plausible) ** 2)))


def _cost(left_m: Floats) -> float:
    return float(np.sum(np.log1p((left_m / WRONG_ECHO_M) ** 2))) * WRONG_ECHO_M**2 / _SCALE_M2


def _rows(distance: Floats, bearing: Floats) -> Floats:  # (E, A, K, 1 + A K + 2 + 2 HARMONICS K)
    instants, anchors, tags = distance.shape
    links = np.broadcast_to(
        np.eye(anchors * tags).reshape(anchors, tags, -1), (instants, anchors, tags, anchors * tags)
    )
    waves = np.nan_to_num(harmonics(bearing))
    own = np.einsum("eakm,kl->eaklm", waves, np.eye(tags)).reshape(instants, anchors, tags, -1)
    grows = np.nan_to_num(growth(distance))
    return np.concatenate([np.ones((instants, anchors, tags, 1)), links, grows, own], axis=-1)


def _plausible(anchors: int, tags: int) -> Floats:
    sizes = [[COMMON_M], [LINK_M] * (anchors * tags), GROWTH_M, [PATTERN_M] * (2 * HARMONICS * tags)]
    return np.concatenate(sizes)


def _solved(rows: Floats, excess: Floats, plausible: Floats) -> Floats:
    left = excess - np.median(excess)
    for _ in range(ROUNDS):
        weighted = rows * (1 / (1 + (left / WRONG_ECHO_M) ** 2))[:, None]
        solved = np.linalg.solve(
            rows.T @ weighted / _SCALE_M2 + np.diag(plausible**-2), weighted.T @ excess / _SCALE_M2
        )
        left = excess - rows @ solved
    return np.asarray(solved)


def coherence_s(left: Floats, step_s: float) -> float:
    """For how long residuals (E, L) at even steps stay alike: τ = Δt (½ + Σ ρ_l) up to where ρ falls below a tenth."""
    clipped = np.clip(np.nan_to_num(left - np.nanmean(left, axis=0)), -OUTLIER_M, OUTLIER_M)
    whole, total_s = float(np.mean(clipped**2)), 0.5 * step_s
    for lag in range(1, min(len(clipped), round(MOST_COHERENCE_S / step_s))):
        alike = float(np.mean(clipped[lag:] * clipped[:-lag])) / whole
        if alike < UNRELATED:
            break
        total_s += alike * step_s
    return float(np.clip(total_s, LEAST_COHERENCE_S, MOST_COHERENCE_S))
