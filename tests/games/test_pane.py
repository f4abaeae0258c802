"""The pane: flat, in reach, facing the eyes, alike on both sides."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np
import pytest

from fusion.skeleton import Side
from games.game import Workspace
from games.nearest import reaches
from games.pane import COLUMNS, LARGEST_CELL_M, ROWS, SMALLEST_CELL_M, pane


@pytest.mark.parametrize("side", list(Side))
def test_most_of_it_is_in_reach_and_what_says_so_is(workspace_of: Callable[[Side], Workspace], side: Side) -> None:
    workspace = workspace_of(side)
    laid = pane(workspace, np.random.default_rng(1))
    assert laid.places.shape == (ROWS * COLUMNS, 3)
    assert laid.is_reachable.mean() > 0.6
    for place in laid.places[laid.is_reachable][::7].tolist():
        x, y, z = place
        assert reaches(workspace, (x, y, z))


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


def test_an_arm_that_cannot_move_has_its_one_cell() -> None:
    fixed = Workspace(Side.LEFT, (0, 0, 0), 0.28, 0.33, (0.9, 0.9), (0.9, 0.9), (0.0, 0.0), (1.0, 1.0))
    laid = pane(fixed, np.random.default_rng(0))
    assert laid.is_reachable.sum() == 1
