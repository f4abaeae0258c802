"""A flat pane laid through the reachable space, cut into square cells: what `wipe` has to wipe."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Final

import numpy as np
from numpy.typing import NDArray

from fusion.kinematics.angles import OUTWARD
from fusion.messages import Floats
from games.game import Point, Workspace
from games.nearest import reaches
from games.workspace import HIGHEST_M, IN_FRONT_M, LOWEST_M, reachable

COLUMNS, ROWS = 13, 9
"""Odd, so that a cell is in the middle."""
SMALLEST_CELL_M, LARGEST_CELL_M = 0.01, 0.06
TILT_RAD: Final = 0.65
"""The upper edge leans away: the pane faces the eyes, and reaching up it the arm stretches ahead."""
DRAWN, MORE = 240, 1200
"""Places drawn to see where the reachable space is, and to see which cells they are in."""
INNER: Final = (2.0, 98.0)
"""Percentiles between which the pane spans it."""
ON_M: Final = 0.03
"""A place this near the pane is on it ..."""
WITHIN: Final = 0.6
"""... and within a cell where it is so many of its sides from the middle: less than the smallest wiper's radius."""


@dataclass(frozen=True, slots=True)
class Pane:
    """The pane and its cells, row by row from the top, each row from its inner end: both sides are mirror images."""

    centre: Point
    cell_m: float
    """Side of a cell."""
    places: Floats
    """(ROWS * COLUMNS, 3) m, the cells' middles."""
    is_reachable: NDArray[np.bool_]
    """(ROWS * COLUMNS,)"""
    aims: Floats
    """(ROWS * COLUMNS, 3) m, where the hand is brought for each cell: its middle, or the nearest known place within."""

    def beyond_m(self, hand: Point) -> float:
        """How far the hand is behind the pane; negative = before it."""
        return float(-(np.asarray(hand) - self.centre) @ _AXES[2])

    def on(self, hand: Point) -> Point:
        """The point of the pane straight behind the hand."""
        x, y, z = (np.asarray(hand) + self.beyond_m(hand) * _AXES[2]).tolist()
        return x, y, z

    def from_centre_m(self) -> Floats:
        """(ROWS * COLUMNS,) of each cell's middle from the pane's."""
        return np.asarray(np.linalg.norm(self.places - np.asarray(self.centre), axis=1))


_AXES: Final = np.array(
    [[1.0, 0.0, 0.0], [0.0, np.cos(TILT_RAD), -np.sin(TILT_RAD)], [0.0, np.sin(TILT_RAD), np.cos(TILT_RAD)]]
)
"""Rightward, upward and out of the pane towards the eyes."""


def pane(workspace: Workspace, rng: np.random.Generator) -> Pane:
    """Lay the pane where most of the reachable space in sight is, its middle on a place that is in reach.

    Args:
        workspace: where the hand can go.
        rng: the game's own.
    """
    first = _drawn(workspace, DRAWN, rng)
    middle = _middle(first)
    known = np.concatenate([first, _drawn(workspace, MORE, rng)]) - middle
    on_it = known[np.abs(known[:, 2]) <= ON_M]
    cell_m = _cell_m(on_it)
    steps = _steps(cell_m) * (OUTWARD[workspace.side], 1.0)
    centre = middle @ _AXES
    cells = centre + steps @ _AXES[:2]
    exact = _reachable(workspace, cells)
    within, nearest = _known_within(steps, on_it, cell_m)
    aims = np.where(exact[:, np.newaxis], cells, centre + on_it[nearest] @ _AXES)
    x, y, z = centre.tolist()
    return Pane((x, y, z), cell_m, cells, exact | within, aims)


def _drawn(workspace: Workspace, count: int, rng: np.random.Generator) -> Floats:
    """(n, 3) m: rightward, upward and out of the pane, of so many reachable places those in sight."""
    drawn = np.array([reach.position for reach in reachable(workspace, count, rng)])
    return np.asarray(_in_sight(workspace, drawn) @ _AXES.T)


def _middle(places: Floats) -> Floats:
    """(3,) that of (n, 3) places which is nearest to the middle of them all."""
    low, high = np.percentile(places, INNER, axis=0)
    wished = np.array([(low[0] + high[0]) / 2.0, (low[1] + high[1]) / 2.0, float(np.median(places[:, 2]))])
    return np.asarray(places[int(np.argmin(np.linalg.norm(places - wished, axis=1)))])


def _cell_m(on_it: Floats) -> float:
    """So that the cells span these (n, 3) places on the pane."""
    low, high = np.percentile(on_it[:, :2], INNER, axis=0)
    wanted_m = float(max((high - low) / (COLUMNS, ROWS)))
    # Rounded, so that both sides' cells are equal to the last digit.
    return round(min(max(wanted_m, SMALLEST_CELL_M), LARGEST_CELL_M), 4)


def _known_within(steps: Floats, on_it: Floats, cell_m: float) -> tuple[NDArray[np.bool_], NDArray[np.intp]]:
    """(cells,) whether one of the (n, 3) known places lies within each, and which is nearest to its middle."""
    aside_m = np.linalg.norm(steps[:, np.newaxis] - on_it[:, :2], axis=2)
    return aside_m.min(axis=1) <= WITHIN * cell_m, aside_m.argmin(axis=1)


def _in_sight(workspace: Workspace, places: Floats) -> Floats:
    """Those of (n, 3) places that the eyes see well; all where there is none."""
    _, y, z = (places - np.asarray(workspace.shoulder)).T
    seen = places[(z < -IN_FRONT_M) & (y < HIGHEST_M) & (y > -LOWEST_M)]
    return seen if len(seen) else places


def _steps(cell_m: float) -> Floats:
    """(ROWS * COLUMNS, 2) m from the middle to each cell, outward and upward."""
    up, outward = np.meshgrid(ROWS // 2 - np.arange(ROWS), np.arange(COLUMNS) - COLUMNS // 2, indexing="ij")
    return np.asarray(np.stack([outward.ravel(), up.ravel()], axis=1) * cell_m)


def _reachable(workspace: Workspace, cells: Floats) -> NDArray[np.bool_]:
    """(n,) whether the hand gets to each cell in sight; to the middle one it does."""
    found = np.array([reaches(workspace, (x, y, z)) for x, y, z in cells.tolist()])
    found[len(cells) // 2] = True
    return found
