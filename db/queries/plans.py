"""Patients' plans."""

from __future__ import annotations

from sqlmodel import Session, select

from db.columns import now_utc
from db.plan import PlanForm, TherapyPlan


def find_plan(session: Session, patient_id: int) -> TherapyPlan | None:
    """The patient's plan."""
    return session.get(TherapyPlan, patient_id)


def all_plans(session: Session) -> dict[int, TherapyPlan]:
    """Every plan, by the patient's number."""
    return {plan.patient_id: plan for plan in session.exec(select(TherapyPlan))}


def put_plan(session: Session, patient_id: int, form: PlanForm, account: str) -> TherapyPlan:
    """Plan, in place of what was planned before."""
    found = find_plan(session, patient_id) or TherapyPlan.model_validate(
        form, update={"patient_id": patient_id, "updated_by": account}
    )
    for name in PlanForm.model_fields:
        setattr(found, name, getattr(form, name))
    found.updated_by, found.updated_at = account, now_utc()
    session.add(found)
    session.flush()
    return found
