"""Delay and error of one angle against the truth."""

from __future__ import annotations

from dataclasses import dataclass
from math import degrees
from typing import Final

import numpy as np

from fusion.messages import Floats
from server.experiments.cranked.station import DT_S

SETTLED: Final = 400
"""Ticks at the beginning that are not judged."""
LONGEST: Final = 40
"""Ticks of delay that are looked at."""
JUDGED: Final = 6
"""60 ms."""


@dataclass(frozen=True, slots=True)
class Score:
    """How far off, in degrees, and how late."""

    delay_ms: float
    """The shift with the least error: also where the correlation with the truth is largest."""
    at_delay_deg: float
    """Error (rms) at that shift."""
    at_60_deg: float
    """Against the truth of 60 ms ago."""
    now_deg: float
    """Against the undelayed truth."""
    acceleration_rad_s2: float
    """Of the output, one standard deviation."""


def score(found_rad: Floats, truth_rad: Floats) -> Score:
    """Judge one angle (T,)."""
    errors = [rms_deg(found_rad, truth_rad, delay) for delay in range(LONGEST + 1)]
    best = int(np.argmin(errors))
    bends = np.diff(found_rad[SETTLED:], 2) / DT_S**2
    return Score(1e3 * best * DT_S, errors[best], errors[JUDGED], errors[0], float(bends.std()))


def rms_deg(found_rad: Floats, truth_rad: Floats, delay: int) -> float:
    """Error against the truth so many ticks ago."""
    off = (found_rad - delayed(truth_rad, delay))[SETTLED + LONGEST :]
    return degrees(float(np.sqrt(np.mean(off**2))))


def delayed(truth_rad: Floats, ticks: int) -> Floats:
    """(T,) the truth so many ticks ago."""
    return np.concatenate([np.full(ticks, truth_rad[0]), truth_rad[: len(truth_rad) - ticks]])
