"""How a person moves an arm: sub-movements of least jerk, added to one another when the mind changes on the way.

[Flash & Hogan 1985] J. Neuroscience 5(7): s(τ) = 10τ³ − 15τ⁴ + 6τ⁵; the speed is a bell, at rest at both ends.
[Flash & Henis 1991] J. Cognitive Neuroscience 3(3): a new goal adds the movement from the old goal to the new one.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Final

import numpy as np

from fusion.messages import Floats

PEAK_OVER_MEAN: Final = 1.875
"""Peak speed of a movement of least jerk over its mean speed."""
_SHORTEST_S: Final = 0.5
_S_PER_RAD: Final = 0.9


def least_jerk(share: float) -> float:
    """Way covered, 0 to 1, at a share of the duration."""
    tau = min(max(share, 0.0), 1.0)
    return tau**3 * (10.0 - 15.0 * tau + 6.0 * tau**2)


def duration_s(way_rad: Floats, ability: float) -> float:
    """How long a movement takes: longer for a longer way, and the longer the lower the ability (0..1]."""
    return (_SHORTEST_S + _S_PER_RAD * float(np.abs(way_rad).max())) / ability


@dataclass(frozen=True, slots=True)
class SubMovement:
    """One movement of least jerk."""

    start_s: float
    duration_s: float
    way_rad: Floats  # (4,)

    def covered(self, t_s: float) -> Floats:
        """(4,) rad covered by now."""
        return self.way_rad * least_jerk((t_s - self.start_s) / self.duration_s)

    def is_over(self, t_s: float) -> bool:
        """Whether it has ended."""
        return t_s >= self.start_s + self.duration_s


@dataclass(frozen=True, slots=True)
class Movement:
    """An arm's movement: where it stood, and the sub-movements since."""

    base_rad: Floats  # (4,)
    parts: tuple[SubMovement, ...] = ()

    def pose_rad(self, t_s: float) -> Floats:  # (4,)
        """Where the arm is."""
        return self.base_rad + sum((part.covered(t_s) for part in self.parts), np.zeros(4))

    def end_rad(self) -> Floats:  # (4,)
        """Where it will come to rest."""
        return self.base_rad + sum((part.way_rad for part in self.parts), np.zeros(4))

    def towards(self, goal_rad: Floats, t_s: float, ability: float) -> Movement:
        """The movement with another goal; smooth, whatever it was doing."""
        going_on = tuple(part for part in self.parts if not part.is_over(t_s))
        over = [part.way_rad for part in self.parts if part.is_over(t_s)]
        way = goal_rad - self.end_rad()
        new = SubMovement(t_s, duration_s(way, ability), way)
        return Movement(self.base_rad + sum(over, np.zeros(4)), (*going_on, new))

    def is_over(self, t_s: float) -> bool:
        """Whether the arm has come to rest."""
        return all(part.is_over(t_s) for part in self.parts)
