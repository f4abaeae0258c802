"""Patients."""

from __future__ import annotations

from sqlmodel import Session, col, select

from db.columns import now_utc
from db.patient import SIGNED_FOR, Patient, PatientCreate, PatientUpdate


def list_patients(session: Session) -> list[Patient]:
    """Every patient, by name."""
    return list(session.exec(select(Patient).order_by(col(Patient.name), col(Patient.id))))


def find_patient(session: Session, patient_id: int) -> Patient | None:
    """The patient of that number."""
    return session.get(Patient, patient_id)


def add_patient(session: Session, form: PatientCreate, created_by_id: int) -> Patient:
    """Enrol a patient."""
    patient = Patient.model_validate(form, update={"created_by_id": created_by_id})
    session.add(patient)
    session.flush()
    return patient


def change_patient(session: Session, patient: Patient, form: PatientUpdate) -> Patient:
    """Change what the form names; the rest stays. A signature for other limits ends."""
    for name in form.model_fields_set:
        value = getattr(form, name)
        if value is None:
            continue
        if name in SIGNED_FOR and value != getattr(patient, name):
            patient.limits_set_by, patient.limits_set_at = "", None
        setattr(patient, name, value)
    return _changed(session, patient)


def sign_limits(session: Session, patient: Patient, account: str) -> Patient:
    """Somebody answers for the patient's limits as they are (SR-10)."""
    patient.limits_set_by, patient.limits_set_at = account, now_utc()
    return _changed(session, patient)


def _changed(session: Session, patient: Patient) -> Patient:
    patient.updated_at = now_utc()
    session.add(patient)
    session.flush()
    return patient
