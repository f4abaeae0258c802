"""Where a lone tag points: the way it travels, for whoever carries it mostly walks ahead."""

from __future__ import annotations

from typing import Final

import numpy as np

from fusion.messages import Floats
from fusion.ranging.ranges import interpolated

TRAVELS_M_S: Final = 0.2
"""Slower than that the direction of travel is noise, and the last one counts."""
HALF_S: Final = 0.3


def directions(truth_t_s: Floats, truth: Floats, at_s: Floats) -> Floats:
    """The way each tag (T, K, 3) travels at some instants, (N, K) rad about up; NaN until it has moved."""
    step = interpolated(truth_t_s, truth, at_s + HALF_S) - interpolated(truth_t_s, truth, at_s - HALF_S)
    travels = np.hypot(step[..., 0], step[..., 1]) > TRAVELS_M_S * 2 * HALF_S  # NaN compares false
    latest = np.maximum.accumulate(np.where(travels, np.arange(len(at_s))[:, None], 0), axis=0)
    found = np.where(travels, np.arctan2(step[..., 1], step[..., 0]), np.nan)
    return np.asarray(np.take_along_axis(found, latest, axis=0))
