"""What the REST interface takes and gives about the games of the open session."""

from __future__ import annotations

from typing import Literal

from pydantic import BaseModel, ConfigDict, Field

from db.limits import PassiveRange
from db.workspace import SessionWorkspace
from server.api.forms import Form

WishName = Literal["start", "pause", "go_on", "next", "rest", "quit", "pin", "adapt"]


class GameWish(Form):
    """What a person wants of the game."""

    wish: WishName
    level: float | None = Field(default=None, ge=0, le=1, description="With `pin`; null = as it is now.")

    model_config = ConfigDict(extra="forbid", json_schema_extra={"examples": [{"wish": "pin", "level": 0.4}]})


class GameAnswer(BaseModel):
    """How the game stood when the wish was taken; it is done with the next tick, as the stream shows."""

    game: str
    phase: str

    model_config = ConfigDict(json_schema_extra={"examples": [{"game": "reach", "phase": "playing"}]})


class WorkspaceShown(BaseModel):
    """What the healthy arm has shown while the session was prepared."""

    seen_s: float
    """How long it was seen."""
    shown: PassiveRange | None
    """Mirrored, without the outermost 2 % at both ends; null until every joint has been seen."""
    missing: list[str]
    """Joints that have not moved far enough."""
    enough: bool


class SessionWorkspacePublic(WorkspaceShown):
    """What has been shown, and what the games go by."""

    begun: bool
    """The games have begun: their workspace stays as it is."""
    workspace: SessionWorkspace

    model_config = ConfigDict(
        json_schema_extra={
            "examples": [
                {
                    "seen_s": 2.5,
                    "shown": None,
                    "missing": ["rotation", "elbow"],
                    "enough": False,
                    "begun": False,
                    "workspace": {"source": "limits", "shown": None, "used": PassiveRange().model_dump()},
                }
            ]
        }
    )
