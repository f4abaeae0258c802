"""A task made of stays: the hand goes to one place after the other and stays at each, all in its time."""

from __future__ import annotations

from dataclasses import dataclass, replace
from itertools import pairwise
from typing import Final

import numpy as np

from games.even_steps import STEP_S
from games.game import Point
from games.workspace import distance_m

LEAVING: Final = 0.5
"""Away from the place the stay is lost at half the speed at which it was won."""


@dataclass(frozen=True, slots=True)
class Stay:
    """One place where the hand is to stay."""

    verb: str
    """What that does, in the game's own words."""
    place: Point
    radius_m: float
    stay_s: float


@dataclass(frozen=True, slots=True)
class Errand:
    """A task under way, and how it goes."""

    number: int
    name: str
    thing: int
    """Id of what is carried."""
    stays: tuple[Stay, ...]
    time_s: float
    hand: Point
    at: int = 0
    """Which stay it is."""
    stayed_s: float = 0.0
    age_s: float = 0.0
    inside: tuple[Point, ...] = ()
    """Where the hand was in the present place, once each `STEP_S`."""

    @property
    def stay(self) -> Stay:
        """What is to be done now."""
        return self.stays[self.at]

    @property
    def progress(self) -> float:
        """Of the present stay, 0..1."""
        return min(self.stayed_s / self.stay.stay_s, 1.0)

    @property
    def is_stayed(self) -> bool:
        """Whether the present stay is complete."""
        return self.stayed_s >= self.stay.stay_s - STEP_S / 2.0

    @property
    def is_last(self) -> bool:
        """Whether the task is done with the present stay."""
        return self.at + 1 == len(self.stays)

    @property
    def gone(self) -> float:
        """Share of the time that is gone, 0..1."""
        return min(self.age_s / self.time_s, 1.0)

    @property
    def off_m(self) -> float:
        """Mean distance of the hand from the present place while inside."""
        return float(np.mean([distance_m(hand, self.stay.place) for hand in self.inside]))

    def after(self, hand: Point) -> Errand:
        """The task `STEP_S` later with the hand at `hand`."""
        inside = distance_m(hand, self.stay.place) <= self.stay.radius_m
        stayed_s = max(self.stayed_s + STEP_S * (1.0 if inside else -LEAVING), 0.0)
        places = (*self.inside, hand) if inside else self.inside
        places = places if stayed_s > 0.0 else ()
        return replace(self, hand=hand, age_s=self.age_s + STEP_S, stayed_s=stayed_s, inside=places)

    def next(self) -> Errand:
        """The task at its next stay."""
        return replace(self, at=self.at + 1, stayed_s=0.0, inside=())


def time_for(hand: Point, stays: tuple[Stay, ...], pace_m_s: float, spare_s: float) -> float:
    """Seconds for all ways at a pace, with the stays and `spare_s` for each of them."""
    places = [hand, *(stay.place for stay in stays)]
    ways_m = sum(distance_m(a, b) for a, b in pairwise(places))
    return ways_m / pace_m_s + sum(stay.stay_s + spare_s for stay in stays)
