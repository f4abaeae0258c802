"""Therapy sessions: open, control, end, and what they left."""

from __future__ import annotations

from fastapi import APIRouter

from db.queries import sessions
from db.therapy_session import EventPublic, SessionDetail, SessionPublic
from server.api.deps import AccountDep, SessionDep, TherapyDep
from server.api.errors import answers, not_found
from server.api.forms import Answer, Control, Curves, Follow, SessionEnd, SessionOpen

router = APIRouter(prefix="/sessions", tags=["sessions"])


@router.post("", status_code=201, responses=answers(401, 404, 409, 422, 503))
async def open_session(form: SessionOpen, account: AccountDep, therapy: TherapyDep) -> SessionPublic:
    """Open a session for a patient; one at a time, and only with the affected side confirmed."""
    return await therapy.open(form, account)


@router.get("/current", responses=answers(401, 503))
async def read_current(_: AccountDep, therapy: TherapyDep) -> SessionPublic | None:
    """The open session, or null."""
    return await therapy.current()


@router.get("/{session_id}", responses=answers(401, 404, 422, 503))
def read_session(session_id: int, _: AccountDep, session: SessionDep) -> SessionDetail:
    """A session with its metrics."""
    return _existing(session, session_id)


@router.get("/{session_id}/curves", responses=answers(401, 404, 422, 503))
async def read_curves(session_id: int, _: AccountDep, therapy: TherapyDep) -> Curves:
    """The angles of both arms over the session."""
    return await therapy.curves(session_id)


@router.get("/{session_id}/events", responses=answers(401, 404, 422, 503))
def read_events(session_id: int, _: AccountDep, session: SessionDep) -> list[EventPublic]:
    """What happened in the session, in order."""
    _existing(session, session_id)
    return [EventPublic.model_validate(event) for event in sessions.events_of(session, session_id)]


@router.post("/{session_id}/control", responses=answers(401, 404, 409, 422, 503))
async def control(session_id: int, form: Control, account: AccountDep, therapy: TherapyDep) -> Answer:
    """Start, hold, resume, stop or reset the arm. 409 with the reason where that is refused."""
    return await therapy.control(session_id, form.action, account)


@router.post("/{session_id}/follow", responses=answers(401, 404, 409, 422, 503))
async def follow(session_id: int, form: Follow, account: AccountDep, therapy: TherapyDep) -> Answer:
    """Say which body of a sensor is the patient."""
    return await therapy.follow(session_id, form, account)


@router.post("/{session_id}/end", responses=answers(401, 404, 409, 422, 503))
async def end_session(session_id: int, form: SessionEnd, account: AccountDep, therapy: TherapyDep) -> SessionDetail:
    """Stop, finish the recording, compute the metrics and store them."""
    return await therapy.end(session_id, form.pain_after, account)


def _existing(session: SessionDep, session_id: int) -> SessionDetail:
    found = sessions.session_detail(session, session_id)
    if found is None:
        raise not_found("session", session_id)
    return found
