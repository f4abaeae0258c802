"""The pane: flat, in reach, facing the eyes, alike on both sides."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np
import pytest

from fusion.messages import Floats
from fusion.skeleton import Side
from games.game import Point, Workspace
from games.nearest import nearest_reach
from games.wipe.pane import COLUMNS, LARGEST_CELL_M, ON_M, ROWS, SMALLEST_CELL_M, pane
from games.workspace import distance_m


def farthest_from_reach_m(workspace: Workspace, places: Floats) -> float:
    """How far the arm ends from one of a few of the (n, 3) places."""
    few: list[Point] = [(x, y, z) for x, y, z in places[::7].tolist()]
    return max(distance_m(place, nearest_reach(workspace, place).position) for place in few)


@pytest.mark.parametrize("side", list(Side))
def test_most_of_it_is_in_reach_and_what_says_so_is(workspace_of: Callable[[Side], Workspace], side: Side) -> None:
    workspace = workspace_of(side)
    laid = pane(workspace, np.random.default_rng(1))
    assert laid.places.shape == (ROWS * COLUMNS, 3)
    assert laid.is_reachable.mean() > 0.6
    aimed = laid.aims[laid.is_reachable]
    assert farthest_from_reach_m(workspace, aimed) < 0.005
    assert np.linalg.norm(aimed - laid.places[laid.is_reachable], axis=1).max() < laid.cell_m


def test_the_cells_lie_in_one_plane_at_even_distances(usual: Workspace) -> None:
    laid = pane(usual, np.random.default_rng(1))
    assert SMALLEST_CELL_M <= laid.cell_m <= LARGEST_CELL_M
    assert [abs(laid.beyond_m(tuple(place))) for place in laid.places.tolist()] == pytest.approx(
        [0.0] * ROWS * COLUMNS, abs=1e-9
    )
    grid = laid.places.reshape(ROWS, COLUMNS, 3)
    assert np.linalg.norm(np.diff(grid, axis=0), axis=2) == pytest.approx(np.full((ROWS - 1, COLUMNS), laid.cell_m))
    assert np.linalg.norm(np.diff(grid, axis=1), axis=2) == pytest.approx(np.full((ROWS, COLUMNS - 1), laid.cell_m))
    assert tuple(grid[ROWS // 2, COLUMNS // 2]) == pytest.approx(laid.centre)


def test_its_upper_edge_leans_away_and_rows_run_from_the_top(usual: Workspace) -> None:
    grid = pane(usual, np.random.default_rng(1)).places.reshape(ROWS, COLUMNS, 3)
    assert grid[0, 0, 1] > grid[-1, 0, 1]
    assert grid[0, 0, 2] < grid[-1, 0, 2]
    assert grid[0, 0, 0] < grid[0, -1, 0]


def test_a_hand_is_beyond_it_by_its_distance(usual: Workspace) -> None:
    laid = pane(usual, np.random.default_rng(1))
    hand = (0.1, -0.1, -0.2)
    foot = laid.on(hand)
    assert laid.beyond_m(foot) == pytest.approx(0.0, abs=1e-12)
    assert np.linalg.norm(np.subtract(foot, hand)) == pytest.approx(abs(laid.beyond_m(hand)))
    assert laid.beyond_m((0.0, 0.0, 0.5)) < 0.0 < laid.beyond_m((0.0, 0.0, -2.0))


def test_both_sides_are_mirror_images(workspace_of: Callable[[Side], Workspace]) -> None:
    right, left = (pane(workspace_of(side), np.random.default_rng(4)) for side in (Side.RIGHT, Side.LEFT))
    assert left.centre == pytest.approx((-right.centre[0], *right.centre[1:]))
    np.testing.assert_allclose(left.places, right.places * (-1.0, 1.0, 1.0), atol=1e-12)
    assert (left.is_reachable == right.is_reachable).all()


@pytest.mark.parametrize("side", list(Side))
def test_an_arm_that_moves_little_has_a_pane_of_its_size(
    small_workspace_of: Callable[[Side], Workspace], side: Side
) -> None:
    workspace = small_workspace_of(side)
    laid = pane(workspace, np.random.default_rng(1))
    assert laid.is_reachable.sum() >= 40
    assert farthest_from_reach_m(workspace, laid.aims[laid.is_reachable]) < 0.005
    off_m = [abs(laid.beyond_m((x, y, z))) for x, y, z in laid.aims[laid.is_reachable].tolist()]
    assert max(off_m) <= ON_M


def test_an_arm_that_cannot_move_has_its_one_cell() -> None:
    fixed = Workspace(Side.LEFT, (0, 0, 0), 0.28, 0.33, (0.9, 0.9), (0.9, 0.9), (0.0, 0.0), (1.0, 1.0))
    laid = pane(fixed, np.random.default_rng(0))
    assert laid.is_reachable.sum() == 1
