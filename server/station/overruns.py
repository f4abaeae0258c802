"""Ticks that could not begin in time: each is counted, and many in a short time are a reason to hold (SR-9)."""

from __future__ import annotations

from dataclasses import dataclass, field
from typing import Final

WINDOW_S: Final = 1.0
MOST_SHARE: Final = 0.25
"""Of the ticks of the window; an arm that is commanded less often than that is not commanded at 100 Hz."""


@dataclass(frozen=True, slots=True)
class Overruns:
    """How many ticks were missed, and when the newest were."""

    in_all: int = 0
    recent: tuple[tuple[float, int], ...] = field(default=())
    """When, and how many at once; of the window only."""

    def counted(self, slots: int, now_s: float) -> Overruns:
        """With `slots` more that passed before `now_s`."""
        kept = tuple(entry for entry in self.recent if now_s - entry[0] < WINDOW_S)
        return Overruns(self.in_all + slots, (*kept, (now_s, slots)))

    def fault(self, rate_hz: int, now_s: float) -> str:
        """Why the arm cannot be moved, in plain words; "" = it can."""
        missed = sum(slots for t_s, slots in self.recent if now_s - t_s < WINDOW_S)
        if missed <= MOST_SHARE * WINDOW_S * rate_hz:
            return ""
        return (
            f"The computer is too busy: {missed} of the control loop's last {WINDOW_S * rate_hz:.0f} ticks were late."
        )
