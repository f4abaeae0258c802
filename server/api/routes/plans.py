"""Patients' plans, what was done of them, and what is due today."""

from __future__ import annotations

from datetime import timedelta
from typing import Annotated

from fastapi import APIRouter, Query

from db.plan import DAYS, PlanForm, PlanPublic, TherapyPlan
from db.queries import plans, sessions
from server.api import adherence
from server.api.deps import PatientDep, SessionDep, TherapistDep
from server.api.errors import ApiError, answers
from server.api.exercises import check_games
from server.api.plan_forms import Adherence, PatientToday
from server.api.today import list_today

router = APIRouter(tags=["plans"])


@router.get("/patients/{patient_id}/plan", responses=answers(401, 403, 404, 422, 503))
def read_plan(patient: PatientDep, session: SessionDep) -> PlanPublic:
    """The patient's plan; 404 while there is none."""
    plan = plans.find_plan(session, patient.id or 0)
    if plan is None:
        raise ApiError(404, f"{patient.name} has no plan yet", "a plan", "make one on the patient's page")
    return _public(plan)


@router.put("/patients/{patient_id}/plan", responses=answers(401, 403, 404, 422, 503))
def put_plan(form: PlanForm, patient: PatientDep, account: TherapistDep, session: SessionDep) -> PlanPublic:
    """Plan, in place of what was planned before. Sessions are opened with it unless they say otherwise."""
    check_games(form.exercises)
    return _public(plans.put_plan(session, patient.id or 0, form, account.name))


@router.get("/patients/{patient_id}/adherence", responses=answers(401, 403, 404, 422, 503))
def read_adherence(
    patient: PatientDep, session: SessionDep, weeks: Annotated[int, Query(ge=1, le=104)] = 12
) -> Adherence:
    """What was done of what was planned in the last calendar weeks, this one included."""
    day = adherence.today()
    since = adherence.beginning_of(adherence.monday_of(day) - timedelta(days=DAYS * (weeks - 1)))
    begun = sessions.begun_since(session, since, patient.id)
    return adherence.adherence(plans.find_plan(session, patient.id or 0), begun, weeks, day)


@router.get("/today", responses=answers(401, 403, 503))
def read_today(_: TherapistDep, session: SessionDep) -> list[PatientToday]:
    """Every patient with what the plan asks for today, those who are due first."""
    return list_today(session, adherence.today())


def _public(plan: TherapyPlan) -> PlanPublic:
    return PlanPublic.model_validate(plan)
