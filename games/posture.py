"""Whether the trunk or the shoulder helps along too much: compensation, seen and answered kindly."""

from __future__ import annotations

from dataclasses import dataclass, replace
from typing import Final

LEAN_M: Final = 0.08
HITCH_M: Final = 0.04
"""Less is breathing, reaching as everybody reaches, and the sensors' noise."""
GOES_BELOW: Final = 0.7
"""It is over once it is below this share of the threshold, so that the hint does not flicker."""
LASTS_S: Final = 1.0
"""So long it must last before it is said, or no longer be so before it is taken back."""
EASED: Final = 0.15
"""Levels by which attempts become easier while the body helps along: nearer is within reach again."""


@dataclass(frozen=True, slots=True)
class Posture:
    """What is said now, and for how long something else has been so."""

    said: str = ""
    """"", "lean" or "hitch"."""
    other_s: float = 0.0

    def after(self, lean_m: float, hitch_m: float, dt_s: float) -> Posture:
        """The posture `dt_s` later; a value that is not a number counts as upright."""
        seen = self._seen(lean_m, hitch_m)
        if seen == self.said:
            return replace(self, other_s=0.0)
        other_s = self.other_s + dt_s
        return Posture(seen) if other_s >= LASTS_S else replace(self, other_s=other_s)

    def _seen(self, lean_m: float, hitch_m: float) -> str:
        if lean_m > LEAN_M * (GOES_BELOW if self.said == "lean" else 1.0):
            return "lean"
        if hitch_m > HITCH_M * (GOES_BELOW if self.said == "hitch" else 1.0):
            return "hitch"
        return ""


UPRIGHT: Final = Posture()
