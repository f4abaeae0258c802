"""A patient: who, which side is healthy, and what the affected arm may do."""

from __future__ import annotations

from datetime import datetime
from typing import Literal

from sqlalchemy import String
from sqlmodel import Field, SQLModel

from db.columns import Document, UtcDateTime, now_utc
from db.limits import AssistanceName, ForceLimits, PassiveRange, PatientLimits

SideName = Literal["left", "right"]
"""A side of the patient's body, always the patient's own."""
SIGNED_FOR = ("healthy_side", *PatientLimits.model_fields)
"""What a signature covers: where one of these changes, it no longer holds (SR-10)."""


class PatientBase(SQLModel):
    """What every form of a patient says."""

    name: str = Field(min_length=1, max_length=120, description="A name or a pseudonym.")
    healthy_side: SideName = Field(sa_type=String, description="The patient's own left or right.")
    notes: str = Field(default="", max_length=10_000)
    passive_range: PassiveRange = Field(default_factory=PassiveRange, sa_type=Document(PassiveRange))
    force_limits: ForceLimits = Field(default_factory=ForceLimits, sa_type=Document(ForceLimits))
    assistance: AssistanceName = Field(default="passive", sa_type=String, description="How a session begins.")
    assist_level_most: float = Field(default=1.0, ge=0, le=1, description="The most help while assisted, 0 to 1.")


class Patient(PatientBase, table=True):
    """A patient as stored."""

    __tablename__ = "patient"

    id: int | None = Field(default=None, primary_key=True)
    created_by_id: int = Field(foreign_key="account.id", index=True)
    created_at: datetime = Field(default_factory=now_utc, sa_type=UtcDateTime)
    updated_at: datetime = Field(default_factory=now_utc, sa_type=UtcDateTime)
    limits_set_by: str = Field(default="", max_length=80)
    """Account that signed for the limits as they are; "" = nobody has (SR-10)."""
    limits_set_at: datetime | None = Field(default=None, sa_type=UtcDateTime)

    @property
    def limits(self) -> PatientLimits:
        """What somebody signs for."""
        return PatientLimits(
            passive_range=self.passive_range,
            force_limits=self.force_limits,
            assist_level_most=self.assist_level_most,
        )


class PatientCreate(PatientBase):
    """What a therapist fills in at enrolment. Nothing may move before somebody has signed for the limits."""

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
                    "force_limits": ForceLimits().model_dump(),
                    "assistance": "assisted",
                    "assist_level_most": 0.8,
                }
            ]
        },
    }


class PatientUpdate(SQLModel):
    """What a therapist may change later; whatever is left out stays. Changed limits want a new signature."""

    model_config = {
        "extra": "forbid",
        "str_strip_whitespace": True,
        "json_schema_extra": {"examples": [{"notes": "no longer tires"}]},
    }

    name: str | None = Field(default=None, min_length=1, max_length=120)
    healthy_side: SideName | None = None
    notes: str | None = Field(default=None, max_length=10_000)
    passive_range: PassiveRange | None = None
    force_limits: ForceLimits | None = None
    assistance: AssistanceName | None = None
    assist_level_most: float | None = Field(default=None, ge=0, le=1)


class PatientPublic(PatientBase):
    """A patient as the browser sees it."""

    id: int
    created_at: datetime
    updated_at: datetime
    limits_set_by: str = Field(description="Account that signed for the limits as they are; empty = nobody has.")
    limits_set_at: datetime | None
