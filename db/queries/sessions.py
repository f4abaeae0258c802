"""Therapy sessions, their metrics and their events."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from datetime import datetime

from sqlalchemy import delete
from sqlmodel import Session, col, func, select
from sqlmodel.sql.expression import Select

from db.account import Account
from db.patient import Patient
from db.therapy_session import (
    Event,
    Metric,
    MetricPublic,
    SessionDetail,
    SessionPublic,
    SessionStatus,
    SessionUpdate,
    TherapySession,
)

LOOKED_BACK = 100
"""Sessions in which a game that was played long ago is still looked for."""


def add_session(session: Session, opened: TherapySession) -> TherapySession:
    """A session that begins now."""
    session.add(opened)
    session.flush()
    return opened


def find_session(session: Session, session_id: int) -> TherapySession | None:
    """The session of that number."""
    return session.get(TherapySession, session_id)


def remove_session(session: Session, session_id: int) -> None:
    """Forget a session, with its figures and events."""
    session.execute(delete(TherapySession).where(col(TherapySession.id) == session_id))


def sessions_left_open(session: Session) -> list[TherapySession]:
    """Sessions that a crash left open, or whose metrics could not be stored."""
    unfinished = (col(TherapySession.status) == SessionStatus.OPEN) | (col(TherapySession.measured).is_(False))
    return list(session.exec(select(TherapySession).where(unfinished).order_by(col(TherapySession.id))))


def begun_since(session: Session, since: datetime, patient_id: int | None = None) -> list[TherapySession]:
    """Sessions that began then or later, oldest first; of one patient or of all."""
    rows = select(TherapySession).where(col(TherapySession.started_at) >= since)
    if patient_id is not None:
        rows = rows.where(TherapySession.patient_id == patient_id)
    return list(session.exec(rows.order_by(col(TherapySession.id))))


def newest_of_each(session: Session) -> dict[int, TherapySession]:
    """The newest session of each patient who has one, by the patient's number."""
    newest = select(func.max(TherapySession.id)).group_by(col(TherapySession.patient_id))
    rows = session.exec(select(TherapySession).where(col(TherapySession.id).in_(newest)))
    return {found.patient_id: found for found in rows}


def levels_reached(session: Session, patient_id: int) -> dict[str, float]:
    """The difficulty that a patient last reached in each game that was played in the newest sessions."""
    rows = select(TherapySession.played).where(TherapySession.patient_id == patient_id)
    newest = session.exec(rows.order_by(col(TherapySession.id).desc()).limit(LOOKED_BACK)).all()
    return {one.game: one.level for played in reversed(newest) for one in played}


def newest_with_workspace(session: Session, patient_id: int) -> TherapySession | None:
    """The patient's newest session whose games' workspace was kept."""
    rows = select(TherapySession).where(TherapySession.patient_id == patient_id)
    return session.exec(
        rows.where(col(TherapySession.workspace).is_not(None)).order_by(col(TherapySession.id).desc())
    ).first()


def change_session(session: Session, found: TherapySession, form: SessionUpdate) -> None:
    """Change what the form names; the rest stays."""
    for name in form.model_fields_set:
        value = getattr(form, name)
        if value is not None:
            setattr(found, name, value)
    session.add(found)
    session.flush()


def add_event(session: Session, event: Event) -> Event:
    """Something that happened."""
    session.add(event)
    session.flush()
    return event


def events_of(session: Session, session_id: int) -> list[Event]:
    """What happened in a session, in order."""
    return list(session.exec(select(Event).where(Event.session_id == session_id).order_by(col(Event.id))))


def count_events(session: Session, session_id: int, kind: str, text: str) -> int:
    """How many events of a kind say exactly that."""
    found = select(func.count()).where(Event.session_id == session_id, Event.kind == kind, Event.text == text)
    return session.exec(found).one()


def replace_metrics(session: Session, session_id: int, metrics: Iterable[Metric]) -> None:
    """Store a session's figures in place of what was there; trying again therefore does no harm."""
    session.execute(delete(Metric).where(col(Metric.session_id) == session_id))
    session.add_all(metrics)
    session.flush()


def public_session(session: Session, session_id: int) -> SessionPublic | None:
    """A session with the names of patient and therapist."""
    found = session.exec(_named().where(col(TherapySession.id) == session_id)).first()
    return None if found is None else SessionPublic.model_validate(found[0], update=_names(found))


def session_detail(session: Session, session_id: int) -> SessionDetail | None:
    """A session with its figures."""
    found = session.exec(_named().where(col(TherapySession.id) == session_id)).first()
    return None if found is None else _with_metrics(session, [found])[0]


def history_of(session: Session, patient_id: int) -> list[SessionDetail]:
    """A patient's sessions with their figures, newest first."""
    rows = session.exec(
        _named().where(col(TherapySession.patient_id) == patient_id).order_by(col(TherapySession.id).desc())
    ).all()
    return _with_metrics(session, rows)


_Named = tuple[TherapySession, str, str]


def _named() -> Select[TherapySession, str, str]:
    return (
        select(TherapySession, Patient.name, Account.name)
        .where(TherapySession.patient_id == Patient.id)
        .where(TherapySession.therapist_id == Account.id)
    )


def _names(row: _Named) -> dict[str, str]:
    return {"patient_name": row[1], "therapist_name": row[2]}


def _with_metrics(session: Session, rows: Sequence[_Named]) -> list[SessionDetail]:
    numbers = [row[0].id for row in rows]
    metrics = session.exec(select(Metric).where(col(Metric.session_id).in_(numbers)).order_by(col(Metric.id))).all()
    return [
        SessionDetail.model_validate(
            row[0],
            update=_names(row)
            | {"metrics": [MetricPublic.model_validate(m) for m in metrics if m.session_id == row[0].id]},
        )
        for row in rows
    ]
