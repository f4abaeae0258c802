"""A virtual player: moves a hand towards what the game wants, as well as its ability lets it. For tests and studies."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Final

import numpy as np

from fusion.messages import Floats
from games.game import Game, GameInput, GameView, Point


@dataclass(frozen=True, slots=True)
class Ability:
    """How well a hand moves. The numbers are chosen to span what is seen in clinics; they are no patient's."""

    name: str
    speed_m_s: float
    """The hand's largest speed."""
    reaction_s: float
    tremor_m: float
    """Standard deviation of the hand's aim about what it wants, renewed with `TREMOR_S`."""
    lapse: float
    """Share of attempts that it does not notice for `LAPSE_S`."""


WEAK: Final = Ability("weak", speed_m_s=0.12, reaction_s=0.9, tremor_m=0.025, lapse=0.08)
MIDDLE: Final = Ability("middle", speed_m_s=0.28, reaction_s=0.55, tremor_m=0.014, lapse=0.05)
QUICK: Final = Ability("quick", speed_m_s=0.65, reaction_s=0.35, tremor_m=0.007, lapse=0.02)
ABILITIES: Final = (WEAK, MIDDLE, QUICK)

TREMOR_S: Final = 0.2
LAPSE_S: Final = 6.0
APPROACH_S: Final = 0.25
"""Near its aim the hand slows down: its speed is at most the way that is left over this."""
NEW_AIM_M: Final = 0.1
"""An aim that jumps by this much is another one and must be noticed first; one that glides is followed."""


class Player:
    """A hand in front of a game.

    Args:
        ability: how well it moves.
        seed: makes its tremor and lapses.
    """

    def __init__(self, ability: Ability, seed: int) -> None:
        self._ability = ability
        self._rng = np.random.default_rng(seed)
        self._hand: Floats | None = None
        self._aim: Floats | None = None
        self._unnoticed_s = 0.0
        self._tremor = np.zeros(3)
        self._tremor_s = 0.0

    def step(self, view: GameView, dt_s: float) -> Point:
        """Where the hand is `dt_s` after the picture `view`."""
        hand = np.asarray(view.hand if self._hand is None else self._hand, float)
        self._notice(view.aim)
        self._unnoticed_s = max(self._unnoticed_s - dt_s, 0.0)
        self._shake(dt_s)
        if self._aim is not None and self._unnoticed_s <= 0.0:
            hand = self._moved(hand, self._aim + self._tremor, dt_s)
        self._hand = hand
        x, y, z = (float(part) for part in hand)
        return x, y, z

    def _notice(self, aim: Point | None) -> None:
        """Take the aim; a new one takes its time."""
        if aim is None:
            return
        wanted = np.asarray(aim, float)
        if self._aim is None or float(np.linalg.norm(wanted - self._aim)) > NEW_AIM_M:
            lapses = self._rng.random() < self._ability.lapse
            self._unnoticed_s = self._ability.reaction_s + (LAPSE_S if lapses else 0.0)
        self._aim = wanted

    def _shake(self, dt_s: float) -> None:
        self._tremor_s -= dt_s
        if self._tremor_s <= 0.0:
            self._tremor = self._rng.normal(0.0, self._ability.tremor_m, 3)
            self._tremor_s += TREMOR_S

    def _moved(self, hand: Floats, towards: Floats, dt_s: float) -> Floats:
        way = towards - hand
        left_m = float(np.linalg.norm(way))
        step_m = min(self._ability.speed_m_s * dt_s, left_m * min(dt_s / APPROACH_S, 1.0))
        return hand if left_m == 0.0 else hand + way / left_m * step_m


def play(game: Game, player: Player, seconds: float, dt_s: float = 0.05) -> list[GameView]:
    """Every picture of a game that the player plays for so long, or until it is over."""
    views = [game.view()]
    for _ in range(round(seconds / dt_s)):
        hand = player.step(views[-1], dt_s)
        healthy = (-hand[0], hand[1], hand[2])
        views.append(game.step(GameInput(dt_s, hand, active=True, healthy_hand=healthy)))
    return views
