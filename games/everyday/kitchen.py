"""What stands on the kitchen table of `everyday`, where, and where each thing has to be brought."""

from __future__ import annotations

from dataclasses import dataclass
from math import hypot
from typing import Final

import numpy as np

from fusion.kinematics.angles import OUTWARD
from games.game import Point, Workspace
from games.levels import between
from games.nearest import nearest_reach
from games.workspace import AWKWARD_M_PER_RAD, Reach, distance_m, reachable

EASY_BLOCKS, HARD_BLOCKS = 2, 4
BLOCK_M: Final = 0.07
"""Height of a block: the tower's next place is this much higher."""
EASY_APART_M, HARD_APART_M = 0.18, 0.38
"""From one thing to the next."""
CANDIDATES: Final = 144
EASY_BELOW_M, HARD_BELOW_M = 0.2, 0.1
"""Things stand at least this far below the shoulder, as on a table ..."""
LOWEST_M: Final = 0.36
"""... and no lower than this, where the eyes still see them."""
AHEAD_M: Final = 0.32
"""They stand at least this far ahead of the shoulder: nearer the sleeve hides them from the patient's eyes."""
EASY_ASIDE_M, HARD_ASIDE_M = 0.1, 0.25
"""And at most this far outward of it."""
CROWDED_M: Final = 0.16
"""Things nearer than this to one another, as the eyes see them, are avoided."""
SIGHT: Final = (0.8, -0.6)
"""Of a step up and a step back, what the eyes see as upward: they look down at the table."""
MOUTH_M: Final = (0.05, 0.06, -0.22)
"""The hand with a cup at the lips: outward from the midline; up and back from the shoulder."""
OVER_CUP_M: Final = (0.06, 0.12, 0.0)
"""The hand that pours, as (outward, up, back) from where it takes the cup."""


@dataclass(frozen=True, slots=True)
class Kitchen:
    """Places of the hand: where it takes a thing, or sets it down. All are in reach."""

    cup: Point
    jug: Point
    mouth: Point
    over_cup: Point
    blocks: tuple[Point, ...]
    tower: tuple[Point, ...]
    """One place per block, from the lowest."""


def kitchen(workspace: Workspace, level: float, rng: np.random.Generator) -> Kitchen:
    """Set the table: things drawn inside the reachable space, the further apart the higher the level.

    Args:
        workspace: where the hand can go.
        level: difficulty 0..1.
        rng: the game's own.
    """
    blocks = round(between(EASY_BLOCKS, HARD_BLOCKS, level))
    candidates = reachable(workspace, CANDIDATES, rng)
    places: list[Point] = []
    for _ in range(3 + blocks):
        places.append(_next(candidates, workspace, level, places))
    cup, jug, base = places[:3]
    side = OUTWARD[workspace.side]
    return Kitchen(
        cup=cup,
        jug=jug,
        mouth=_mouth(workspace),
        over_cup=_near(workspace, cup, (side * OVER_CUP_M[0], *OVER_CUP_M[1:])),
        blocks=tuple(places[3:]),
        tower=tuple(_near(workspace, base, (0.0, BLOCK_M * k, 0.0)) for k in range(blocks)),
    )


def _next(candidates: list[Reach], workspace: Workspace, level: float, places: list[Point]) -> Point:
    return min(candidates, key=lambda reach: _cost(reach, workspace, level, places)).position


def _cost(reach: Reach, workspace: Workspace, level: float, places: list[Point]) -> float:
    """How far a place is from what is wanted, in metres; hidden or crowded costs more than a wrong way."""
    wanted_m = between(EASY_APART_M, HARD_APART_M, level)
    way_m = abs(distance_m(reach.position, places[-1]) - wanted_m) if places else 0.0
    crowded_m = sum(max(CROWDED_M - _seen_apart_m(reach.position, place), 0.0) for place in places)
    hidden_m = _outside_m(reach.position, workspace, level)
    return way_m + 20.0 * hidden_m + 15.0 * crowded_m + AWKWARD_M_PER_RAD * abs(reach.pose_rad[2])


def _outside_m(place: Point, workspace: Workspace, level: float) -> float:
    """How far a place is nearer, further aside, higher or lower than things stand."""
    x, y, z = (p - s for p, s in zip(place, workspace.shoulder, strict=True))
    aside_m = OUTWARD[workspace.side] * x - between(EASY_ASIDE_M, HARD_ASIDE_M, level)
    above_m = y + between(EASY_BELOW_M, HARD_BELOW_M, level)
    return max(z + AHEAD_M, 0.0) + max(aside_m, 0.0) + max(above_m, 0.0) + max(-LOWEST_M - y, 0.0)


def _seen_apart_m(a: Point, b: Point) -> float:
    """How far apart two places look."""
    right, up, back = (p - q for p, q in zip(a, b, strict=True))
    return hypot(right, SIGHT[0] * up + SIGHT[1] * back)


def _mouth(workspace: Workspace) -> Point:
    outward, up, back = MOUTH_M
    _, y, z = workspace.shoulder
    return nearest_reach(workspace, (OUTWARD[workspace.side] * outward, y + up, z + back)).position


def _near(workspace: Workspace, place: Point, step: Point) -> Point:
    x, y, z = (a + b for a, b in zip(place, step, strict=True))
    return nearest_reach(workspace, (x, y, z)).position
