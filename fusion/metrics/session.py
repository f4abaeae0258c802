"""All figures of a session; docs/metrics.md defines each. A further family is a file and a line here."""

from __future__ import annotations

from collections.abc import Callable
from math import isfinite
from typing import Final

from fusion.metrics.activity import activity_metrics
from fusion.metrics.attempts import attempt_metrics
from fusion.metrics.effort import effort_metrics
from fusion.metrics.metric import Metric
from fusion.metrics.posture import posture_metrics
from fusion.metrics.range_of_movement import range_metrics
from fusion.metrics.reaches import reach_metrics
from fusion.metrics.record import SessionRecord
from fusion.metrics.sensor_quality import sensor_metrics
from fusion.metrics.symmetry import symmetry_metrics

FAMILIES: Final[tuple[Callable[[SessionRecord], list[Metric]], ...]] = (
    activity_metrics,
    attempt_metrics,
    reach_metrics,
    range_metrics,
    symmetry_metrics,
    effort_metrics,
    posture_metrics,
    sensor_metrics,
)


def session_metrics(record: SessionRecord) -> tuple[Metric, ...]:
    """Every figure that the session is long enough for; what cannot be measured is left out, never NaN."""
    if len(record.t_s) == 0:
        return ()
    return tuple(metric for family in FAMILIES for metric in family(record) if isfinite(metric.value))
