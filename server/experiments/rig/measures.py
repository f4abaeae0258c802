"""Percentiles, as every experiment of the real processes gives them."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np


@dataclass(frozen=True, slots=True)
class Percentiles:
    """Of some times, in milliseconds."""

    count: int
    p50_ms: float
    p99_ms: float
    max_ms: float

    @property
    def words(self) -> str:
        """For people."""
        return f"{self.p50_ms:.2f} / {self.p99_ms:.2f} / {self.max_ms:.2f} ms"


def percentiles(times_s: Sequence[float]) -> Percentiles:
    """Of times in seconds; of none, no numbers."""
    if not times_s:
        return Percentiles(0, math.nan, math.nan, math.nan)
    p50, p99, most = np.percentile(np.array(times_s) * 1e3, (50, 99, 100))
    return Percentiles(len(times_s), float(p50), float(p99), float(most))
