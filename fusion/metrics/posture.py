"""How much trunk and shoulder moved along: compensation by leaning and hitching instead of reaching."""

from __future__ import annotations

import numpy as np

from fusion.messages import Floats
from fusion.metrics.metric import Metric
from fusion.metrics.record import SessionRecord
from fusion.metrics.uncertainty import batch_sem

PERCENTS = {"": 50, "_p95": 95}
"""Ending of the figure's name to percentile; the single largest value would be the sensor's."""


def posture_metrics(record: SessionRecord) -> list[Metric]:
    """Median and 95th percentile of the trunk's displacement and the shoulder's rise while the arm was driven."""
    found = _of("trunk_displacement", record.trunk_displacement_m[record.engaged])
    if record.shoulder_hitch_m is not None:
        found += _of("shoulder_hitch", record.shoulder_hitch_m[record.engaged])
    return found


def _of(name: str, moved_m: Floats) -> list[Metric]:
    known_m = moved_m[np.isfinite(moved_m)]
    if not len(known_m):
        return []
    return [_percentile(f"{name}{ending}", known_m, percent) for ending, percent in PERCENTS.items()]


def _percentile(name: str, sample_m: Floats, percent: int) -> Metric:
    def at(batch_m: Floats) -> float:
        return float(np.percentile(batch_m, percent))

    return Metric(name, at(sample_m), "m", sem=batch_sem(sample_m, at))
