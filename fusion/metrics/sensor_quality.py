"""How well each sensor served the session."""

from __future__ import annotations

import numpy as np

from fusion.messages import Floats
from fusion.metrics.metric import Metric
from fusion.metrics.record import SensorTrack, SessionRecord


def sensor_metrics(record: SessionRecord) -> list[Metric]:
    """Frame rate, alignment residual (medians) and the age of its last frame (95th percentile), per sensor."""
    return [metric for track in record.sensors for metric in _of(track)]


def _of(track: SensorTrack) -> list[Metric]:
    figures = (
        ("sensor_frame_rate", track.frames_per_s, 50, "Hz"),
        ("sensor_residual", track.residual_m, 50, "m"),
        ("sensor_age_p95", track.age_s, 95, "s"),
    )
    return [
        Metric(name, value, unit, joint=track.name)
        for name, values, percent, unit in figures
        if (value := _percentile(values, percent)) is not None
    ]


def _percentile(values: Floats, percent: int) -> float | None:
    finite = values[np.isfinite(values)]
    return float(np.percentile(finite, percent)) if len(finite) else None
