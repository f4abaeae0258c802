"""A therapy session, what it measured and what happened in it."""

from __future__ import annotations

from datetime import datetime
from enum import StrEnum
from typing import Any

from pydantic import BaseModel, ConfigDict
from sqlalchemy import JSON, String
from sqlmodel import Field, SQLModel

from db.columns import Document, UtcDateTime, now_utc, word_of
from db.exercise import Exercise, PlayedExercise
from db.limits import AssistanceName
from db.patient import SideName
from db.workspace import SessionWorkspace

NOTES_LENGTH = 10_000


class SessionStatus(StrEnum):
    """Where a session stands."""

    OPEN = "open"
    ENDED = "ended"
    INTERRUPTED = "interrupted"
    """Cut short by a crash; its metrics come from what was recorded."""


class LimitsSnapshot(BaseModel):
    """What one joint of the exoskeleton was allowed in this session."""

    model_config = ConfigDict(frozen=True)

    joint: str
    min_rad: float
    max_rad: float
    velocity_rad_s: float
    acceleration_rad_s2: float
    torque_nm: float | None = None
    """Null in sessions from before it was limited."""
    resistance_nm: float | None = None


class AllLimits(BaseModel):
    """The limits of every joint in this session, and who signed for them."""

    model_config = ConfigDict(frozen=True)

    joints: tuple[LimitsSnapshot, ...] = ()
    set_by: str = ""
    set_at: datetime | None = None


class SessionBase(SQLModel):
    """What every form of a session says."""

    patient_id: int = Field(foreign_key="patient.id", index=True)
    affected_side: SideName = Field(sa_type=String)
    exercises: tuple[Exercise, ...] = Field(sa_type=Document(tuple[Exercise, ...]), description="As they began.")
    played: tuple[PlayedExercise, ...] = Field(
        default=(), sa_type=Document(tuple[PlayedExercise, ...]), description="What became of them."
    )
    seed: int
    assistance: AssistanceName = Field(default="passive", sa_type=String, description="How the drive began to help.")
    assist_level: float = Field(default=1.0, ge=0, le=1, description="The most help while assisted, at the start.")
    started_at: datetime = Field(default_factory=now_utc, sa_type=UtcDateTime)
    ended_at: datetime | None = Field(default=None, sa_type=UtcDateTime)
    status: SessionStatus = Field(default=SessionStatus.OPEN, sa_type=word_of(SessionStatus))
    pain_before: int | None = Field(default=None, ge=0, le=10)
    pain_after: int | None = Field(default=None, ge=0, le=10)
    limits: AllLimits = Field(default_factory=AllLimits, sa_type=Document(AllLimits))
    workspace: SessionWorkspace | None = Field(
        default=None, sa_type=Document(SessionWorkspace), description="Null in sessions from before it was kept."
    )
    version: str = Field(default="", max_length=40, description="The program's version.")


class TherapySession(SessionBase, table=True):
    """A session as stored. `recording` is relative to the data folder."""

    __tablename__ = "therapy_session"

    id: int | None = Field(default=None, primary_key=True)
    therapist_id: int = Field(foreign_key="account.id", index=True)
    recording: str = Field(default="", max_length=200)
    notes: str = Field(default="", max_length=NOTES_LENGTH)
    measured: bool = False
    """Its metrics are in the database; false where that failed and must be tried again."""


class MetricBase(SQLModel):
    """One figure of a session; docs/metrics.md says how each is defined."""

    name: str = Field(max_length=60)
    joint: str = Field(default="", max_length=160, description="Or the sensor, in a sensor's figures.")
    side: str = Field(default="", max_length=10)
    value: float | None = Field(description="Null where it could not be measured.")
    sem: float | None = Field(default=None, description="Standard error of the value within the session, if known.")
    unit: str = Field(default="", max_length=20)
    label: str = Field(default="", max_length=80, description="Key of its name in the browser's strings.")
    caveat: str = Field(default="", max_length=80, description="Key of what must be said beside it, or empty.")


class Metric(MetricBase, table=True):
    """A figure as stored."""

    __tablename__ = "metric"

    id: int | None = Field(default=None, primary_key=True)
    session_id: int = Field(foreign_key="therapy_session.id", index=True, ondelete="CASCADE")


class MetricPublic(MetricBase):
    """A figure as the browser sees it."""


class EventBase(SQLModel):
    """Something that happened in a session."""

    t: datetime = Field(default_factory=now_utc, sa_type=UtcDateTime)
    kind: str = Field(max_length=40, index=True)
    text: str = Field(default="", max_length=1000)
    data: dict[str, Any] = Field(default_factory=dict, sa_type=JSON)


class Event(EventBase, table=True):
    """An event as stored."""

    __tablename__ = "event"

    id: int | None = Field(default=None, primary_key=True)
    session_id: int = Field(foreign_key="therapy_session.id", index=True, ondelete="CASCADE")


class EventPublic(EventBase):
    """An event as the browser sees it."""

    id: int


class SessionPublic(SessionBase):
    """A session as the browser sees it."""

    id: int
    patient_name: str
    therapist_name: str
    measured: bool


class SessionDetail(SessionPublic):
    """A session with what it measured and what its therapist noted."""

    notes: str
    metrics: list[MetricPublic] = []


class SessionUpdate(SQLModel):
    """What a therapist may add during a session and afterwards; whatever is left out stays."""

    model_config = {
        "extra": "forbid",
        "json_schema_extra": {"examples": [{"notes": "less trunk than last week", "pain_after": 1}]},
    }

    notes: str | None = Field(default=None, max_length=NOTES_LENGTH)
    pain_after: int | None = Field(default=None, ge=0, le=10)
