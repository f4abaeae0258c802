"""How alike the two arms moved, and how far the affected one was behind."""

from __future__ import annotations

from dataclasses import dataclass
from math import pi, radians, sqrt
from typing import Final

import numpy as np

from fusion.messages import Floats
from fusion.metrics.metric import PASSIVE_DRIVE, Metric
from fusion.metrics.range_of_movement import told
from fusion.metrics.record import JOINTS, SessionRecord
from fusion.metrics.stretches import RATE_HZ, stretches
from fusion.metrics.uncertainty import mean_sem

LARGEST_LEAD_S, LARGEST_LAG_S = 0.2, 1.0
SHORTEST_S: Final = 5.0
"""Engaged and seen for less in all, nothing is said."""
LEAST_SPREAD_RAD: Final = radians(5.0)
"""Of a joint that hardly moved, lag and symmetry would be those of the sensors' noise, which is 2 to 4°."""
BATCH_S: Final = 10.0
"""What varies from one such span to the next tells how sure lag and symmetry are."""


@dataclass(frozen=True, slots=True)
class Likeness:
    """Two arms' agreement in one joint."""

    lag_s: float
    """Positive: the affected arm follows."""
    symmetry: float
    """Concordance at that lag: 1 = the same movement, 0 = unrelated."""


def symmetry_metrics(record: SessionRecord) -> list[Metric]:
    """Symmetry and lag per joint while the arm was driven."""
    caveat = PASSIVE_DRIVE if record.is_driven else None
    found: list[Metric] = []
    for joint in JOINTS:
        pairs = _pairs(record, joint)
        alike = likeness(pairs)
        if alike is not None:
            symmetry_sem, lag_sem = _sems(pairs)
            found.append(Metric("symmetry", alike.symmetry, "1", joint, caveat_key=caveat, sem=symmetry_sem))
            found.append(Metric("lag", alike.lag_s, "s", joint, caveat_key=caveat, sem=lag_sem))
    return found


def _sems(pairs: list[Floats]) -> tuple[float | None, float | None]:
    """Standard errors of symmetry and lag, from spans of ten seconds."""
    size = round(BATCH_S * RATE_HZ)
    spans = [pair[start : start + size] for pair in pairs for start in range(0, len(pair) - size + 1, size)]
    told = [alike for span in spans if (alike := likeness([span])) is not None]
    return mean_sem(np.array([one.symmetry for one in told])), mean_sem(np.array([one.lag_s for one in told]))


def _pairs(record: SessionRecord, joint: str) -> list[Floats]:
    """Healthy and affected angle (N, 2) in every unbroken stretch."""
    column = JOINTS.index(joint)
    usable = record.engaged & record.healthy_valid & told(record.healthy_rad, joint)
    healthy, affected = record.healthy_rad[:, column], record.affected_rad[:, column]
    near = affected + 2.0 * pi * np.round((healthy - affected) / (2.0 * pi))  # the same turn as the healthy angle
    return [piece.values for piece in stretches(record.t_s, usable, np.column_stack([healthy, near]))]


def likeness(pairs: list[Floats]) -> Likeness | None:
    """Lag of the largest correlation, and Lin's concordance there; None where there is too little movement.

    ρ_c = 2 cov(h, a) / (var h + var a + (mean h − mean a)²), Lin, Biometrics 45:255 (1989).

    Args:
        pairs: (N, 2) healthy and affected angle in rad at `RATE_HZ`, one array per stretch.
    """
    lags = range(-round(LARGEST_LEAD_S * RATE_HZ), round(LARGEST_LAG_S * RATE_HZ) + 1)
    longest = max(abs(lag) for lag in lags)
    pairs = [pair for pair in pairs if len(pair) > 2 * longest]
    if sum(len(pair) for pair in pairs) < SHORTEST_S * RATE_HZ:
        return None
    if min(np.concatenate(pairs).std(axis=0)) < LEAST_SPREAD_RAD:
        return None
    middle = np.concatenate(pairs).mean(axis=0)
    apart = [np.ascontiguousarray((pair - middle).T) for pair in pairs]
    correlations = np.array([_correlation(apart, lag) for lag in lags])
    best = int(np.argmax(correlations))
    lag_s = (lags[best] + _summit(correlations, best)) / RATE_HZ
    return Likeness(float(lag_s), _concordance(_shifted(pairs, lags[best])))


def _shifted(pairs: list[Floats], lag: int) -> Floats:
    """(M, 2) healthy at t beside affected at t + lag."""
    cut = [
        np.column_stack(
            [pair[max(-lag, 0) : len(pair) - max(lag, 0), 0], pair[max(lag, 0) : len(pair) + min(lag, 0), 1]]
        )
        for pair in pairs
    ]
    return np.concatenate(cut)


def _correlation(apart: list[Floats], lag: int) -> float:
    """Of healthy at t and affected at t + lag, from (2, N) rows about means near their own; sums, since it is asked for
    sixty lags.
    """
    sums = np.zeros(6)  # 1, h, a, hh, aa, ha
    for healthy, affected in apart:
        h = healthy[max(-lag, 0) : len(healthy) - max(lag, 0)]
        a = affected[max(lag, 0) : len(affected) + min(lag, 0)]
        sums += (len(h), h.sum(), a.sum(), h @ h, a @ a, h @ a)
    n, h_all, a_all, hh, aa, ha = sums.tolist()
    spread = sqrt(max((hh - h_all**2 / n) * (aa - a_all**2 / n), 0.0))
    return (ha - h_all * a_all / n) / max(spread, 1e-12)


def _concordance(pairs: Floats) -> float:
    healthy, affected = pairs.T
    covariance = float(((healthy - healthy.mean()) * (affected - affected.mean())).mean())
    gap = float(healthy.mean() - affected.mean())
    return 2.0 * covariance / (float(healthy.var() + affected.var()) + gap**2)


def _summit(values: Floats, best: int) -> float:
    """Where a parabola through the best value and its neighbours has its top, in samples from the best."""
    if not 0 < best < len(values) - 1:
        return 0.0
    before, top, after = values[best - 1 : best + 2]
    bend = float(before - 2.0 * top + after)
    return 0.5 * float(before - after) / bend if bend < 0.0 else 0.0
