"""How much the trunk moved along: compensation by leaning instead of reaching."""

from __future__ import annotations

import numpy as np

from fusion.metrics.metric import Metric
from fusion.metrics.record import SessionRecord


def posture_metrics(record: SessionRecord) -> list[Metric]:
    """Median and 95th percentile of the trunk's displacement while the arm was driven."""
    moved = record.trunk_displacement_m[record.engaged & np.isfinite(record.trunk_displacement_m)]
    if not len(moved):
        return []
    median, largest = np.percentile(moved, [50, 95])
    return [Metric("trunk_displacement", float(median), "m"), Metric("trunk_displacement_p95", float(largest), "m")]
