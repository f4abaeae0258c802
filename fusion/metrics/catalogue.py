"""Every measure by its name. A further one is an entry in `definitions`, and strings in both languages."""

from __future__ import annotations

from collections.abc import Mapping
from types import MappingProxyType
from typing import Final

from fusion.metrics.definitions import body, effort, game, movement, session
from fusion.metrics.measure import Measure

MEASURES: Final[Mapping[str, Measure]] = MappingProxyType(
    {
        each.name: each
        for each in (
            *movement.MEASURES,
            *body.MEASURES,
            *effort.MEASURES,
            *game.MEASURES,
            *session.MEASURES,
            *session.ASKED_MEASURES,
        )
    }
)
"""What sessions are measured by, and what is asked of the patient."""
