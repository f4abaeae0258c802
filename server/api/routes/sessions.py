"""Therapy sessions: open, control, end, and what they left."""

from __future__ import annotations

from fastapi import APIRouter

from db.queries import sessions
from db.therapy_session import EventPublic, SessionDetail, SessionPublic, SessionUpdate
from server.api.deps import AccountDep, ClientDep, ControlsDep, FiguresDep, SessionDep, TherapistDep, TherapyDep
from server.api.errors import answers, not_found
from server.api.forms import (
    Answer,
    AssistanceForm,
    AuthorityPublic,
    Control,
    Curves,
    Follow,
    MeasuredRange,
    Number,
    SessionEnd,
    SessionOpen,
    TakeOver,
)

router = APIRouter(prefix="/sessions", tags=["sessions"])


@router.post("", status_code=201, responses=answers(401, 403, 404, 409, 422, 503))
async def open_session(form: SessionOpen, _: TherapistDep, client: ClientDep, therapy: TherapyDep) -> SessionPublic:
    """Open a session for a patient; one at a time, only with the affected side confirmed and the limits signed for.
    The page that asks is in charge of it.
    """
    return await therapy.open(form, client)


@router.get("/current", responses=answers(401, 503))
async def read_current(_: AccountDep, therapy: TherapyDep) -> SessionPublic | None:
    """The open session, or null."""
    return await therapy.current()


@router.get("/current/authority", responses=answers(401, 503))
async def read_authority(_: AccountDep, controls: ControlsDep) -> AuthorityPublic | None:
    """Who is in charge of the open session, or null."""
    return controls.authority()


@router.get("/{session_id}", responses=answers(401, 403, 404, 422, 503))
def read_session(session_id: Number, _: TherapistDep, session: SessionDep) -> SessionDetail:
    """A session with its metrics."""
    return _existing(session, session_id)


@router.patch("/{session_id}", responses=answers(401, 403, 404, 422, 503))
def change_session(session_id: Number, form: SessionUpdate, _: TherapistDep, session: SessionDep) -> SessionDetail:
    """Note something about the session, or the pain afterwards; whatever is left out stays."""
    found = sessions.find_session(session, session_id)
    if found is None:
        raise not_found("session", session_id)
    sessions.change_session(session, found, form)
    return _existing(session, session_id)


@router.get("/{session_id}/curves", responses=answers(401, 403, 404, 422, 503))
async def read_curves(session_id: Number, _: TherapistDep, figures: FiguresDep) -> Curves:
    """The angles of both arms over the session."""
    return await figures.curves(session_id)


@router.get("/{session_id}/events", responses=answers(401, 403, 404, 422, 503))
def read_events(session_id: Number, _: TherapistDep, session: SessionDep) -> list[EventPublic]:
    """What happened in the session, in order."""
    _existing(session, session_id)
    return [EventPublic.model_validate(event) for event in sessions.events_of(session, session_id)]


@router.post("/{session_id}/control", responses=answers(401, 404, 409, 422, 503))
async def control(session_id: Number, form: Control, client: ClientDep, controls: ControlsDep) -> Answer:
    """Start, hold, resume, stop or reset the arm, or say that it hurts. 409 with the reason where that is refused.
    Hold, stop and pain are for everybody who is logged in, the rest for the page in charge.
    """
    return await controls.control(session_id, form.action, client)


@router.post("/{session_id}/assistance", responses=answers(401, 404, 409, 422, 503))
async def help_arm(session_id: Number, form: AssistanceForm, client: ClientDep, controls: ControlsDep) -> Answer:
    """Choose how, and how much at most, the drive helps from now on; only for the page in charge."""
    return await controls.help(session_id, form, client)


@router.post("/{session_id}/authority", responses=answers(401, 403, 404, 409, 422, 503))
async def take_over(
    session_id: Number, form: TakeOver, _: TherapistDep, client: ClientDep, controls: ControlsDep
) -> AuthorityPublic | None:
    """Take over. While another page is in charge and connected, this must be confirmed. A moving arm is held."""
    return await controls.take(session_id, form.confirmed, client)


@router.post("/{session_id}/measured-range", responses=answers(401, 404, 409, 422, 503))
async def measure_range(session_id: Number, client: ClientDep, controls: ControlsDep) -> MeasuredRange:
    """Begin anew to measure how far the patient moves the arm unaided; only for the page in charge, and only while
    the arm is engaged and moves freely.
    """
    return controls.measure_range(session_id, client)


@router.get("/{session_id}/measured-range", responses=answers(401, 404, 409, 422, 503))
async def read_measured_range(session_id: Number, _: AccountDep, controls: ControlsDep) -> MeasuredRange:
    """What has been measured since; a proposal for the patient's passive range, for a person to confirm."""
    return controls.measured_range(session_id)


@router.post("/{session_id}/follow", responses=answers(401, 404, 409, 422, 503))
async def follow(session_id: Number, form: Follow, client: ClientDep, controls: ControlsDep) -> Answer:
    """Say which body of a sensor is the patient; only for the page in charge."""
    return await controls.follow(session_id, form, client)


@router.post("/{session_id}/end", responses=answers(401, 404, 409, 422, 503))
async def end_session(session_id: Number, form: SessionEnd, client: ClientDep, therapy: TherapyDep) -> SessionDetail:
    """Stop, finish the recording, compute the metrics and store them; only for the page in charge."""
    return await therapy.end(session_id, form.pain_after, client)


def _existing(session: SessionDep, session_id: int) -> SessionDetail:
    found = sessions.session_detail(session, session_id)
    if found is None:
        raise not_found("session", session_id)
    return found
