"""The boat that two paddles drive: it glides on, slows down, and turns away from the hand that pulls more."""

from __future__ import annotations

from dataclasses import dataclass
from math import exp
from typing import Final

SPEED_PER_M: Final = 4.0
"""What a metre of pulling adds to the boat's speed, in 1/s."""
FASTEST_M_S: Final = 2.5
GLIDES_S: Final = 3.5
"""The water takes away speed with this time constant."""
TURN_RAD_PER_M: Final = 2.0
LARGEST_TURN_RAD: Final = 0.35
TURNS_S: Final = 0.7
"""The bow comes round with this time constant."""


@dataclass(frozen=True, slots=True)
class Boat:
    """Where the boat is and where it heads."""

    gone_m: float = 0.0
    speed_m_s: float = 0.0
    turn_rad: float = 0.0
    """To the left is positive."""

    def later(self, pulled_m: float, leftwards_m: float, dt_s: float) -> Boat:
        """The boat `dt_s` later.

        Args:
            pulled_m: how much further the hands have pulled.
            leftwards_m: how much further back the right hand is than the left while they pull.
            dt_s: at most some hundredths of a second.
        """
        speed = min(self.speed_m_s * exp(-dt_s / GLIDES_S) + SPEED_PER_M * pulled_m, FASTEST_M_S)
        wanted_rad = min(max(TURN_RAD_PER_M * leftwards_m, -LARGEST_TURN_RAD), LARGEST_TURN_RAD)
        turn_rad = wanted_rad + (self.turn_rad - wanted_rad) * exp(-dt_s / TURNS_S)
        return Boat(self.gone_m + speed * dt_s, speed, turn_rad)
