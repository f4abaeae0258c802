"""What the REST interface gives about plans, besides the plan itself, which is `db.plan`'s."""

from __future__ import annotations

from datetime import date, datetime

from pydantic import BaseModel, ConfigDict, Field

from db.exercise import Exercise
from db.patient import SideName
from db.therapy_session import SessionStatus


class AdherenceDay(BaseModel):
    """What was done on a day."""

    on: date
    sessions: int
    minutes: float
    """Played, rests and pauses left out."""
    repetitions: int
    """Attempts, successful or not."""


class AdherenceWeek(BaseModel):
    """A calendar week's sessions."""

    monday: date
    done: int
    planned: int


class Adherence(BaseModel):
    """What was done of what was planned, in whole calendar weeks, oldest first."""

    days: list[AdherenceDay]
    weeks: list[AdherenceWeek]

    model_config = ConfigDict(
        json_schema_extra={
            "examples": [
                {
                    "days": [{"on": "2026-03-02", "sessions": 1, "minutes": 11.5, "repetitions": 84}],
                    "weeks": [{"monday": "2026-03-02", "done": 1, "planned": 3}],
                }
            ]
        }
    )


class PlanInShort(BaseModel):
    """A plan in a line."""

    exercises: tuple[Exercise, ...]
    minutes: float
    """Of play in a session."""
    week: int = Field(description="1 = the first; 0 = not begun; more than `weeks` = over.")
    weeks: int
    sessions_per_week: int


class LastSession(BaseModel):
    """A patient's newest session in a line."""

    id: int
    started_at: datetime
    status: SessionStatus
    minutes: float
    """Played."""


class PatientToday(BaseModel):
    """A patient on the list of today."""

    id: int
    name: str
    healthy_side: SideName
    limits_signed: bool
    plan: PlanInShort | None
    done_this_week: int
    planned_this_week: int
    last_session: LastSession | None
    due: bool
    """The plan asks for a session today."""

    model_config = ConfigDict(
        json_schema_extra={
            "examples": [
                {
                    "id": 1,
                    "name": "Wang",
                    "healthy_side": "right",
                    "limits_signed": True,
                    "plan": {
                        "exercises": [{"game": "reach", "minutes": 6.0, "level": None, "pinned": False}],
                        "minutes": 6.0,
                        "week": 2,
                        "weeks": 4,
                        "sessions_per_week": 3,
                    },
                    "done_this_week": 1,
                    "planned_this_week": 3,
                    "last_session": {
                        "id": 12,
                        "started_at": "2026-03-10T09:00:00Z",
                        "status": "ended",
                        "minutes": 11.5,
                    },
                    "due": True,
                }
            ]
        }
    )
