"""Unbroken stretches of a session at an even rate: what filters and spectra need."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Final

import numpy as np
from scipy.signal import butter, sosfiltfilt

from fusion.messages import Flags, Floats

RATE_HZ: Final = 50.0
LONGEST_GAP_S: Final = 0.25
SHORTEST_S: Final = 1.0
LOW_PASS_HZ: Final = 3.0
"""Half of what optical studies use: between 3 and 6 Hz a depth camera's hand holds more noise than movement."""


@dataclass(frozen=True, slots=True)
class Stretch:
    """Values on an even grid."""

    t_s: Floats  # (N,)
    values: Floats  # (N, D)


def stretches(t_s: Floats, usable: Flags, values: Floats) -> list[Stretch]:
    """The stretches where `usable` holds, no value is missing and no gap exceeds a quarter of a second, at 50 Hz.

    Args:
        t_s: (T,) rising.
        usable: (T,).
        values: (T, D); linear interpolation between ticks.
    """
    good = usable & np.isfinite(values).all(axis=1)
    broken = ~good[1:] | ~good[:-1] | (np.diff(t_s) > LONGEST_GAP_S)
    pieces = np.split(np.arange(len(t_s)), np.flatnonzero(broken) + 1)
    return [_even(t_s[piece], values[piece]) for piece in pieces if _lasts(t_s[piece])]


def _lasts(t_s: Floats) -> bool:
    return len(t_s) > 1 and float(t_s[-1] - t_s[0]) >= SHORTEST_S


def _even(t_s: Floats, values: Floats) -> Stretch:
    grid = np.arange(t_s[0], t_s[-1], 1.0 / RATE_HZ)
    return Stretch(grid, np.column_stack([np.interp(grid, t_s, column) for column in values.T]))


def low_passed(stretch: Stretch) -> Stretch:
    """The stretch through a second-order Butterworth low-pass at 3 Hz, forward and backward (no delay).

    The filter of Alt Murphy, Willén, Sunnerhagen, Neurorehabil Neural Repair 25:71 (2011), there at 6 Hz.
    """
    sections = butter(2, LOW_PASS_HZ, fs=RATE_HZ, output="sos")
    return Stretch(stretch.t_s, sosfiltfilt(sections, stretch.values, axis=0))
