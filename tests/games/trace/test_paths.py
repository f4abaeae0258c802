"""Every path can be followed by both arms inside their joint ranges, begins near the hand and is as long as asked."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from scipy.optimize import minimize

from fusion.skeleton import Side
from games.game import Workspace
from games.trace.paths import path
from games.workspace import HIGHEST_M, IN_FRONT_M, LOWEST_M, Pose, hand_at, middle_pose

USUAL = Workspace(Side.LEFT, (-0.18, 0.0, 0.0), 0.28, 0.33, (0.2, 1.8), (0.2, 1.5), (-0.8, 0.8), (0.2, 2.0))


def other_side(workspace: Workspace) -> Workspace:
    x, y, z = workspace.shoulder
    return replace(workspace, side=workspace.side.other, shoulder=(-x, y, z))


def ranges(workspace: Workspace) -> np.ndarray:
    return np.array([workspace.plane_rad, workspace.elevation_rad, workspace.rotation_rad, workspace.elbow_rad])


def farthest_from_reach_m(workspace: Workspace, places: np.ndarray) -> float:
    """The largest distance to a place that an arm inside its ranges leaves, each pose sought from the one before."""
    limits, worst = ranges(workspace), 0.0
    pose = np.asarray(middle_pose(workspace))
    for place in places:

        def away(angles: np.ndarray, place: np.ndarray = place) -> float:
            p, e, r, f = (float(angle) for angle in angles)
            return float(np.sum((np.asarray(hand_at(workspace, (p, e, r, f))) - place) ** 2))

        found = [minimize(away, start, bounds=limits) for start in (pose, np.asarray(middle_pose(workspace)))]
        best = min(found, key=lambda one: one.fun)
        pose, worst = best.x, max(worst, float(np.sqrt(best.fun)))
    return worst


@pytest.mark.parametrize("level", [0.0, 1.0])
@pytest.mark.parametrize("side", list(Side))
def test_every_place_on_a_path_is_reached_inside_the_ranges(side: Side, level: float) -> None:
    workspace = USUAL if side is USUAL.side else other_side(USUAL)
    rng = np.random.default_rng(2)
    hand = hand_at(workspace, middle_pose(workspace))
    line = path(workspace, 0.2 + 0.5 * level, 1.05 + level, 3 + round(2 * level), hand, rng)
    assert farthest_from_reach_m(workspace, line.points[::4]) < 0.004


@settings(max_examples=25)
@given(level=st.floats(0, 1), seed=st.integers(0, 2**31))
def test_a_path_begins_near_the_hand_and_stays_where_the_patient_sees_it(level: float, seed: int) -> None:
    rng = np.random.default_rng(seed)
    hand = hand_at(USUAL, middle_pose(USUAL))
    line = path(USUAL, 0.2 + 0.5 * level, 1.05 + level, 3 + round(2 * level), hand, rng)
    assert float(np.linalg.norm(line.points[0] - hand)) < 0.2
    assert line.points[:, 2].max() < -IN_FRONT_M + 0.05
    assert line.points[:, 1].max() < HIGHEST_M + 0.05
    assert line.points[:, 1].min() > -LOWEST_M - 0.05
    assert line.length_m > 0.6 * (0.2 + 0.5 * level)


def test_paths_are_as_long_and_as_winding_as_asked() -> None:
    rng = np.random.default_rng(3)
    hand = hand_at(USUAL, middle_pose(USUAL))
    for length_m, winding, corners in ((0.25, 1.1, 3), (0.45, 1.6, 4), (0.7, 2.1, 5)):
        lines = [path(USUAL, length_m, winding, corners, hand, rng) for _ in range(12)]
        assert np.mean([line.length_m for line in lines]) == pytest.approx(length_m, rel=0.1)
        assert np.median([line.winding for line in lines]) == pytest.approx(winding, rel=0.2)


@pytest.mark.parametrize("seed", range(4))
def test_the_other_side_gets_the_mirrored_path(seed: int) -> None:
    pose: Pose = middle_pose(USUAL)
    left, right = (
        path(space, 0.4, 1.4, 4, hand_at(space, pose), np.random.default_rng(seed)).points
        for space in (USUAL, other_side(USUAL))
    )
    np.testing.assert_allclose(left * (-1, 1, 1), right, atol=1e-9)


@pytest.mark.parametrize("side", list(Side))
def test_a_workspace_of_one_pose_still_gives_a_path(side: Side) -> None:
    fixed = Workspace(side, (0, 0, 0), 0.28, 0.33, (0.9, 0.9), (0.9, 0.9), (0.0, 0.0), (1.0, 1.0))
    line = path(fixed, 0.4, 1.4, 4, (0.1, 0.1, -0.3), np.random.default_rng(0))
    assert np.isfinite(line.points).all()
    assert np.isfinite(line.nearest((0.0, 0.0, 0.0), 0.0, line.length_m)).all()
