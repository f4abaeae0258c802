"""How a link between an anchor and a tag misjudges the distance, and by how much it wavers."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Final

import numpy as np

from fusion.messages import Floats

UNKNOWN_SIGMA_M: Final = 0.10
UNKNOWN_WANDER_M: Final = 0.20
UNKNOWN_COHERENCE_S: Final = 0.05
HARMONICS: Final = 3
MIDDLE_M: Final = 3.5
SPAN_M: Final = 2.0
"""Distances are counted from the middle of a room, in half its width, so that slope and bend are alike in size."""


@dataclass(frozen=True, slots=True)
class LinkModel:
    """range = distance + bias[a, k] + g1 δ + g2 δ² + Σ_m (c_km cos mρ + s_km sin mρ) + error.

    δ = (distance − 3.5 m) / 2 m: a receiver takes a weaker signal to come later, and all links share how much. ρ is the
    bearing at which the tag's antenna sees the anchor, counted from where the rig points (or a lone tag travels): an
    antenna's delay depends on where the wave comes from, and the body it is fixed to shadows one side.
    """

    bias_m: Floats  # (A, K)
    pattern_m: Floats  # (K, 2 · HARMONICS): cos ρ, sin ρ, cos 2ρ, …
    growth_m: Floats  # (2,): g1, g2
    sigma_m: float = UNKNOWN_SIGMA_M
    """Deviation of one range, white and slow together."""
    coherence_s: float = UNKNOWN_COHERENCE_S
    """For so long a link errs alike: the integral of the errors' autocorrelation."""
    wander_m: float = UNKNOWN_WANDER_M
    """Deviation of a link's lasting error: what was never learnt."""

    def expected_bias(self, bearing_rad: Floats, distance_m: Floats) -> Floats:
        """What to take off the ranges, (A, K), with the bearings and distances (A, K)."""
        pattern = np.einsum("akm,km->ak", harmonics(bearing_rad), self.pattern_m)
        return np.asarray(self.bias_m + growth(distance_m) @ self.growth_m + pattern)

    def variance_m2(self, since_s: Floats) -> Floats:
        """How much a range may count, so long after its link's last one: σ² coth(Δt / 2τ).

        A filter that takes errors for white must be told the white error that does the same harm. For a first-order
        Gauss-Markov error with φ = exp(−Δt / τ) it is σ² (1 + φ) / (1 − φ); σ² when the last one is long ago.
        """
        return np.asarray(self.sigma_m**2 / np.tanh(since_s / (2 * self.coherence_s)))


def unknown_links(anchors: int, tags: int) -> LinkModel:
    """Nothing learnt yet."""
    return LinkModel(np.zeros((anchors, tags)), np.zeros((tags, 2 * HARMONICS)), np.zeros(2))


def harmonics(bearing_rad: Floats) -> Floats:
    """Cos mρ, sin mρ for m = 1 … HARMONICS as a last axis."""
    waves = [wave(m * bearing_rad) for m in range(1, HARMONICS + 1) for wave in (np.cos, np.sin)]
    return np.stack(waves, axis=-1)


def growth(distance_m: Floats) -> Floats:
    """δ and δ² as a last axis."""
    scaled = (distance_m - MIDDLE_M) / SPAN_M
    return np.stack([scaled, scaled**2], axis=-1)
