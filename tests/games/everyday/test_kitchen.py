"""The set table: everything in reach and apart, the mouth near the mouth, the tower upright."""

from __future__ import annotations

from collections.abc import Callable
from itertools import combinations, pairwise
from math import radians

import numpy as np
import pytest

from fusion.skeleton import Side
from games.everyday.kitchen import BLOCK_M, EASY_BLOCKS, HARD_BELOW_M, HARD_BLOCKS, LOWEST_M, MOUTH_M, Kitchen, kitchen
from games.game import Point, Workspace
from games.nearest import nearest_reach
from games.workspace import IN_FRONT_M, distance_m


def set_tables(workspace: Workspace, level: float = 0.5) -> list[Kitchen]:
    return [kitchen(workspace, level, np.random.default_rng(seed)) for seed in range(8)]


def standing(table: Kitchen) -> list[Point]:
    return [table.cup, table.jug, table.tower[0], *table.blocks]


@pytest.mark.parametrize("side", list(Side))
def test_every_place_of_the_hand_is_in_reach(workspace_of: Callable[[Side], Workspace], side: Side) -> None:
    workspace = workspace_of(side)
    for table in set_tables(workspace):
        for place in (*standing(table), *table.tower, table.mouth, table.over_cup):
            assert distance_m(nearest_reach(workspace, place).position, place) <= 0.01


def test_things_stand_apart_in_sight_and_below_the_shoulder(usual: Workspace) -> None:
    for table in set_tables(usual, 1.0):
        assert min(distance_m(a, b) for a, b in combinations(standing(table), 2)) > 0.08
        for _, y, z in standing(table):
            assert -LOWEST_M - 0.07 < y - usual.shoulder[1] < -HARD_BELOW_M + 0.07
            assert z - usual.shoulder[2] < -IN_FRONT_M + 0.05


@pytest.mark.parametrize(("elbow_deg", "off_m"), [(145, 0.0), (135, 0.04), (120, 0.10)])
def test_the_mouth_is_as_near_as_the_elbow_bends(elbow_deg: float, off_m: float) -> None:
    ranges = [(radians(low), radians(high)) for low, high in ((-20, 120), (0, 100), (-60, 80), (0, elbow_deg))]
    mouth = set_tables(Workspace(Side.RIGHT, (0.18, 0.0, 0.0), 0.28, 0.33, *ranges))[0].mouth
    assert distance_m(mouth, MOUTH_M) == pytest.approx(off_m, abs=0.005)


def test_a_tower_grows_by_a_block_where_the_arm_gets_that_high(usual: Workspace) -> None:
    for table in set_tables(usual):
        for lower, upper in pairwise(table.tower):
            assert distance_m(lower, upper) == pytest.approx(BLOCK_M, abs=0.02)


def test_a_higher_level_sets_more_blocks_further_apart(usual: Workspace) -> None:
    easy, hard = set_tables(usual, 0.0), set_tables(usual, 1.0)
    assert {len(table.blocks) for table in easy} == {EASY_BLOCKS}
    assert {len(table.blocks) for table in hard} == {HARD_BLOCKS}
    apart = [np.mean([distance_m(table.cup, table.jug) for table in tables]) for tables in (easy, hard)]
    assert apart[1] > 1.2 * apart[0]


def test_an_arm_that_cannot_move_still_gets_a_table() -> None:
    fixed = Workspace(Side.LEFT, (0, 0, 0), 0.28, 0.33, (0.9, 0.9), (0.9, 0.9), (0.0, 0.0), (1.0, 1.0))
    assert all(np.isfinite(place).all() for place in standing(set_tables(fixed)[0]))
