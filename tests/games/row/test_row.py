"""Rules of rowing: strokes of two hands, how alike they must be, where they lead, and the boat they drive."""

from __future__ import annotations

from collections.abc import Callable
from itertools import pairwise

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from fusion.skeleton import Side
from games.even_steps import on_the_way
from games.game import GameInput, GameSettings, Phase, Point, ThingView, Wish, Workspace
from games.play import Play
from games.player import QUICK, WEAK, Player, play
from games.programme import Exercise, Programme
from games.row.boat import FASTEST_M_S, LARGEST_TURN_RAD, Boat
from games.row.course import LEAST_OUTWARD_M, LOWEST_M, NEAREST_M, longest_course
from games.row.rules import EVEN_POINTS, POINTS, RowRules
from games.row.stroke import EASY_TIME_S, HARD_RADIUS_M, demands
from games.rules import Ended, PlayInput
from games.workspace import distance_m

DT_S = 0.05
FAR: Point = (9.0, 9.0, 9.0)
levels = st.floats(0.0, 1.0)
seeds = st.integers(0, 2**31)
sides = st.sampled_from(list(Side))


@pytest.fixture
def rules(usual: Workspace) -> RowRules:
    return RowRules(usual, np.random.default_rng(3))


def thing(rules: RowRules, kind: str) -> ThingView:
    return next(one for one in rules.scene().things if one.kind == kind)


def mirrored(point: Point) -> Point:
    return (-point[0], point[1], point[2])


def rowed(
    rules: RowRules, healthy_of: Callable[[Point], Point | None], level: float = 0.2, speed_m_s: float = 0.3
) -> Ended:
    """The first stroke of a hand that goes straight to each end, and of a healthy hand that goes where it is told."""
    hand: Point = (0.2, -0.2, -0.3)
    for _ in range(400):
        aim = rules.scene().aim
        if aim is not None:
            hand = on_the_way(hand, aim, min(1.0, speed_m_s * DT_S / max(distance_m(hand, aim), 1e-9)))
        ended = rules.step(PlayInput(DT_S, hand, healthy_of(hand), level))
        if ended:
            return ended[0]
    pytest.fail("no stroke ended within 20 s")


def test_two_hands_that_go_alike_row_an_even_stroke(rules: RowRules) -> None:
    ended = rowed(rules, mirrored)
    assert (ended.success, ended.points, ended.feedback) == (True, POINTS + EVEN_POINTS, ("even",))
    assert ended.error_m == pytest.approx(0.0, abs=1e-9)


def test_a_hand_that_stays_behind_makes_the_stroke_uneven(rules: RowRules) -> None:
    ended = rowed(rules, lambda hand: (-hand[0], hand[1] - 0.4, hand[2]))
    assert (ended.success, ended.points, ended.feedback) == (False, 0, ("uneven",))
    assert ended.error_m == pytest.approx(0.4)


def test_without_a_healthy_hand_in_sight_the_shown_hand_alone_decides(rules: RowRules) -> None:
    ended = rowed(rules, lambda _: None)
    assert (ended.success, ended.points, ended.error_m, ended.feedback) == (True, POINTS, None, ())


def test_a_healthy_hand_seen_for_a_moment_is_not_judged(rules: RowRules) -> None:
    seen = iter([(9.0, 9.0, 9.0)] * 6)
    assert rowed(rules, lambda _: next(seen, None)).success


def test_a_stroke_nobody_rows_ends_in_its_time(rules: RowRules) -> None:
    ended, passed_s = list[Ended](), 0.0
    while not ended:
        ended += rules.step(PlayInput(DT_S, FAR, None, 0.0))
        passed_s += DT_S
    assert ended == [Ended(False, 0)]
    assert passed_s == pytest.approx(EASY_TIME_S, abs=2 * DT_S)


def test_pulling_without_reaching_ahead_first_is_no_stroke(rules: RowRules) -> None:
    rules.step(PlayInput(DT_S, FAR, None, 0.2))
    finish = thing(rules, "finish").position
    assert not any(rules.step(PlayInput(DT_S, finish, None, 0.2)) for _ in range(40))
    assert thing(rules, "catch").state == "now"
    assert rules.scene().aim == thing(rules, "catch").position


def test_at_the_catch_the_aim_changes_to_the_finish(rules: RowRules) -> None:
    rules.step(PlayInput(DT_S, FAR, None, 0.2))
    rules.step(PlayInput(DT_S, thing(rules, "catch").position, None, 0.2))
    rules.step(PlayInput(DT_S, thing(rules, "catch").position, None, 0.2))
    assert [thing(rules, kind).state for kind in ("catch", "finish")] == ["done", "now"]
    assert rules.scene().aim == thing(rules, "finish").position


@settings(max_examples=12)
@given(parts=st.lists(st.floats(0.005, 0.1), min_size=150, max_size=150), level=levels, lag_m=st.floats(0.0, 0.3))
def test_the_outcome_does_not_depend_on_the_frame_rate(
    parts: list[float], level: float, lag_m: float, usual: Workspace
) -> None:
    course = longest_course(usual, np.random.default_rng(3))

    def outcomes(times_s: list[float]) -> list[Ended]:
        rules, at_s, ended = RowRules(usual, np.random.default_rng(3)), 0.0, list[Ended]()
        for dt_s in times_s:
            at_s += dt_s
            hand = course.at(0.5 - 0.5 * np.cos(1.3 * at_s))
            ended += rules.step(PlayInput(dt_s, hand, (-hand[0], hand[1] + lag_m, hand[2]), level))
        return ended

    uneven = outcomes(parts)
    even = outcomes([0.01] * round(sum(parts) / 0.01))
    for one, other in zip(uneven, even, strict=False):
        assert (one.success, one.points) == (other.success, other.points)
        assert one.error_m == pytest.approx(other.error_m, abs=0.02)


@settings(max_examples=40)
@given(seed=seeds, side=sides, length=levels)
def test_every_stroke_leads_back_beside_the_body_and_above_the_lap(
    seed: int, side: Side, length: float, workspace_of: Callable[[Side], Workspace]
) -> None:
    course = longest_course(workspace_of(side), np.random.default_rng(seed))
    catch, finish = course.ends(length)
    outward = 1.0 if side is Side.RIGHT else -1.0
    assert catch[2] <= finish[2] + 1e-9
    for place in (catch, finish):
        assert place[0] * outward > LEAST_OUTWARD_M - 0.06
        assert -LOWEST_M - 0.06 < place[1] < 0.1
        assert place[2] < -NEAREST_M + 0.06


@settings(max_examples=40)
@given(seed=seeds, side=sides, share=levels)
def test_every_pose_of_a_stroke_is_inside_the_joint_ranges(
    seed: int, side: Side, share: float, workspace_of: Callable[[Side], Workspace]
) -> None:
    workspace = workspace_of(side)
    course = longest_course(workspace, np.random.default_rng(seed))
    ranges = (workspace.plane_rad, workspace.elevation_rad, workspace.rotation_rad, workspace.elbow_rad)
    for ahead, back, (low, high) in zip(course.ahead_rad, course.back_rad, ranges, strict=True):
        assert low < ahead + share * (back - ahead) < high


def test_a_workspace_of_one_pose_still_gives_strokes() -> None:
    fixed = Workspace(Side.LEFT, (0, 0, 0), 0.28, 0.33, (0.9, 0.9), (0.9, 0.9), (0.0, 0.0), (1.0, 1.0))
    rules = RowRules(fixed, np.random.default_rng(1))
    assert rowed(rules, mirrored).success


@given(low=levels, high=levels)
def test_every_demand_grows_with_the_level(low: float, high: float) -> None:
    low, high = sorted((low, high))
    easy, hard = demands(low), demands(high)
    assert easy.length <= hard.length
    assert easy.time_s >= hard.time_s
    assert easy.radius_m >= hard.radius_m
    assert easy.apart_m >= hard.apart_m


def test_a_level_changes_no_stroke_under_way(rules: RowRules) -> None:
    rules.step(PlayInput(DT_S, FAR, None, 0.0))
    before = thing(rules, "catch")
    rules.step(PlayInput(DT_S, FAR, None, 1.0))
    assert thing(rules, "catch").position == before.position
    rules.clear()
    rules.step(PlayInput(DT_S, FAR, None, 1.0))
    assert thing(rules, "catch").radius_m <= HARD_RADIUS_M


def test_ids_are_never_used_twice(rules: RowRules) -> None:
    seen: dict[int, str] = {}
    for _ in range(800):
        rules.step(PlayInput(DT_S, FAR, None, 1.0))
        for one in rules.scene().things:
            assert seen.setdefault(one.id, one.kind) == one.kind
    assert len(seen) > 10


def test_a_cleared_round_leaves_the_boat_lying_still_where_it_is(rules: RowRules) -> None:
    rowed(rules, mirrored)
    before = thing(rules, "boat")
    rules.clear()
    (boat,) = rules.scene().things
    assert rules.scene().trial == 0
    assert boat.position == before.position
    assert boat.progress == 0.0 < before.progress


@pytest.mark.parametrize("side", list(Side))
def test_the_boat_turns_away_from_the_hand_that_pulls_more(
    side: Side, workspace_of: Callable[[Side], Workspace]
) -> None:
    rules = RowRules(workspace_of(side), np.random.default_rng(3))
    ended = rowed(rules, lambda hand: (-hand[0], hand[1], hand[2] - 0.1), speed_m_s=0.15)
    assert ended.success
    boat = thing(rules, "boat")
    # The shown hand is further back: it has pulled more, so the other one hangs back.
    assert np.sign(boat.turn_rad) == (1.0 if side is Side.RIGHT else -1.0)
    assert boat.state == side.other.value


def test_even_hands_keep_the_boat_straight(rules: RowRules) -> None:
    rowed(rules, mirrored)
    assert thing(rules, "boat").turn_rad == pytest.approx(0.0, abs=1e-9)
    assert thing(rules, "boat").state == "even"


@given(pulls=st.lists(st.tuples(st.floats(0.0, 0.02), st.floats(-1.0, 1.0)), max_size=200))
def test_the_boat_only_ever_goes_ahead_and_never_too_fast(pulls: list[tuple[float, float]]) -> None:
    boats = [Boat()]
    for pulled_m, leftwards_m in pulls:
        boats.append(boats[-1].later(pulled_m, leftwards_m, 0.01))
    assert all(after.gone_m >= before.gone_m for before, after in pairwise(boats))
    assert all(0.0 <= boat.speed_m_s <= FASTEST_M_S for boat in boats)
    assert all(abs(boat.turn_rad) <= LARGEST_TURN_RAD for boat in boats)


def test_the_way_stays_between_two_strokes_so_that_what_it_keeps_clear_of_does_not_flicker(rules: RowRules) -> None:
    rowed(rules, mirrored)
    assert rules.scene().aim is None
    assert len(rules.scene().way) == 2


@pytest.mark.parametrize("side", list(Side))
def test_rowing_hands_never_choose_the_pause(side: Side, workspace_of: Callable[[Side], Workspace]) -> None:
    for seed in range(4):
        # A hand that stays for two seconds at each end, as a slow one does.
        game = Programme((Exercise("row", GameSettings(rounds=1, round_s=60.0)),), workspace_of(side), seed)
        view = game.step(GameInput(DT_S, FAR, active=True, wish=Wish.START))
        for k in range(400):
            hand = view.way[k // 40 % 2] if view.way else FAR
            view = game.step(GameInput(DT_S, hand, active=True, healthy_hand=mirrored(hand)))
        assert view.phase is Phase.PLAYING


def success(player: Player, level: float, workspace: Workspace) -> float:
    game = Play("row", RowRules, workspace, 3, GameSettings(rounds=1, round_s=120.0, start_level=level, pinned=True))
    play(game, player, 130.0)
    return float(np.mean([trial.success for trial in game.trials]))


def test_a_weak_hand_rows_nearly_all_strokes_at_the_lowest_level(usual: Workspace) -> None:
    assert success(Player(WEAK, 5), 0.0, usual) > 0.9


def test_a_quick_hand_misses_most_at_the_highest_level(usual: Workspace) -> None:
    assert success(Player(QUICK, 5), 1.0, usual) < 0.5
