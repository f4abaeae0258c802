"""How far figures of the sensors lie from the same figures of the truth, and what trust follows from that."""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass
from math import radians
from typing import Final

import numpy as np

from fusion.metrics.measure import Trust
from fusion.metrics.metric import Metric

Figures = tuple[Metric, ...]
Z_95: Final = 1.96
FEWEST: Final = 5
"""Sessions, of fewer of which nothing is said."""
ORDER: Final = (Trust.GOOD, Trust.FAIR, Trust.POOR)
WITHIN: Final[Mapping[str, tuple[float, float]]] = {"rad": (radians(10.0), radians(20.0)), "m": (0.02, 0.05)}
"""By unit: 95 % of sessions are within the first of the truth = good, within the second = fair."""
RELATIVE: Final = (0.10, 0.25)
"""The same for all other units, as shares of what is typical."""
FAITY: Final = "Faity, Mottet, Froger, Sensors 22:2735, 2022"
KNOWN: Final[Mapping[str, Trust]] = {
    "peak_speed": Trust.POOR,
    "velocity_peaks": Trust.POOR,
    "path_ratio": Trust.FAIR,
    "range_lowest": Trust.FAIR,
    "range_highest": Trust.FAIR,
    "range_of_movement": Trust.FAIR,
    "shoulder_hitch": Trust.FAIR,
    "shoulder_hitch_p95": Trust.FAIR,
}
"""The most that is granted whatever is found here: by FAITY, who compared a Kinect v2 with an optical system in seated
reaching; the shoulder's because nobody hitches in the recordings."""


@dataclass(frozen=True, slots=True)
class Agreement:
    """One figure over several sessions (Bland, Altman, Lancet 327:307–310, 1986)."""

    name: str
    joint: str
    unit: str
    sessions: int
    typical: float
    """Median of the true figures' sizes."""
    bias: float
    """Mean of measured minus true."""
    limit: float
    """1.96 standard deviations of that; the limits of agreement are bias ± limit."""

    @property
    def off(self) -> float:
        """How far off 95 % of sessions are at most, about."""
        return abs(self.bias) + self.limit


def agreements(sessions: Sequence[tuple[Figures, Figures]]) -> tuple[Agreement, ...]:
    """Of every figure that the sensors and the truth both gave in enough sessions.

    Args:
        sessions: measured and true figures of each.
    """
    pairs: dict[tuple[str, str, str], list[tuple[float, float]]] = {}
    for measured, true in sessions:
        told = {(one.name, one.joint, one.side): one.value for one in measured}
        for one in true:
            if (one.name, one.joint, one.side) in told:
                key = (one.name, one.joint or "", one.unit)
                pairs.setdefault(key, []).append((told[one.name, one.joint, one.side], one.value))
    return tuple(_agreement(key, np.array(found)) for key, found in pairs.items() if len(found) >= FEWEST)


def _agreement(key: tuple[str, str, str], pairs: np.ndarray) -> Agreement:  # (N, 2) measured, true
    apart = pairs[:, 0] - pairs[:, 1]
    typical = float(np.median(np.abs(pairs[:, 1])))
    return Agreement(*key, len(pairs), typical, float(apart.mean()), Z_95 * float(apart.std(ddof=1)))


def found_trust(name: str, told: Iterable[Agreement]) -> Trust | None:
    """What the agreements say of a measure, over its joints the middle one; None where it is in none of them."""
    ranks = sorted(_rank(one) for one in told if one.name == name)
    return ORDER[ranks[len(ranks) // 2]] if ranks else None


def camera_error(name: str, told: Iterable[Agreement]) -> float | None:
    """Standard deviation of a measure about the truth, the middle joint's; None where it is in none of them."""
    limits = sorted(one.limit for one in told if one.name == name)
    return limits[len(limits) // 2] / Z_95 if limits else None


def due_trust(name: str, told: Iterable[Agreement]) -> Trust | None:
    """What the catalogue has to say: the worse of what is found and what is known."""
    found = found_trust(name, told)
    return None if found is None else max(found, KNOWN.get(name, Trust.GOOD), key=ORDER.index)


def _rank(one: Agreement) -> int:
    good, fair = WITHIN.get(one.unit, (RELATIVE[0] * one.typical, RELATIVE[1] * one.typical))
    return (one.off > good) + (one.off > fair)
