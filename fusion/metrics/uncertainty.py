"""How sure a session's figure is, from how much it varied within the session; and what change is more than that."""

from __future__ import annotations

from collections.abc import Callable, Iterable
from math import sqrt
from typing import Final

import numpy as np

from fusion.messages import Floats

RESAMPLES: Final = 200
SEED: Final = 20260101
"""The same session always gives the same figures."""
FEWEST: Final = 5
"""Of fewer movements or attempts nobody can say how much they vary."""
BATCHES: Final = 10
SHORTEST_BATCH: Final = 100
"""Ticks; shorter batches would be parts of one movement."""
Z_95: Final = 1.96


def bootstrap_sem(values: Floats, statistic: Callable[..., Floats] = np.median) -> float | None:
    """Standard error of a statistic over movements or attempts, by drawing them again with replacement.

    Efron, "Bootstrap methods: another look at the jackknife", Annals of Statistics 7:1 (1979).

    Args:
        values: (N,), taken to be independent.
        statistic: such as `np.median`; takes an axis.
    """
    if len(values) < FEWEST:
        return None
    drawn = np.random.default_rng(SEED).integers(0, len(values), (RESAMPLES, len(values)))
    return float(statistic(values[drawn], axis=1).std(ddof=1))


def batch_sem(samples: Floats, statistic: Callable[[Floats], float | None]) -> float | None:
    """Standard error of a statistic over time, by batch means: ticks depend on each other, long batches hardly do.

    The statistic of each of ten batches one after the other; their standard deviation over the root of their number.

    Args:
        samples: (N, ...) in the order of time.
        statistic: of one batch; None where it cannot be told.
    """
    if len(samples) < BATCHES * SHORTEST_BATCH:
        return None
    told = [value for batch in np.array_split(samples, BATCHES) if (value := statistic(batch)) is not None]
    return mean_sem(np.array(told))


def mean_sem(values: Floats) -> float | None:
    """Standard error of a mean: s / √n."""
    return float(values.std(ddof=1)) / sqrt(len(values)) if len(values) >= FEWEST else None


def share_sem(hits: int, tries: int) -> float | None:
    """Standard error of a share, √(p(1 − p)/n) with p = (hits + 1)/(n + 2), which is never quite sure."""
    share = (hits + 1) / (tries + 2)
    return sqrt(share * (1.0 - share) / tries) if tries >= FEWEST else None


def minimal_detectable_change(sems: Iterable[float | None], camera_error: float = 0.0) -> float | None:
    """MDC95 = 1.96 √2 SEM: a difference between two sessions that is larger is, 19 times in 20, more than chance.

    SEM² is the mean square of the sessions' own standard errors, and that of the cameras' error from session to
    session, which no session tells by itself. What changes from day to day (mood, tiredness) is in neither, so the true
    MDC is larger.
    """
    known = np.array([sem for sem in sems if sem is not None])
    if not len(known):
        return None
    return Z_95 * sqrt(2.0 * (float((known**2).mean()) + camera_error**2))


def wandering_sem(values: Floats) -> float | None:
    """Standard error of the mean of values each of which depends on the one before, such as an adapted difficulty: of
    five batches one after the other; None with fewer than two values in each.
    """
    if len(values) < 2 * FEWEST:
        return None
    return mean_sem(np.array([batch.mean() for batch in np.array_split(values, FEWEST)]))
