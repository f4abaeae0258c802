"""A session's way into the database: plain functions, one transaction each, run in a worker thread."""

from __future__ import annotations

from collections.abc import Iterable
from datetime import datetime

from sqlmodel import Session

from db.database import Database
from db.exercise import PlayedExercise
from db.limits import PassiveRange
from db.patient import Patient
from db.queries import patients, sessions
from db.therapy_session import (
    AllLimits,
    Metric,
    MetricBase,
    SessionDetail,
    SessionPublic,
    SessionStatus,
    TherapySession,
)
from db.workspace import SessionWorkspace
from server import __version__
from server.api.errors import not_found
from server.api.exercises import exercises_for
from server.api.forms import SessionOpen
from server.api.journal import CONTROL
from server.api.limits import snapshots
from server.api.measure import Counts
from server.api.workspace import first_workspace
from server.messages import JointLimits


def existing_patient(database: Database, patient_id: int) -> Patient:
    """The patient of that number; 404 where there is none."""
    with database.session() as session:
        patient = patients.find_patient(session, patient_id)
    if patient is None:
        raise not_found("patient", patient_id)
    return patient


def existing_session(database: Database, session_id: int) -> TherapySession:
    """The session of that number; 404 where there is none."""
    with database.session() as session:
        found = sessions.find_session(session, session_id)
    if found is None:
        raise not_found("session", session_id)
    return found


def begin(
    database: Database,
    form: SessionOpen,
    patient: Patient,
    therapist_id: int,
    seed: int,
    limits: tuple[JointLimits, ...],
    allowed: PassiveRange,
) -> TherapySession:
    """Store a session that begins now, and decide where it is recorded.

    Raises:
        InputError: it names a game that there is not.
    """
    with database.session() as session:
        begun = sessions.add_session(
            session,
            TherapySession(
                patient_id=form.patient_id,
                therapist_id=therapist_id,
                affected_side=form.confirmed_affected_side,
                exercises=exercises_for(session, form.patient_id, form.exercises),
                seed=seed,
                pain_before=form.pain_before,
                assistance=form.assistance or patient.assistance,
                assist_level=patient.assist_level_most if form.assist_level is None else form.assist_level,
                limits=AllLimits(joints=snapshots(limits), set_by=patient.limits_set_by, set_at=patient.limits_set_at),
                workspace=_first_workspace(session, form.patient_id, allowed),
                version=__version__,
            ),
        )
        begun.recording = f"recordings/session-{begun.id:06d}.mcap"
        return begun


def _first_workspace(session: Session, patient_id: int, allowed: PassiveRange) -> SessionWorkspace:
    last = sessions.newest_with_workspace(session, patient_id)
    return first_workspace(None, (), allowed) if last is None else first_workspace(last.workspace, last.played, allowed)


def forget(database: Database, session_id: int) -> None:
    """Take back a session that the station refused to open; nothing has happened in it."""
    with database.session() as session:
        sessions.remove_session(session, session_id)


def finish(
    database: Database, session_id: int, status: SessionStatus, ended_at: datetime, pain_after: int | None
) -> None:
    """Store that the session is over. Its figures follow; until then it counts as unmeasured."""
    with database.session() as session:
        found = sessions.find_session(session, session_id)
        if found is not None:
            found.status, found.ended_at = status, ended_at
            found.pain_after = pain_after if pain_after is not None else found.pain_after


def store_played(database: Database, session_id: int, played: tuple[PlayedExercise, ...]) -> None:
    """Store what became of the session's exercises."""
    with database.session() as session:
        found = sessions.find_session(session, session_id)
        if found is not None:
            found.played = played


def store_workspace(database: Database, session_id: int, workspace: SessionWorkspace) -> None:
    """Store what the session's games go by."""
    with database.session() as session:
        found = sessions.find_session(session, session_id)
        if found is not None:
            found.workspace = workspace


def store_metrics(database: Database, session_id: int, metrics: Iterable[MetricBase]) -> None:
    """Store what the session measured."""
    rows = [Metric(session_id=session_id, **metric.model_dump()) for metric in metrics]
    with database.session() as session:
        sessions.replace_metrics(session, session_id, rows)
        found = sessions.find_session(session, session_id)
        if found is not None:
            found.measured = True


def counts(database: Database, session_id: int) -> Counts:
    """What the games counted, and how often pain was called."""
    played = existing_session(database, session_id).played
    with database.session() as session:
        pain_calls = sessions.count_events(session, session_id, CONTROL, "pain")
    return Counts(sum(one.hits for one in played), sum(one.misses for one in played), pain_calls)


def public(database: Database, session_id: int) -> SessionPublic:
    """The session as the browser sees it; 404 where there is none."""
    with database.session() as session:
        found = sessions.public_session(session, session_id)
    if found is None:
        raise not_found("session", session_id)
    return found


def detail(database: Database, session_id: int) -> SessionDetail:
    """The session with its figures; 404 where there is none."""
    with database.session() as session:
        found = sessions.session_detail(session, session_id)
    if found is None:
        raise not_found("session", session_id)
    return found
