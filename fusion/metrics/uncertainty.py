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


def minimal_detectable_change(sems: Iterable[float | None]) -> float | None:
    """MDC95 = 1.96 √2 SEM: a difference between two sessions that is larger is, 19 times in 20, more than chance.

    SEM is the root mean square of the sessions' own standard errors. They come from within each session, so that what
    changes from day to day (mood, tiredness, how the sensors stand) is not in them, and the true MDC is larger.
    """
    known = np.array([sem for sem in sems if sem is not None])
    return Z_95 * sqrt(2.0) * float(np.sqrt((known**2).mean())) if len(known) else None
