"""Patients and their history."""

from __future__ import annotations

from fastapi import APIRouter

from db.limits import PatientLimits
from db.patient import Patient, PatientCreate, PatientPublic, PatientUpdate
from db.queries import patients, sessions
from db.therapy_session import SessionDetail
from fusion.errors import RefusedError
from server.api.deps import AccountDep, PatientDep, SessionDep, TherapistDep
from server.api.errors import answers

router = APIRouter(prefix="/patients", tags=["patients"])


@router.get("", responses=answers(401, 403, 503))
def list_patients(_: TherapistDep, session: SessionDep) -> list[PatientPublic]:
    """Every patient, by name."""
    return [_public(patient) for patient in patients.list_patients(session)]


@router.post("", status_code=201, responses=answers(401, 403, 422, 503))
def enrol_patient(form: PatientCreate, account: TherapistDep, session: SessionDep) -> PatientPublic:
    """Enrol a patient."""
    return _public(patients.add_patient(session, form, account.id or 0))


@router.get("/cautious-limits", responses=answers(401, 503))
def read_cautious_limits(_: AccountDep) -> PatientLimits:
    """What a form for a new patient begins with: within what a relaxed adult arm allows."""
    return PatientLimits()


@router.get("/{patient_id}", responses=answers(401, 403, 404, 422, 503))
def read_patient(patient: PatientDep) -> PatientPublic:
    """One patient."""
    return _public(patient)


@router.patch("/{patient_id}", responses=answers(401, 403, 404, 422, 503))
def change_patient(form: PatientUpdate, patient: PatientDep, session: SessionDep) -> PatientPublic:
    """Change what the form names; it holds from the next session on. Changed limits want a new signature."""
    return _public(patients.change_patient(session, patient, form))


@router.post("/{patient_id}/confirm-limits", responses=answers(401, 403, 404, 409, 422, 503))
def confirm_limits(
    seen: PatientLimits, patient: PatientDep, account: TherapistDep, session: SessionDep
) -> PatientPublic:
    """Sign for the patient's limits, as they were seen; without that no session can be opened."""
    if seen != patient.limits:
        raise RefusedError(
            f"{patient.name}'s limits are not those that you have seen",
            "the limits as they are stored",
            "look at them again",
        )
    return _public(patients.sign_limits(session, patient, account.name))


@router.get("/{patient_id}/sessions", responses=answers(401, 403, 404, 422, 503))
def read_history(patient: PatientDep, session: SessionDep) -> list[SessionDetail]:
    """The patient's sessions with their metrics, newest first."""
    return sessions.history_of(session, patient.id or 0)


def _public(patient: Patient) -> PatientPublic:
    return PatientPublic.model_validate(patient)
