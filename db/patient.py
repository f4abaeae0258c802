"""A patient: who, which side is healthy, and how far the affected arm may be moved."""

from __future__ import annotations

from datetime import datetime
from math import pi, radians
from typing import Literal, Self

from pydantic import BaseModel, ConfigDict, model_validator
from sqlalchemy import String
from sqlmodel import Field, SQLModel

from db.columns import Document, UtcDateTime, now_utc

SideName = Literal["left", "right"]
"""A side of the patient's body, always the patient's own."""


class JointRange(BaseModel):
    """How far one joint may be moved, in radians."""

    model_config = ConfigDict(frozen=True, extra="forbid")

    min_rad: float = Field(ge=-pi, le=pi)
    max_rad: float = Field(ge=-pi, le=pi)

    @model_validator(mode="after")
    def _is_in_order(self) -> Self:
        if self.min_rad >= self.max_rad:
            raise ValueError("the least angle must be smaller than the greatest")
        return self


def _degrees(least: float, greatest: float) -> JointRange:
    return JointRange(min_rad=radians(least), max_rad=radians(greatest))


class PassiveRange(BaseModel):
    """How far a therapist could move each joint of the affected arm by hand, measured at enrolment (SR-18).

    Plane (0 = sideways, +90° = ahead) and elevation of the upper arm's swing, the humerus' rotation (internal +), elbow
    flexion. The defaults are cautious: within what a relaxed adult arm allows.
    """

    model_config = ConfigDict(frozen=True, extra="forbid")

    plane: JointRange = _degrees(-20, 120)
    elevation: JointRange = _degrees(0, 100)
    rotation: JointRange = _degrees(-60, 80)
    elbow: JointRange = _degrees(0, 135)


class PatientBase(SQLModel):
    """What every form of a patient says."""

    name: str = Field(min_length=1, max_length=120, description="A name or a pseudonym.")
    healthy_side: SideName = Field(sa_type=String, description="The patient's own left or right.")
    notes: str = Field(default="", max_length=10_000)
    passive_range: PassiveRange = Field(default_factory=PassiveRange, sa_type=Document(PassiveRange))


class Patient(PatientBase, table=True):
    """A patient as stored."""

    __tablename__ = "patient"

    id: int | None = Field(default=None, primary_key=True)
    created_by_id: int = Field(foreign_key="account.id", index=True)
    created_at: datetime = Field(default_factory=now_utc, sa_type=UtcDateTime)
    updated_at: datetime = Field(default_factory=now_utc, sa_type=UtcDateTime)


class PatientCreate(PatientBase):
    """What a therapist fills in at enrolment."""

    model_config = {
        "extra": "forbid",
        "str_strip_whitespace": True,
        "json_schema_extra": {
            "examples": [
                {
                    "name": "Wang",
                    "healthy_side": "right",
                    "notes": "tires quickly",
                    "passive_range": PassiveRange().model_dump(),
                }
            ]
        },
    }


class PatientUpdate(SQLModel):
    """What a therapist may change later; whatever is left out stays."""

    model_config = {
        "extra": "forbid",
        "str_strip_whitespace": True,
        "json_schema_extra": {"examples": [{"notes": "no longer tires"}]},
    }

    name: str | None = Field(default=None, min_length=1, max_length=120)
    healthy_side: SideName | None = None
    notes: str | None = Field(default=None, max_length=10_000)
    passive_range: PassiveRange | None = None


class PatientPublic(PatientBase):
    """A patient as the browser sees it."""

    id: int
    created_at: datetime
    updated_at: datetime
