"""What the replay's routes take and give."""

from __future__ import annotations

from pydantic import BaseModel, ConfigDict, Field

from server.api.forms import Number
from server.messages import DriveState


class ReplayForm(BaseModel):
    """Which session is shown, and how it runs from now on."""

    session_id: Number
    t_s: float | None = Field(default=None, ge=0, description="Go there; null = go on from where it stands.")
    playing: bool = True
    speed: float = Field(default=1.0, ge=0.1, le=8.0, description="1 = as it was.")

    model_config = ConfigDict(
        extra="forbid",
        json_schema_extra={"examples": [{"session_id": 7, "t_s": 12.5, "playing": True, "speed": 0.5}]},
    )


class ReplayPublic(BaseModel):
    """How the replay stands."""

    session_id: int
    duration_s: float
    t_s: float
    playing: bool
    speed: float

    model_config = ConfigDict(
        json_schema_extra={
            "examples": [{"session_id": 7, "duration_s": 362.4, "t_s": 12.5, "playing": True, "speed": 0.5}]
        }
    )


class StateSpan(BaseModel):
    """The arm was in one state."""

    state: DriveState
    from_s: float
    to_s: float


class Mark(BaseModel):
    """Something that happened at an instant."""

    kind: str = Field(description="hit, missed or pain.")
    t_s: float


class Timeline(BaseModel):
    """What a replay's time line shows; seconds since the recording's first picture."""

    session_id: int
    duration_s: float
    spans: list[StateSpan]
    marks: list[Mark]

    model_config = ConfigDict(
        json_schema_extra={
            "examples": [
                {
                    "session_id": 7,
                    "duration_s": 362.4,
                    "spans": [{"state": "engaged", "from_s": 4.0, "to_s": 362.4}],
                    "marks": [{"kind": "hit", "t_s": 9.5}],
                }
            ]
        }
    )
