"""How long the session was in each state, how long the hand really moved, and what was collected."""

from __future__ import annotations

from fusion.metrics.metric import ADAPTED, Metric
from fusion.metrics.reaches import session_movements
from fusion.metrics.record import SessionRecord
from fusion.metrics.uncertainty import share_sem


def activity_metrics(record: SessionRecord) -> list[Metric]:
    """Time in each state that occurred, active minutes, targets collected and missed."""
    times = [
        Metric(f"time_{state}", float(record.spans_s[record.state == state].sum()), "s")
        for state in sorted(set(record.state.tolist()))
    ]
    return [*times, *_active(record), *_targets(record)]


def _active(record: SessionRecord) -> list[Metric]:
    """Minutes within movements."""
    made = session_movements(record)
    if not made:
        return []
    return [Metric("active_minutes", sum(one.duration_s for one in made) / 60.0, "min", side=record.healthy_side)]


def _targets(record: SessionRecord) -> list[Metric]:
    tries = record.hits + record.misses
    if tries == 0:
        return []
    sem = share_sem(record.hits, tries)
    return [
        Metric("targets_collected", float(record.hits), "1"),
        Metric("targets_missed", float(record.misses), "1"),
        Metric("success_rate", record.hits / tries, "1", caveat_key=ADAPTED, sem=sem),
    ]
