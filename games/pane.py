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
SMALLEST_CELL_M, LARGEST_CELL_M = 0.025, 0.06
TILT_RAD: Final = 0.65
"""The upper edge leans away: the pane faces the eyes, and reaching up it the arm stretches ahead."""
DRAWN: Final = 240
"""Places drawn to see where the reachable space is."""
INNER: Final = (2.0, 98.0)
"""Percentiles between which the pane spans it."""


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
    drawn = np.array([reach.position for reach in reachable(workspace, DRAWN, rng)])
    places = _in_sight(workspace, drawn) @ _AXES.T  # (n, 3) as right, up, out
    low, high = np.percentile(places, INNER, axis=0)
    wished = np.array([(low[0] + high[0]) / 2.0, (low[1] + high[1]) / 2.0, float(np.median(places[:, 2]))])
    middle = places[int(np.argmin(np.linalg.norm(places - wished, axis=1)))]
    wanted_m = float(max((high[:2] - low[:2]) / (COLUMNS, ROWS)))
    # Rounded, so that both sides' cells are equal to the last digit.
    cell_m = round(min(max(wanted_m, SMALLEST_CELL_M), LARGEST_CELL_M), 4)
    centre = middle @ _AXES
    cells = centre + _steps(cell_m) * (OUTWARD[workspace.side], 1.0) @ _AXES[:2]
    x, y, z = centre.tolist()
    return Pane((x, y, z), cell_m, cells, _reachable(workspace, cells))


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
