"""Choices made by staying at a spot with the hand: what a patient who cannot use a mouse steers the game with."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Final

import numpy as np

from games.game import ChoiceView, GameView, Phase, Point, Wish, Workspace
from games.workspace import distance_m, hand_at, middle_pose, reachable

DWELL_S: Final = 1.5
LEAVING: Final = 2.0
"""Outside the spot the dwell is lost at twice the speed at which it was won: a choice must be meant."""
LARGEST_RADIUS_M: Final = 0.09
SHARE_OF_GAP: Final = 0.4
"""A spot takes this share of the way to the nearest other one, so that two are never chosen at once."""
CLEAR_OF_AIM_M: Final = 0.2
"""The pause is not offered where the game itself wants the hand to be,"""
CLEAR_OF_WAY_M: Final = 0.15
"""nor beside a way on which it wants the hand to go to and fro, or it would come and go all the time."""
NO_CHOICE_DRAWN: Final = 200
EYES_UP_M, EYES_BACK_M = 0.38, 0.16
"""Where the patient's picture is seen from, over and behind the shoulders' middle (docs/patient-screen.md)."""
SEEN_DOWN, SEEN_ASIDE = 1.3, 0.65
"""A spot is offered no steeper below the eyes and no further aside, per metre ahead of them: it must be in the picture,
and clear of the patient's own stop at its rim."""
SEED: Final = 0
"""The spots depend on the workspace alone."""


class Menu:
    """The spots of a workspace, and how long the hand has stayed at each that is offered.

    Args:
        workspace: where the hand can go; every spot is reached with all joints inside their ranges.
    """

    def __init__(self, workspace: Workspace) -> None:
        middle = hand_at(workspace, middle_pose(workspace))
        places = [reach.position for reach in reachable(workspace, NO_CHOICE_DRAWN, np.random.default_rng(SEED))]
        drawn = [place for place in places if _is_seen(place)] or places
        left, right = min(drawn, key=lambda place: place[0]), max(drawn, key=lambda place: place[0])
        low = min(drawn, key=lambda place: place[1])
        self._spots: Mapping[Wish, Point] = {
            Wish.START: middle,
            Wish.GO_ON: middle,
            Wish.QUIT: left,
            Wish.NEXT: right,
            Wish.PAUSE: low,
        }
        gap_m = min(distance_m(middle, left), distance_m(middle, right))
        self._radius_m = min(LARGEST_RADIUS_M, SHARE_OF_GAP * gap_m)
        self._progress: dict[Wish, float] = {}
        self._left: frozenset[Wish] = frozenset()
        """Spots that the hand has been away from since they are offered: who comes to one chooses it, not who lay there
        when the game paused, rested or ended.
        """

    def step(self, offered: tuple[Wish, ...], hand: Point, dt_s: float) -> Wish:
        """What is chosen with this step, `Wish.NONE` where nothing is."""
        self._left = frozenset(wish for wish in offered if wish in self._left or not self._is_at(wish, hand))
        self._progress = {wish: self._moved_on(wish, hand, dt_s) for wish in offered}
        chosen = next((wish for wish, progress in self._progress.items() if progress >= 1.0), Wish.NONE)
        if chosen is not Wish.NONE:
            self._progress = {}
        return chosen

    def views(self, offered: tuple[Wish, ...]) -> tuple[ChoiceView, ...]:
        """The spots to draw."""
        return tuple(
            ChoiceView(wish, self._spots[wish], self._radius_m, self._progress.get(wish, 0.0)) for wish in offered
        )

    def offered(self, view: GameView, *, has_next: bool) -> tuple[Wish, ...]:
        """What can be chosen while the game stands as `view` says."""
        match view.phase:
            case Phase.WAITING:
                return (Wish.START,)
            case Phase.PLAYING:
                return (Wish.PAUSE,) if self._is_clear(view) else ()
            case Phase.REST:
                return (Wish.GO_ON,)
            case Phase.PAUSED:
                return (Wish.GO_ON, Wish.QUIT, Wish.NEXT) if has_next else (Wish.GO_ON, Wish.QUIT)
            case Phase.BETWEEN:
                return (Wish.GO_ON, Wish.QUIT)
            case Phase.OVER:
                return ()

    def _moved_on(self, wish: Wish, hand: Point, dt_s: float) -> float:
        # A game that waits begins by itself in any case: whose hand is at its spot already need not leave it.
        chooses = self._is_at(wish, hand) and (wish in self._left or wish is Wish.START)
        change = dt_s / DWELL_S * (1.0 if chooses else -LEAVING)
        return min(max(self._progress.get(wish, 0.0) + change, 0.0), 1.0)

    def _is_at(self, wish: Wish, hand: Point) -> bool:
        return distance_m(hand, self._spots[wish]) <= self._radius_m

    def _is_clear(self, view: GameView) -> bool:
        spot = self._spots[Wish.PAUSE]
        if view.way:
            return all(distance_m(place, spot) > CLEAR_OF_WAY_M for place in view.way)
        return view.aim is None or distance_m(view.aim, spot) > CLEAR_OF_AIM_M


def _is_seen(place: Point) -> bool:
    """Whether the place is well inside the patient's picture."""
    x, y, z = place
    ahead_m, down_m = EYES_BACK_M - z, EYES_UP_M - y
    return down_m <= SEEN_DOWN * ahead_m and abs(x) <= SEEN_ASIDE * float(np.hypot(ahead_m, down_m))
