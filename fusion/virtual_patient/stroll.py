"""How a whole body shifts about its place: to and fro, from foot to foot, as slow waves that never quite repeat."""

from __future__ import annotations

from math import pi
from typing import Final

import numpy as np

from fusion.messages import Floats

_PERIODS_S: Final = (4.0, 15.0)
_WAVES: Final = 3


class Stroll:
    """A level path as a sum of sines per axis, so that speed and acceleration stay a person's.

    Args:
        std_m: standard deviation along x and along z.
        seed: of periods and phases.
    """

    def __init__(self, std_m: float, seed: int) -> None:
        rng = np.random.default_rng([seed, 7])
        self._size_m = std_m * np.sqrt(2 / _WAVES) * np.array([1.0, 0.0, 1.0])
        self._rate = 2 * pi / rng.uniform(*_PERIODS_S, (_WAVES, 3))
        self._phase = rng.uniform(0.0, 2 * pi, (_WAVES, 3))

    def at(self, t_s: float) -> Floats:
        """(3,) m from the patient's place."""
        waves = np.sin(self._rate * t_s + self._phase).sum(axis=0)
        return np.asarray(self._size_m * waves)
