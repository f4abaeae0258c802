"""Scores of standard tests that a person enters for a patient."""

from __future__ import annotations

from fastapi import APIRouter

from db.clinical_score import ClinicalScore, ClinicalScoreForm, ClinicalScorePublic
from db.queries import clinical_scores
from server.api.deps import PatientDep, SessionDep, TherapistDep
from server.api.errors import answers, not_found
from server.api.forms import Number

router = APIRouter(prefix="/patients/{patient_id}/scores", tags=["scores"])


@router.get("", responses=answers(401, 403, 404, 422, 503))
def list_scores(patient: PatientDep, session: SessionDep) -> list[ClinicalScorePublic]:
    """The patient's scores, in the order of their days."""
    return [_public(score) for score in clinical_scores.scores_of(session, patient.id or 0)]


@router.post("", status_code=201, responses=answers(401, 403, 404, 422, 503))
def add_score(
    form: ClinicalScoreForm, patient: PatientDep, account: TherapistDep, session: SessionDep
) -> ClinicalScorePublic:
    """Enter a score."""
    return _public(clinical_scores.add_score(session, patient.id or 0, form, account.name))


@router.delete("/{number}", status_code=204, responses=answers(401, 403, 404, 422, 503))
def remove_score(number: Number, patient: PatientDep, session: SessionDep) -> None:
    """Take back a score that was entered wrongly."""
    if not clinical_scores.remove_score(session, patient.id or 0, number):
        raise not_found("score", number)


def _public(score: ClinicalScore) -> ClinicalScorePublic:
    return ClinicalScorePublic.model_validate(score)
