"""A patient's plan: which games, for how long, how often a week, for how many weeks."""

from __future__ import annotations

from datetime import date, datetime, timedelta
from math import ceil
from typing import Self

from pydantic import model_validator
from sqlmodel import Field, SQLModel

from db.columns import Document, UtcDateTime, now_utc
from db.exercise import Exercise

DAYS = 7
LATEST_START = timedelta(days=366)
"""A plan begins at most so long after the day on which it is made."""


class PlanBase(SQLModel):
    """What every form of a plan says."""

    exercises: tuple[Exercise, ...] = Field(min_length=1, max_length=12, sa_type=Document(tuple[Exercise, ...]))
    repetitions: int | None = Field(
        default=None, ge=1, le=2000, description="Attempts to aim for in a session, all games together; null = no aim."
    )
    sessions_per_week: int = Field(ge=1, le=14)
    weeks: int = Field(ge=1, le=52)
    starts_on: date
    note: str = Field(default="", max_length=10_000)


class TherapyPlan(PlanBase, table=True):
    """A plan as stored; a patient has one at most."""

    __tablename__ = "plan"

    patient_id: int = Field(foreign_key="patient.id", primary_key=True)
    updated_by: str = Field(max_length=80)
    updated_at: datetime = Field(default_factory=now_utc, sa_type=UtcDateTime)

    @property
    def ends_before(self) -> date:
        """The first day that is no longer the plan's."""
        return self.starts_on + timedelta(days=DAYS * self.weeks)

    def runs_on(self, day: date) -> bool:
        """Whether the plan asks for anything on that day."""
        return self.starts_on <= day < self.ends_before

    @property
    def most_in_a_day(self) -> int:
        """So many sessions a day are enough to do those of a week."""
        return ceil(self.sessions_per_week / DAYS)

    def planned(self, since: date, until: date) -> int:
        """Sessions planned from `since` up to, not including, `until`. A week cut by the plan's start gets its share,
        and the shares of all weeks add up to the whole.
        """
        return self._planned_before(until) - self._planned_before(since)

    def _planned_before(self, day: date) -> int:
        days = (min(max(day, self.starts_on), self.ends_before) - self.starts_on).days
        return ceil(self.sessions_per_week * days / DAYS)


class PlanForm(PlanBase):
    """What a therapist plans."""

    model_config = {
        "extra": "forbid",
        "str_strip_whitespace": True,
        "json_schema_extra": {
            "examples": [
                {
                    "exercises": [{"game": "reach", "minutes": 6.0, "level": None, "pinned": False}],
                    "repetitions": 60,
                    "sessions_per_week": 3,
                    "weeks": 4,
                    "starts_on": "2026-03-02",
                    "note": "the elbow first",
                }
            ]
        },
    }

    @model_validator(mode="after")
    def _begins_in_time(self) -> Self:
        if self.starts_on > now_utc().astimezone().date() + LATEST_START:
            raise ValueError("the plan begins more than a year from now")
        return self


class PlanPublic(PlanBase):
    """A plan as the browser sees it."""

    patient_id: int
    updated_by: str
    updated_at: datetime
