"""Where the spots stand that a hand can choose."""

from __future__ import annotations

import numpy as np
import pytest

from fusion.skeleton import Side
from games.game import Wish, Workspace
from games.menu import Menu

HALF_PICTURE_HIGH_RAD, LOWEST_SIGHT_RAD, WIDE_TO_HIGH = np.radians(71) / 2, np.radians(67.5), 16 / 9
"""The patient's picture (web/src/play/stage.ts): height of view, how far down it looks, its shape."""
ALL = (Wish.START, Wish.PAUSE, Wish.NEXT, Wish.QUIT)
RANGES_DEG = {
    "wide": ((-20, 100), (20, 100), (-40, 40), (10, 120)),
    "cautious": ((10, 70), (30, 70), (-20, 20), (20, 90)),
    "small": ((30, 60), (35, 60), (-10, 10), (30, 70)),
}


def workspace(side: Side, name: str) -> Workspace:
    shoulder = (0.2 if side is Side.RIGHT else -0.2, 0.0, 0.0)
    return Workspace(side, shoulder, 0.3, 0.33, *(tuple(np.radians(ends)) for ends in RANGES_DEG[name]))


def in_picture(place: tuple[float, float, float], side: Side) -> np.ndarray:
    """Right and up from the picture's middle, −1..1 within it."""
    eyes = np.array([0.07 if side is Side.RIGHT else -0.07, 0.38, 0.16])
    pitch_rad = HALF_PICTURE_HIGH_RAD - LOWEST_SIGHT_RAD
    ahead = np.array([0.0, np.sin(pitch_rad), -np.cos(pitch_rad)])
    up = np.array([0.0, np.cos(pitch_rad), np.sin(pitch_rad)])
    way = np.subtract(place, eyes)
    half_high_m = float(way @ ahead) * np.tan(HALF_PICTURE_HIGH_RAD)
    return np.array([way[0] / (half_high_m * WIDE_TO_HIGH), (way @ up) / half_high_m])


@pytest.mark.parametrize("side", list(Side))
@pytest.mark.parametrize("name", RANGES_DEG)
def test_every_spot_is_inside_the_patients_picture(side: Side, name: str) -> None:
    for choice in Menu(workspace(side, name)).views(ALL):
        right, up = in_picture(choice.position, side)
        assert abs(right) < 0.85, choice.id
        assert -0.85 < up < 0.6, choice.id


@pytest.mark.parametrize("name", RANGES_DEG)
def test_no_two_spots_of_a_pause_can_be_chosen_at_once(name: str) -> None:
    spots = Menu(workspace(Side.LEFT, name)).views((Wish.GO_ON, Wish.NEXT, Wish.QUIT))
    for i, one in enumerate(spots):
        for other in spots[i + 1 :]:
            apart_m = float(np.linalg.norm(np.subtract(one.position, other.position)))
            assert apart_m > one.radius_m + other.radius_m
