"""How far one sensor's clock is from another's: from receive times, or from how the joints move.

Sign: ``t_reference = t_sensor - offset``.
"""

from __future__ import annotations

from collections import deque
from dataclasses import dataclass
from math import ceil, log2
from typing import Any

import numpy as np
from numpy.typing import NDArray

from fusion.align.track import BodyTrack
from fusion.messages import Floats
from fusion.skeleton import TrackingState

Singles = NDArray[np.float32]
Spectra = NDArray[np.complexfloating[Any, Any]]

GRID_HZ = 60.0
SPEED_SPAN_S = 0.05
"""Half the span over which speeds are taken; short, for a sharp peak."""
PEAKS_APART_S = 0.15
FASTEST_M_S = 3.0
"""Faster than this is a wandering joint, not a limb in therapy; speeds are cut here."""
LEAST_COMMON_SHARE = 0.5
"""A lag counts only where this share of the best possible overlap is left: short overlaps correlate by chance."""
MINIMUM_WINDOW_S = 30.0
"""Receive minima are taken over one to two of these, so that a drifting clock is followed."""


@dataclass(frozen=True, slots=True)
class OffsetCandidate:
    """A clock offset at which the two speed signals agree, and how well (correlation, at most 1)."""

    offset_s: float
    correlation: float


def offset_candidates(
    reference: BodyTrack, sensor: BodyTrack, longest_s: float = np.inf, count: int = 5
) -> tuple[OffsetCandidate, ...]:
    """Offsets at which the joints' speeds correlate best, best first.

    Speeds do not depend on the mounting, so this needs no alignment in space. Every joint is its own channel; instants
    at which a joint is not seen take no part. The peak is found to a part of the grid by a parabola.

    Args:
        reference: the reference sensor's body.
        sensor: the same person in the other sensor.
        longest_s: the largest absolute offset to consider.
        count: how many to give.
    """
    ours, ours_known = _speeds(reference)
    theirs, theirs_known = _speeds(sensor)
    correlation, lags = _correlation(ours, ours_known, theirs, theirs_known)
    offsets = lags / GRID_HZ + sensor.t_s[0] - reference.t_s[0]
    correlation = np.where(np.abs(offsets) <= longest_s, correlation, -1.0)
    return tuple(
        OffsetCandidate(float(offsets[k] + _vertex(correlation, k) / GRID_HZ), float(correlation[k]))
        for k in _peaks(correlation, count)
    )


def _peaks(correlation: Floats, count: int) -> list[int]:
    """Where it is positive and highest, best first; of two maxima too close together only the higher one."""
    around = np.concatenate([[-1.0], correlation, [-1.0]])
    maxima = np.flatnonzero((correlation > 0) & (correlation > around[:-2]) & (correlation >= around[2:]))
    found: list[int] = []
    for k in maxima[np.argsort(-correlation[maxima])].tolist():
        if len(found) < count and all(abs(k - other) >= PEAKS_APART_S * GRID_HZ for other in found):
            found.append(k)
    return found


def _speeds(track: BodyTrack) -> tuple[Singles, Singles]:
    """Speeds (J, M) on a steady grid with each joint's mean taken off, and where they are known (1 or 0).

    Single precision: it is only asked where a sum over all joints is largest, and takes half the time.
    """
    grid = np.arange(track.t_s[0], track.t_s[-1], 1.0 / GRID_HZ)
    moved_m, seen = track.moved_around(grid, SPEED_SPAN_S)
    known = (seen == TrackingState.TRACKED).astype(np.float32)
    speeds = known * np.minimum(moved_m / (2 * SPEED_SPAN_S), FASTEST_M_S)
    mean = speeds.sum(axis=1) / np.maximum(known.sum(axis=1), 1)
    return known * (speeds - mean[:, None]), known


def _correlation(a: Singles, a_known: Singles, b: Singles, b_known: Singles) -> tuple[Floats, Floats]:
    """Normalised correlation over every lag of b behind a (in grid steps, ascending), all joints summed."""
    lengths = a.shape[1], b.shape[1]
    size = _fast_length(sum(lengths))
    ours, our_energy, ours_known = (np.fft.rfft(x, size) for x in (a, a**2, a_known))
    theirs, their_energy, theirs_known = (np.fft.rfft(x, size) for x in (b, b**2, b_known))

    def lagged(x: Spectra, y: Spectra) -> Floats:
        summed: Floats = np.fft.irfft(np.einsum("jf,jf->f", np.conj(x), y), size).astype(np.float64)
        return np.concatenate([summed[size - lengths[0] + 1 :], summed[: lengths[1]]])

    common = lagged(ours_known, theirs_known)
    energy = np.sqrt(np.maximum(lagged(our_energy, theirs_known) * lagged(ours_known, their_energy), 1e-12))
    share = np.clip(common / max(float(common.max(initial=0.0)), 1.0), 0, 1)
    correlation = np.where(share > LEAST_COMMON_SHARE, lagged(ours, theirs) / energy * np.sqrt(share), -1.0)
    return correlation, np.arange(-lengths[0] + 1.0, lengths[1])


def _fast_length(least: int) -> int:
    """A length not much above `least` that a Fourier transform is quick at: a power of two times 1, 3, 5, 9 or 15."""
    return min(odd << max(0, ceil(log2(least / odd))) for odd in (1, 3, 5, 9, 15))


def _vertex(values: Floats, k: int) -> float:
    """Where the parabola through three neighbours peaks, in grid steps from k."""
    if not 0 < k < len(values) - 1:
        return 0.0
    left, middle, right = values[k - 1 : k + 2]
    bend = left - 2 * middle + right
    return float(0.5 * (left - right) / bend) if bend < 0 and min(left, right) > -1 else 0.0


class ReceiveClock:
    """Puts a sender's own clock onto the receive clock: the least delay ever seen is taken for no delay.

    Delays only lengthen, so min(receive - sent) approaches the clocks' difference from above. Where the sender has no
    clock both times are equal and nothing changes.
    """

    def __init__(self) -> None:
        self._older_s, self._newer_s = np.inf, np.inf
        self._window_ends_s = -np.inf
        self._differences: deque[float] = deque(maxlen=90)

    def on_receive_clock(self, t_s: float, t_received_s: float) -> float:
        """Take a frame's two times; give its time on the receive clock."""
        difference = t_received_s - t_s
        if t_received_s > self._window_ends_s:
            self._older_s, self._newer_s = self._newer_s, difference
            self._window_ends_s = t_received_s + MINIMUM_WINDOW_S
        self._newer_s = min(self._newer_s, difference)
        self._differences.append(difference)
        return t_s + self.difference_s

    @property
    def difference_s(self) -> float:
        """Receive clock minus sender's clock."""
        return min(self._older_s, self._newer_s)

    @property
    def delay_s(self) -> float:
        """Median delay of the last frames beyond the least delay seen."""
        ordered = sorted(self._differences)
        return ordered[len(ordered) // 2] - self.difference_s if ordered else 0.0
