"""Every target is in reach of the exoskeleton and of the healthy arm in the mirror; targets spread."""

from __future__ import annotations

from itertools import pairwise

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from fusion.skeleton import Side
from games.game import Point, Workspace
from games.workspace import HIGHEST_M, IN_FRONT_M, LOWEST_M, NEAREST_STEP_M, distance_m, hand_at, next_reach

ranges = st.tuples(st.floats(-0.5, 0.8), st.floats(0.4, 1.2)).map(lambda r: (r[0], r[0] + r[1]))
positive = st.tuples(st.floats(0.1, 0.6), st.floats(0.4, 1.2)).map(lambda r: (r[0], r[0] + r[1]))
workspaces = st.builds(
    Workspace,
    side=st.sampled_from(list(Side)),
    shoulder=st.just((0.0, 0.0, 0.0)),
    upper_arm_m=st.floats(0.22, 0.36),
    forearm_m=st.floats(0.26, 0.40),
    plane_rad=ranges,
    elevation_rad=positive,
    rotation_rad=ranges,
    elbow_rad=positive,
)
usual = Workspace(Side.LEFT, (-0.18, 0.0, 0.0), 0.28, 0.33, (0.2, 1.8), (0.2, 1.5), (-0.8, 0.8), (0.2, 2.0))


def other_side(workspace: Workspace) -> Workspace:
    x, y, z = workspace.shoulder
    return Workspace(
        workspace.side.other,
        (-x, y, z),
        workspace.upper_arm_m,
        workspace.forearm_m,
        workspace.plane_rad,
        workspace.elevation_rad,
        workspace.rotation_rad,
        workspace.elbow_rad,
    )


@given(workspace=workspaces, level=st.floats(0, 1), seed=st.integers(0, 2**31))
def test_every_target_is_reached_by_both_arms_inside_their_joint_ranges(
    workspace: Workspace, level: float, seed: int
) -> None:
    reach = next_reach(workspace, level, (0.1, -0.2, -0.3), (), np.random.default_rng(seed))
    limits = (workspace.plane_rad, workspace.elevation_rad, workspace.rotation_rad, workspace.elbow_rad)
    for angle, (low, high) in zip(reach.pose_rad, limits, strict=True):
        assert low + 0.05 * (high - low) < angle < high - 0.05 * (high - low)
    x, y, z = reach.position
    assert hand_at(workspace, reach.pose_rad) == reach.position
    np.testing.assert_allclose(hand_at(other_side(workspace), reach.pose_rad), (-x, y, z), atol=1e-12)


def walk(workspace: Workspace, level: float, count: int) -> list[Point]:
    rng = np.random.default_rng(4)
    places: list[Point] = [(-0.2, -0.3, -0.3)]
    for _ in range(count):
        places.append(next_reach(workspace, level, places[-1], tuple(places[-4:]), rng).position)
    return places


def test_targets_stand_in_front_and_not_on_one_another() -> None:
    places = walk(usual, 0.3, 100)
    assert all(place[2] < -IN_FRONT_M + 0.01 for place in places[1:])
    assert min(distance_m(a, b) for a, b in pairwise(places)) > 0.8 * NEAREST_STEP_M


def test_targets_stand_neither_high_nor_low_and_ask_for_no_twisted_arm() -> None:
    wide = Workspace(Side.RIGHT, (0.18, 0.1, 0.0), 0.28, 0.33, (-0.5, 2.0), (0.0, 2.5), (-1.5, 1.5), (0.0, 2.4))
    rng = np.random.default_rng(4)
    reaches = [next_reach(wide, 0.5, (0.2, -0.2, -0.3), (), rng) for _ in range(100)]
    heights_m = [reach.position[1] - wide.shoulder[1] for reach in reaches]
    assert min(heights_m) > -LOWEST_M - 0.01
    assert max(heights_m) < HIGHEST_M + 0.01
    assert np.mean([abs(reach.pose_rad[2]) for reach in reaches]) < 0.6


def test_targets_spread_over_the_workspace() -> None:
    places = np.array(walk(usual, 0.5, 200))
    assert (np.ptp(places, axis=0) > 0.3).all()


def test_the_way_grows_with_the_level() -> None:
    ways = [
        np.mean([distance_m(a, b) for a, b in pairwise(p)])
        for p in (walk(usual, level, 60) for level in (0.0, 0.5, 1.0))
    ]
    assert ways == sorted(ways)
    assert ways[2] > 1.5 * ways[0]


@pytest.mark.parametrize("side", list(Side))
def test_a_workspace_of_one_pose_still_gives_a_target(side: Side) -> None:
    fixed = Workspace(side, (0, 0, 0), 0.28, 0.33, (0.9, 0.9), (0.9, 0.9), (0.0, 0.0), (1.0, 1.0))
    reach = next_reach(fixed, 0.5, (0, 0, 0), (), np.random.default_rng(0))
    assert np.isfinite(reach.position).all()
