"""What one game brings of its own: its attempts. Rounds, rests, score, level and menus are `play`'s, for all alike."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Protocol

import numpy as np

from games.game import Point, ThingView, Workspace


@dataclass(frozen=True, slots=True)
class PlayInput:
    """What the rules see at one step of play."""

    dt_s: float
    hand: Point
    """The shown hand; always finite."""
    healthy_hand: Point | None
    """The healthy hand where it is, not mirrored; None = not seen."""
    level: float
    """Difficulty 0..1 for attempts that begin now; those under way keep theirs."""


@dataclass(frozen=True, slots=True)
class SceneView:
    """What the rules have to draw."""

    trial: int
    """Number of the attempt that waits or goes on, never used twice; 0 = none."""
    things: tuple[ThingView, ...]
    aim: Point | None
    """Where the hand is best brought now."""
    way: tuple[Point, ...] = ()


@dataclass(frozen=True, slots=True)
class Ended:
    """An attempt that has just ended."""

    success: bool
    points: int
    """Zero or more; a series of successes earns more on top."""
    error_m: float | None = None
    hold_m: float | None = None
    feedback: tuple[str, ...] = ()
    """The game's own words for what happened."""


class Rules(Protocol):
    """One game's rules, stepped only while a round is played."""

    def step(self, given: PlayInput) -> tuple[Ended, ...]:
        """Advance by `given.dt_s`; the attempts that ended with this step."""
        ...

    def scene(self) -> SceneView:
        """What is to be drawn now."""
        ...

    def clear(self) -> None:
        """The round is over: take away what waits. Nobody has missed it."""
        ...


class RulesFactory(Protocol):
    """Makes a game's rules at their beginning."""

    def __call__(self, workspace: Workspace, rng: np.random.Generator) -> Rules:
        """New rules; the same workspace, generator and inputs make the same game."""
        ...
