"""One exercise of a plan or a session: which game, for how long, how hard; and what became of it."""

from __future__ import annotations

from pydantic import BaseModel, ConfigDict, Field


class Exercise(BaseModel):
    """What is to be played."""

    model_config = ConfigDict(frozen=True, extra="forbid")

    game: str = Field(min_length=1, max_length=40)
    minutes: float = Field(gt=0, le=60, description="Of play; rests come on top.")
    level: float | None = Field(
        default=None, ge=0, le=1, description="Difficulty at the start; null = what the patient last reached in it."
    )
    pinned: bool = Field(default=False, description="The difficulty stays as it began.")


class PlayedExercise(BaseModel):
    """What has been played of an exercise."""

    model_config = ConfigDict(frozen=True)

    game: str
    played_s: float = Field(ge=0)
    score: int
    hits: int
    misses: int
    level: float = Field(ge=0, le=1, description="Difficulty reached at its end.")
