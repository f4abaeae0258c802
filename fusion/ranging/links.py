"""How a link between an anchor and a tag misjudges the distance, and by how much it wavers."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Final

import numpy as np

from fusion.messages import Floats

UNKNOWN_SIGMA_M: Final = 0.10
UNKNOWN_WANDER_M: Final = 0.20
HARMONICS: Final = 2


@dataclass(frozen=True, slots=True)
class LinkModel:
    """range = distance + bias[a, k] + Σ_m (c_km cos mρ + s_km sin mρ) + noise.

    ρ is the bearing at which the tag's antenna sees the anchor, counted from the rig's own direction: an antenna's
    delay depends on where the wave comes from, and the body it is fixed to shadows one side. A term that grows with
    distance was tried on `uwb-fast` and made the rest of the run worse (docs/ranging.md), so there is none.
    """

    bias_m: Floats  # (A, K)
    pattern_m: Floats  # (K, 2 · HARMONICS): cos ρ, sin ρ, cos 2ρ, sin 2ρ
    sigma_m: float = UNKNOWN_SIGMA_M
    """Deviation of one range, white and slow together."""
    wander_m: float = UNKNOWN_WANDER_M
    """Deviation of a link's slow error: what no averaging takes away."""

    def expected_bias(self, bearing_rad: Floats) -> Floats:
        """What to take off the ranges, (A, K), with the bearings (A, K)."""
        return np.asarray(self.bias_m + np.einsum("akm,km->ak", harmonics(bearing_rad), self.pattern_m))


def unknown_links(anchors: int, tags: int) -> LinkModel:
    """Nothing learnt yet."""
    return LinkModel(np.zeros((anchors, tags)), np.zeros((tags, 2 * HARMONICS)))


def harmonics(bearing_rad: Floats) -> Floats:
    """Cos mρ, sin mρ for m = 1 … HARMONICS as a last axis."""
    waves = [wave(m * bearing_rad) for m in range(1, HARMONICS + 1) for wave in (np.cos, np.sin)]
    return np.stack(waves, axis=-1)
