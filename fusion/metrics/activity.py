"""How long the session was in each state, how long the hand really moved, and what was collected."""

from __future__ import annotations

from typing import Final

import numpy as np

from fusion.messages import Floats
from fusion.metrics.metric import Metric
from fusion.metrics.reaches import session_movements
from fusion.metrics.record import SessionRecord

LONGEST_TICK_S: Final = 0.5
"""A longer hole between ticks is time about which nothing is known, and counts for no state."""


def activity_metrics(record: SessionRecord) -> list[Metric]:
    """Time in each state that occurred, active minutes, targets collected and missed."""
    spans_s = _spans_s(record.t_s)
    times = [
        Metric(f"time_{state}", float(spans_s[record.state[:-1] == state].sum()), "s")
        for state in sorted(set(record.state.tolist()))
    ]
    return [*times, *_active(record), *_targets(record)]


def _spans_s(t_s: Floats) -> Floats:
    """(T − 1,) how long each tick's state lasted."""
    spans = np.diff(t_s)
    return np.where(spans <= LONGEST_TICK_S, spans, 0.0)


def _active(record: SessionRecord) -> list[Metric]:
    """Minutes within movements."""
    made = session_movements(record)
    if not made:
        return []
    return [Metric("active_minutes", sum(one.duration_s for one in made) / 60.0, "min", side=record.healthy_side)]


def _targets(record: SessionRecord) -> list[Metric]:
    if record.hits + record.misses == 0:
        return []
    return [
        Metric("targets_collected", float(record.hits), "1"),
        Metric("targets_missed", float(record.misses), "1"),
        Metric("success_rate", record.hits / (record.hits + record.misses), "1"),
    ]
