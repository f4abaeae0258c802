"""Where a session's games placed what they ask for, as joint ranges of the affected arm."""

from __future__ import annotations

from typing import Literal

from pydantic import BaseModel, ConfigDict

from db.limits import PassiveRange

WorkspaceSource = Literal["shown", "last", "limits"]
"""The healthy arm has shown it in this session; it is the last session's; nobody has measured any."""


class SessionWorkspace(BaseModel):
    """The workspace of a session's games."""

    model_config = ConfigDict(frozen=True)

    source: WorkspaceSource
    shown: PassiveRange | None = None
    """What the healthy arm has shown in this session, mirrored."""
    pushed: bool = False
    """The last session succeeded, so that a little more is asked for than was shown or used before."""
    used: PassiveRange
    """Where things are placed."""
