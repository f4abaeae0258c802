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
SETTLES_S: Final = 20.0
"""A body that stays elsewhere for so long has not leant but sat differently: from there it is measured then."""
EASED: Final = 0.15
"""Levels by which attempts become easier while the body helps along: nearer is within reach again."""


@dataclass(frozen=True, slots=True)
class Posture:
    """What is said now, and since when."""

    said: str = ""
    """"", "lean" or "hitch"."""
    other_s: float = 0.0
    """For how long something else has been so."""
    since_s: float = 0.0
    """For how long it has been said."""
    settled_m: float = 0.0
    """Where the trunk sits, as displacement from where it was when the arm was enabled."""

    def after(self, lean_m: float, hitch_m: float, dt_s: float) -> Posture:
        """The posture `dt_s` later; a value that is not a number counts as upright."""
        if self.said == "lean" and self.since_s >= SETTLES_S and lean_m >= 0.0:
            return Posture(settled_m=lean_m)
        seen = self._seen(lean_m - self.settled_m, hitch_m)
        settled_m = min(self.settled_m, lean_m) if lean_m >= 0.0 else self.settled_m
        if seen == self.said:
            return replace(self, other_s=0.0, since_s=self.since_s + dt_s, settled_m=settled_m)
        other_s = self.other_s + dt_s
        if other_s >= LASTS_S:
            return Posture(seen, settled_m=settled_m)
        return replace(self, other_s=other_s, since_s=self.since_s + dt_s, settled_m=settled_m)

    def _seen(self, lean_m: float, hitch_m: float) -> str:
        if lean_m > LEAN_M * (GOES_BELOW if self.said == "lean" else 1.0):
            return "lean"
        if hitch_m > HITCH_M * (GOES_BELOW if self.said == "hitch" else 1.0):
            return "hitch"
        return ""


UPRIGHT: Final = Posture()
