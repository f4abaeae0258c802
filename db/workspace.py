"""How far the healthy arm has shown that the game may ask the other to go."""

from __future__ import annotations

from pydantic import BaseModel, ConfigDict

from db.limits import PassiveRange


class MeasuredWorkspace(BaseModel):
    """The workspace of a session's games, as joint ranges of the affected arm."""

    model_config = ConfigDict(frozen=True)

    shown: PassiveRange
    """What the healthy arm has shown, mirrored."""
    used: PassiveRange
    """Where things are placed: the shown range inside the limits, pushed outwards."""
