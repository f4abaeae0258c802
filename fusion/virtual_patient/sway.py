"""How a trunk that keeps still does not: smooth random turning about three axes."""

from __future__ import annotations

from math import sqrt
from typing import Final

import numpy as np

from fusion.messages import Floats

_RATE_RAD_S: Final = 2.0
"""Natural frequency; the trunk wanders over a second or so."""
_LONGEST_STEP_S: Final = 0.05


class Sway:
    """A critically damped spring driven by white noise: x″ = −2ωx′ − ω²x + n, with n's density 4ω³σ² so that std x = σ.

    Args:
        std_rad: (3,) standard deviation of each angle.
        rng: source of the noise.
    """

    def __init__(self, std_rad: Floats, rng: np.random.Generator) -> None:
        self.angles_rad: Floats = np.zeros(3)
        self._rates: Floats = np.zeros(3)
        self._drive: Floats = sqrt(4 * _RATE_RAD_S**3) * std_rad
        self._rng = rng

    def step(self, dt_s: float) -> None:
        """Go on for `dt_s`, in steps short enough to be stable."""
        steps = max(1, int(np.ceil(dt_s / _LONGEST_STEP_S)))
        for _ in range(steps):
            self._short_step(dt_s / steps)

    def _short_step(self, dt_s: float) -> None:
        pull = -2 * _RATE_RAD_S * self._rates - _RATE_RAD_S**2 * self.angles_rad
        self._rates = self._rates + pull * dt_s + self._drive * sqrt(dt_s) * self._rng.standard_normal(3)
        self.angles_rad = self.angles_rad + self._rates * dt_s
