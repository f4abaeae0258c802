"""What is measured, and how a patient's figures went."""

from __future__ import annotations

from fastapi import APIRouter

from db.queries import sessions
from fusion.metrics.catalogue import MEASURES
from fusion.metrics.scales import SCALES
from server.api.deps import AccountDep, PatientDep, SessionDep
from server.api.errors import answers
from server.api.progress import progress_of
from server.api.progress_forms import MeasurePublic, Progress, ScalePublic

router = APIRouter(tags=["measures"])


@router.get("/metrics", responses=answers(401, 503))
async def list_measures(_: AccountDep) -> list[MeasurePublic]:
    """Every measure: formula, unit, source, filter, and how far these sensors can be trusted for it."""
    return [MeasurePublic.model_validate(measure) for measure in MEASURES.values()]


@router.get("/scales", responses=answers(401, 503))
async def list_scales(_: AccountDep) -> list[ScalePublic]:
    """The scales that a person scores, with what change in them means."""
    return [ScalePublic.model_validate(scale) for scale in SCALES.values()]


@router.get("/patients/{patient_id}/progress", responses=answers(401, 403, 404, 422, 503))
def read_progress(patient: PatientDep, session: SessionDep) -> Progress:
    """Every figure over the patient's sessions, with what difference between two of them is more than chance."""
    return progress_of(sessions.history_of(session, patient.id or 0))
