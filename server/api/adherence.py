"""What was done of what was planned: per day, per calendar week, and what is due today. Days are this machine's."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from datetime import date, datetime, time, timedelta

from db.columns import now_utc
from db.plan import DAYS, TherapyPlan
from db.therapy_session import SessionStatus, TherapySession
from server.api.plan_forms import Adherence, AdherenceDay, AdherenceWeek

LEAST_PLAYED_S = 60.0
"""A session that was broken off earlier is not one that was done."""


def today() -> date:
    """The day that it is here."""
    return now_utc().astimezone().date()


def monday_of(day: date) -> date:
    """The Monday of that day's week."""
    return day - timedelta(days=day.weekday())


def beginning_of(day: date) -> datetime:
    """The moment at which that day begins here."""
    return datetime.combine(day, time()).astimezone()


def day_of(session: TherapySession) -> date:
    """The day on which a session began."""
    return session.started_at.astimezone().date()


def counts_as_done(session: TherapySession) -> bool:
    """Whether a session counts: it is over, and somebody really played in it."""
    played_s = sum(one.played_s for one in session.played)
    return session.status is not SessionStatus.OPEN and played_s >= LEAST_PLAYED_S


def done_since(sessions: Iterable[TherapySession], since: date) -> int:
    """How many sessions that count began on that day or later."""
    return sum(counts_as_done(session) and day_of(session) >= since for session in sessions)


def adherence(plan: TherapyPlan | None, sessions: Sequence[TherapySession], weeks: int, day: date) -> Adherence:
    """The last calendar weeks up to and with the one of `day`, oldest first; without a plan nothing was planned."""
    first = monday_of(day) - timedelta(days=DAYS * (weeks - 1))
    done = [session for session in sessions if counts_as_done(session)]
    return Adherence(
        days=[_day(first + timedelta(days=k), done) for k in range(DAYS * weeks)],
        weeks=[_week(first + timedelta(days=DAYS * k), plan, done) for k in range(weeks)],
    )


def _day(day: date, done: Sequence[TherapySession]) -> AdherenceDay:
    played = [session.played for session in done if day_of(session) == day]
    return AdherenceDay(
        on=day,
        sessions=len(played),
        minutes=sum(one.played_s for exercises in played for one in exercises) / 60.0,
        repetitions=sum(one.hits + one.misses for exercises in played for one in exercises),
    )


def _week(monday: date, plan: TherapyPlan | None, done: Sequence[TherapySession]) -> AdherenceWeek:
    following = monday + timedelta(days=DAYS)
    return AdherenceWeek(
        monday=monday,
        done=sum(monday <= day_of(session) < following for session in done),
        planned=planned_in_week(plan, monday),
    )


def planned_in_week(plan: TherapyPlan | None, monday: date) -> int:
    """Sessions planned in the calendar week of that Monday."""
    return 0 if plan is None else plan.planned(monday, monday + timedelta(days=DAYS))


def is_due(plan: TherapyPlan | None, sessions: Sequence[TherapySession], day: date) -> bool:
    """Whether the plan asks for a session on `day`: it runs, the week's are not all done, and not enough was done
    today: one session, or more where a week has more of them than days.

    Args:
        plan: the patient's plan.
        sessions: the patient's sessions of this week, or more.
        day: today.
    """
    if plan is None or not plan.runs_on(day) or done_since(sessions, day) >= plan.most_in_a_day:
        return False
    monday = monday_of(day)
    return done_since(sessions, monday) < planned_in_week(plan, monday)
