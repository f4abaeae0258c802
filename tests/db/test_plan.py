"""How many sessions a plan asks for, and when."""

from datetime import date, timedelta

from hypothesis import given
from hypothesis import strategies as st

from db.exercise import Exercise
from db.plan import TherapyPlan

days = st.dates(date(2026, 1, 1), date(2026, 12, 31))


def plan(starts_on, weeks=4, sessions_per_week=3):
    return TherapyPlan(
        patient_id=1,
        exercises=(Exercise(game="reach", minutes=6.0),),
        sessions_per_week=sessions_per_week,
        weeks=weeks,
        starts_on=starts_on,
        updated_by="lin",
    )


@given(days, st.integers(1, 10), st.integers(1, 14))
def test_the_weeks_of_a_plan_add_up_to_the_whole_wherever_it_starts(starts_on, weeks, sessions_per_week):
    made = plan(starts_on, weeks, sessions_per_week)
    monday = starts_on - timedelta(days=starts_on.weekday())
    mondays = [monday + timedelta(days=7 * k) for k in range(-1, weeks + 3)]
    planned = [made.planned(one, one + timedelta(days=7)) for one in mondays]
    assert sum(planned) == weeks * sessions_per_week
    assert all(0 <= one <= sessions_per_week for one in planned)


def test_a_plan_runs_from_its_first_day_for_whole_weeks():
    made = plan(date(2026, 3, 4), weeks=2)
    asked = [made.runs_on(date(2026, 3, 4) + timedelta(days=k)) for k in (-1, 0, 13, 14)]
    assert asked == [False, True, True, False]
