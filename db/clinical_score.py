"""Scores of standard tests that a person enters: how well the arm does outside the device."""

from __future__ import annotations

from datetime import date, datetime
from typing import Literal, Self

from pydantic import model_validator
from sqlalchemy import String
from sqlmodel import Field, SQLModel

from db.columns import UtcDateTime, now_utc
from db.patient import SideName

ScoreKind = Literal["fugl-meyer-ue", "arat", "box-and-block"]
GREATEST: dict[ScoreKind, int] = {"fugl-meyer-ue": 66, "arat": 57, "box-and-block": 150}
"""Fugl-Meyer upper extremity: 33 items of 0..2. ARAT: 19 items of 0..3. Box and Block: blocks in a minute, of 150."""


class ClinicalScoreBase(SQLModel):
    """What every form of a score says."""

    kind: ScoreKind = Field(sa_type=String)
    side: SideName = Field(sa_type=String, description="The arm that was tested.")
    value: int = Field(ge=0, description="Fugl-Meyer UE 0 to 66, ARAT 0 to 57, Box and Block 0 to 150.")
    on: date = Field(description="The day of the test.")
    rater: str = Field(min_length=1, max_length=80)
    note: str = Field(default="", max_length=2000)


class ClinicalScore(ClinicalScoreBase, table=True):
    """A score as stored."""

    __tablename__ = "clinical_score"

    id: int | None = Field(default=None, primary_key=True)
    patient_id: int = Field(foreign_key="patient.id", index=True)
    entered_by: str = Field(max_length=80)
    entered_at: datetime = Field(default_factory=now_utc, sa_type=UtcDateTime)


class ClinicalScoreForm(ClinicalScoreBase):
    """What a person enters."""

    model_config = {
        "extra": "forbid",
        "str_strip_whitespace": True,
        "json_schema_extra": {
            "examples": [
                {"kind": "arat", "side": "left", "value": 31, "on": "2026-03-02", "rater": "Dr. Lin", "note": ""}
            ]
        },
    }

    @model_validator(mode="after")
    def _is_on_its_scale(self) -> Self:
        if self.value > GREATEST[self.kind]:
            raise ValueError(f"the scale of {self.kind} ends at {GREATEST[self.kind]}")
        if self.on > now_utc().astimezone().date():
            raise ValueError("the day of the test is still to come")
        return self


class ClinicalScorePublic(ClinicalScoreBase):
    """A score as the browser sees it."""

    id: int
    entered_by: str
    entered_at: datetime
