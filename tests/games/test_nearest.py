"""The nearest reachable place: exact where the place is in reach, inside the ranges always, alike on both sides."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from fusion.skeleton import Side
from games.game import Point, Workspace
from games.nearest import HERE_M, nearest_reach, reaches
from games.workspace import MARGIN, distance_m, hand_at, reachable

places = st.tuples(st.floats(-0.7, 0.7), st.floats(-0.7, 0.7), st.floats(-0.7, 0.2))


def inside(workspace: Workspace, pose: tuple[float, ...]) -> bool:
    ranges = (workspace.plane_rad, workspace.elevation_rad, workspace.rotation_rad, workspace.elbow_rad)
    spare = [MARGIN * (high - low) - 1e-9 for low, high in ranges]
    return all(low + free <= a <= high - free for a, (low, high), free in zip(pose, ranges, spare, strict=True))


@given(wished=places)
@settings(max_examples=40)
def test_what_is_found_is_a_pose_inside_the_ranges(usual: Workspace, wished: Point) -> None:
    found = nearest_reach(usual, wished)
    assert inside(usual, found.pose_rad)
    assert hand_at(usual, found.pose_rad) == found.position


def test_a_place_in_reach_is_found_itself(usual: Workspace) -> None:
    drawn = [reach.position for reach in reachable(usual, 200, np.random.default_rng(1))]
    found = [place for place in drawn if reaches(usual, place)]
    assert len(found) > 0.97 * len(drawn)
    assert max(distance_m(nearest_reach(usual, place).position, place) for place in found) <= HERE_M


def test_nothing_drawn_is_nearer_to_a_place_out_of_reach(usual: Workspace) -> None:
    drawn = [reach.position for reach in reachable(usual, 1000, np.random.default_rng(2))]
    for wished in [(0.04, 0.1, -0.18), (0.0, -0.3, -0.2), (0.9, 0.2, -0.4), (0.2, 0.9, -0.1)]:
        nearest_m = distance_m(nearest_reach(usual, wished).position, wished)
        assert nearest_m < min(distance_m(place, wished) for place in drawn) + 0.02


@given(wished=places)
@settings(max_examples=25)
def test_both_sides_are_mirror_images(workspace_of: Callable[[Side], Workspace], wished: Point) -> None:
    x, y, z = wished
    right, left = nearest_reach(workspace_of(Side.RIGHT), wished), nearest_reach(workspace_of(Side.LEFT), (-x, y, z))
    assert (-left.position[0], *left.position[1:]) == pytest.approx(right.position, abs=1e-9)


def test_the_shoulder_itself_has_a_nearest_place_too(usual: Workspace) -> None:
    assert inside(usual, nearest_reach(usual, usual.shoulder).pose_rad)
