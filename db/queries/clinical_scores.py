"""Scores that people have entered."""

from __future__ import annotations

from sqlmodel import Session, col, select

from db.clinical_score import ClinicalScore, ClinicalScoreForm


def scores_of(session: Session, patient_id: int) -> list[ClinicalScore]:
    """A patient's scores, in the order of their days."""
    rows = select(ClinicalScore).where(ClinicalScore.patient_id == patient_id)
    return list(session.exec(rows.order_by(col(ClinicalScore.on), col(ClinicalScore.id))))


def add_score(session: Session, patient_id: int, form: ClinicalScoreForm, account: str) -> ClinicalScore:
    """A person enters a score."""
    score = ClinicalScore.model_validate(form, update={"patient_id": patient_id, "entered_by": account})
    session.add(score)
    session.flush()
    return score


def remove_score(session: Session, patient_id: int, number: int) -> bool:
    """Take a score back; False where the patient has none of that number."""
    found = session.get(ClinicalScore, number)
    if found is None or found.patient_id != patient_id:
        return False
    session.delete(found)
    session.flush()
    return True
