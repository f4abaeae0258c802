"""Even steps inside the uneven ones that rules are given, so that no outcome hangs on the frame rate."""

from __future__ import annotations

from dataclasses import dataclass
from math import floor
from typing import Final

from games.game import Point
from games.rules import PlayInput

STEP_S: Final = 0.01
_ROUNDING: Final = 1e-6
"""Share of a step: what adding up fractions of a second may be off by."""


@dataclass(frozen=True, slots=True)
class Moment:
    """Where the hands were at one even step."""

    hand: Point
    healthy_hand: Point | None
    """None = not seen."""


class EvenSteps:
    """Cuts time into steps of `STEP_S`; between two inputs the hands went straight, at an even speed."""

    def __init__(self) -> None:
        self._before: PlayInput | None = None
        self._over_s = 0.0

    def take(self, given: PlayInput) -> tuple[Moment, ...]:
        """The even steps that lie in the `given.dt_s` before this input."""
        before = self._before or given
        due_s = self._over_s + given.dt_s
        count = floor(due_s / STEP_S + _ROUNDING)
        shares = [((k + 1) * STEP_S - self._over_s) / given.dt_s for k in range(count)]
        self._before, self._over_s = given, due_s - count * STEP_S
        return tuple(_between(before, given, min(share, 1.0)) for share in shares)

    def forget(self) -> None:
        """Start anew: what the hands do until the next input is not looked at."""
        self._before, self._over_s = None, 0.0


def _between(before: PlayInput, after: PlayInput, share: float) -> Moment:
    healthy = after.healthy_hand
    if before.healthy_hand is not None and healthy is not None:
        healthy = on_the_way(before.healthy_hand, healthy, share)
    return Moment(on_the_way(before.hand, after.hand, share), healthy)


def on_the_way(start: Point, end: Point, share: float) -> Point:
    """The point at a share (0..1) of the straight way."""
    x, y, z = (a + share * (b - a) for a, b in zip(start, end, strict=True))
    return x, y, z
