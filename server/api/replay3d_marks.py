"""What is marked on a replay's time line: the arm's states from the recording, hits and pain from the journal."""

from __future__ import annotations

from collections.abc import Sequence
from datetime import datetime, timedelta
from itertools import pairwise

from db.therapy_session import Event
from server.api.journal import CONTROL, SCORE
from server.api.replay3d_forms import Mark, StateSpan
from server.api.replay3d_frames import Frames
from server.messages import DriveState

STATE = "state"
"""Kind of the journal's events that say that the arm's state has changed."""


def spans_of(frames: Frames) -> list[StateSpan]:
    """The states one after the other, over the whole session."""
    changes = [0, *(k for k in range(1, len(frames.state)) if frames.state[k] is not frames.state[k - 1])]
    ends_s = [*(float(frames.t_s[k]) for k in changes[1:]), frames.duration_s]
    return [
        StateSpan(state=frames.state[k], from_s=float(frames.t_s[k]), to_s=end_s)
        for k, end_s in zip(changes, ends_s, strict=True)
    ]


def marks_of(events: Sequence[Event], spans: Sequence[StateSpan], started_at: datetime) -> list[Mark]:
    """Hits, misses and calls of pain in seconds since the recording's first picture, as far as they lie inside."""
    zero = _zero(events, spans, started_at)
    length_s = spans[-1].to_s
    marks = [
        Mark(kind=kind, t_s=(event.t - zero).total_seconds()) for event, kind in [*_scored(events), *_hurt(events)]
    ]
    return sorted((mark for mark in marks if 0.0 <= mark.t_s <= length_s), key=lambda mark: mark.t_s)


def _scored(events: Sequence[Event]) -> list[tuple[Event, str]]:
    """Each count that rose; every exercise of a session counts from nothing."""
    before: dict[int, Event] = {}
    scored = []
    for event in events:
        if event.kind == SCORE:
            exercise = event.data.get("exercise", 1)
            rose = (name for name in ("hits", "misses") if _count(event, name) > _count(before.get(exercise), name))
            scored += [(event, _MARKED_AS[name]) for name in rose]
            before[exercise] = event
    return scored


_MARKED_AS = {"hits": "hit", "misses": "missed"}


def _count(event: Event | None, name: str) -> int:
    return 0 if event is None else int(event.data.get(name, 0))


def _hurt(events: Sequence[Event]) -> list[tuple[Event, str]]:
    return [(event, "pain") for event in events if event.kind == CONTROL and event.text == "pain"]


def _zero(events: Sequence[Event], spans: Sequence[StateSpan], started_at: datetime) -> datetime:
    """The recording's first instant on the wall clock: where both tell of the same change of state, else the opening.

    Recordings carry the station's clock, which began at no known time of day.
    """
    changes = {(first.state, then.state): then.from_s for first, then in reversed(list(pairwise(spans)))}
    for event in events:
        known = _change_of(event)
        if known in changes:
            return event.t - timedelta(seconds=changes[known])
    return started_at


def _change_of(event: Event) -> tuple[DriveState, DriveState] | None:
    before, after = event.data.get("before"), event.data.get("after")
    if event.kind != STATE or before not in set(DriveState) or after not in set(DriveState):
        return None
    return DriveState(before), DriveState(after)
