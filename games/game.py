"""What every game is: pure rules stepped with the hand's position, and a picture of the result for the browser.

A game never reads a clock and never draws. The same seed, settings and inputs give the same score.
Positions are in the patient's trunk frame (metres; x right, y up, z from chest to back), so −z is ahead.
"""

from __future__ import annotations

from dataclasses import dataclass, field
from typing import Protocol

from fusion.skeleton import Side

Point = tuple[float, float, float]


@dataclass(frozen=True, slots=True)
class Workspace:
    """Where the shown hand can go: joint ranges that both the healthy arm (mirrored) and the exoskeleton reach."""

    side: Side
    """The affected side, whose arm is shown."""
    shoulder: Point
    upper_arm_m: float
    forearm_m: float
    """Elbow to the hand's centre."""
    plane_rad: tuple[float, float]
    elevation_rad: tuple[float, float]
    rotation_rad: tuple[float, float]
    elbow_rad: tuple[float, float]


@dataclass(frozen=True, slots=True)
class GameSettings:
    """What a therapist may choose before a game."""

    rounds: int = 6
    round_s: float = 60.0
    rest_s: float = 20.0
    start_level: float = 0.2
    """Difficulty 0..1 at the start; adapted towards 75 % success."""
    pinned_level: float | None = None
    """A difficulty that stays, where the therapist wants no adaptation."""


@dataclass(frozen=True, slots=True)
class GameInput:
    """What the rules see at one step."""

    dt_s: float
    hand: Point
    """The shown (affected) hand."""
    active: bool
    """False while the exoskeleton is not engaged: the game pauses."""


@dataclass(frozen=True, slots=True)
class TargetView:
    """One target to draw."""

    id: int
    position: Point
    radius_m: float
    progress: float
    """0..1 of the dwell that collects it."""


@dataclass(frozen=True, slots=True)
class GameView:
    """Everything a scene needs to draw one instant."""

    game: str
    phase: str
    """waiting, playing, rest, over."""
    score: int
    streak: int
    round: int
    rounds: int
    targets: tuple[TargetView, ...]
    hand: Point
    time_left_s: float
    """Left in this round, or in the rest."""
    hits: int
    misses: int
    level: float
    """Difficulty 0..1."""
    feedback: tuple[str, ...] = field(default=())
    """What just happened, as string keys: "hit", "missed", "streak", "rest", "round", "over"."""


class Game(Protocol):
    """A game in progress."""

    def step(self, given: GameInput) -> GameView:
        """Advance by `given.dt_s` and say what is to be drawn."""
        ...

    def view(self) -> GameView:
        """The picture as it stands."""
        ...
