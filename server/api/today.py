"""Today's list: every patient with what the plan asks for, those who are due first."""

from __future__ import annotations

from collections.abc import Sequence
from datetime import date

from sqlmodel import Session

from db.patient import Patient
from db.plan import DAYS, TherapyPlan
from db.queries import patients, plans, sessions
from db.therapy_session import TherapySession
from server.api.adherence import beginning_of, done_since, is_due, monday_of, planned_in_week
from server.api.plan_forms import LastSession, PatientToday, PlanInShort


def list_today(session: Session, day: date) -> list[PatientToday]:
    """Every patient, those who are due first, then by name."""
    planned, last = plans.all_plans(session), sessions.newest_of_each(session)
    this_week = sessions.begun_since(session, beginning_of(monday_of(day)))
    rows = [
        _row(patient, planned.get(patient.id or 0), _of(patient, this_week), last.get(patient.id or 0), day)
        for patient in patients.list_patients(session)
    ]
    return sorted(rows, key=lambda row: not row.due)


def _of(patient: Patient, begun: Sequence[TherapySession]) -> list[TherapySession]:
    return [session for session in begun if session.patient_id == patient.id]


def _row(
    patient: Patient,
    plan: TherapyPlan | None,
    this_week: Sequence[TherapySession],
    last: TherapySession | None,
    day: date,
) -> PatientToday:
    return PatientToday(
        id=patient.id or 0,
        name=patient.name,
        healthy_side=patient.healthy_side,
        limits_signed=bool(patient.limits_set_by),
        plan=None if plan is None else _in_short(plan, day),
        done_this_week=done_since(this_week, monday_of(day)),
        planned_this_week=planned_in_week(plan, monday_of(day)),
        last_session=None if last is None else _last(last),
        due=is_due(plan, this_week, day),
    )


def _in_short(plan: TherapyPlan, day: date) -> PlanInShort:
    return PlanInShort(
        exercises=plan.exercises,
        minutes=sum(exercise.minutes for exercise in plan.exercises),
        week=max(0, (day - plan.starts_on).days // DAYS + 1),
        weeks=plan.weeks,
        sessions_per_week=plan.sessions_per_week,
    )


def _last(session: TherapySession) -> LastSession:
    return LastSession(
        id=session.id or 0,
        started_at=session.started_at,
        status=session.status,
        minutes=sum(one.played_s for one in session.played) / 60.0,
    )
