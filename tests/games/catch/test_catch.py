"""Rules of catching: butterflies that come down, hands that are there in time, what a level asks."""

from __future__ import annotations

from collections.abc import Callable
from itertools import pairwise

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from fusion.skeleton import Side
from games.catch.butterfly import EASY_FLIGHT_S, EASY_LINGER_S, EASY_RADIUS_M, HARD_NOTICE_S, HARD_RADIUS_M, demands
from games.catch.rules import IN_TIME_POINTS, POINTS, CatchRules
from games.game import GameSettings, Point, ThingView, Workspace
from games.play import Play
from games.player import QUICK, WEAK, Player, play
from games.rules import Ended, PlayInput
from games.workspace import distance_m

DT_S = 0.05
FAR: Point = (9.0, 9.0, 9.0)
HEAD: Point = (0.0, 0.3, 0.0)
levels = st.floats(0.0, 1.0)


@pytest.fixture
def rules(usual: Workspace) -> CatchRules:
    return CatchRules(usual, np.random.default_rng(3))


def stepped(rules: CatchRules, hand: Point = FAR, level: float = 0.2, dt_s: float = DT_S) -> tuple[Ended, ...]:
    return rules.step(PlayInput(dt_s, hand, None, level))


def thing(rules: CatchRules, kind: str) -> ThingView | None:
    return next((one for one in rules.scene().things if one.kind == kind), None)


def ended_with(rules: CatchRules, hand: Point | None, level: float = 0.2) -> Ended:
    """How a butterfly ends for a hand that stays away until the place is known and then is there, if `hand` is None."""
    for _ in range(400):
        aim = rules.scene().aim
        there = FAR if aim is None else aim
        ended = stepped(rules, hand or there, level)
        if ended:
            return ended[0]
    pytest.fail("no butterfly ended within 20 s")


def test_a_hand_that_waits_in_the_place_catches_the_butterfly_in_time(rules: CatchRules) -> None:
    ended = ended_with(rules, None)
    assert ended == Ended(True, POINTS + IN_TIME_POINTS, error_m=0.0, feedback=("in_time",))


def test_a_hand_that_comes_while_the_butterfly_hangs_there_catches_it_late(rules: CatchRules) -> None:
    for _ in range(400):
        place = thing(rules, "place")
        late = place is not None and place.state == "here"
        ended = stepped(rules, place.position if place is not None and late else FAR)
        if ended:
            break
    assert (ended[0].success, ended[0].points, ended[0].feedback) == (True, POINTS, ())
    assert ended[0].error_m is not None
    assert ended[0].error_m > EASY_RADIUS_M


def test_a_butterfly_nobody_catches_is_gone_without_points_and_tells_how_far_the_hand_was(rules: CatchRules) -> None:
    stepped(rules)
    butterfly = thing(rules, "butterfly")
    assert butterfly is not None
    ended = ended_with(rules, FAR)
    assert (ended.success, ended.points) == (False, 0)
    assert ended.error_m == pytest.approx(distance_m(FAR, (0.0, 0.0, 0.0)), abs=1.0)


def test_touching_the_place_and_leaving_before_the_arrival_catches_nothing(rules: CatchRules) -> None:
    for _ in range(400):
        place = thing(rules, "place")
        ended = stepped(rules, place.position if place is not None and place.progress < 0.8 else FAR)
        if ended:
            break
    assert not ended[0].success


@given(level=levels, seed=st.integers(0, 2**31), side=st.sampled_from(list(Side)))
def test_a_butterfly_sinks_smoothly_into_its_place_and_never_flies_at_the_face(
    level: float, seed: int, side: Side, workspace_of: Callable[[Side], Workspace]
) -> None:
    rules = CatchRules(workspace_of(side), np.random.default_rng(seed))
    views: list[ThingView] = []
    while not views or views[-1].state != "here":
        stepped(rules, level=level)
        butterfly = thing(rules, "butterfly")
        if butterfly is not None:
            views.append(butterfly)
    ways = [np.subtract(b.position, a.position) for a, b in pairwise(views)]
    longest_m = max(float(np.linalg.norm(way)) for way in ways)
    assert longest_m < 2.0 * DT_S
    assert min(distance_m(view.position, HEAD) for view in views) > 0.25
    # At its end it comes straight down: no share of its way leads towards the patient.
    assert ways[-1][2] < 0.2 * abs(ways[-1][1]) + 1e-9
    assert rules.scene().aim == pytest.approx(views[-1].position)


@settings(max_examples=30)
@given(
    steps_s=st.lists(st.floats(0.005, 0.1), min_size=60, max_size=60), reaches_at_s=st.floats(0.0, 8.0), level=levels
)
def test_the_outcome_does_not_depend_on_the_frame_rate(
    steps_s: list[float], reaches_at_s: float, level: float, usual: Workspace
) -> None:
    def outcomes(parts: int) -> list[Ended]:
        rules, at_s, ended = CatchRules(usual, np.random.default_rng(5)), 0.0, list[Ended]()
        place = (0.3, -0.1, -0.4)
        for dt_s in [0.01, *steps_s, *[0.1] * 60]:
            for _ in range(parts):
                at_s += dt_s / parts
                far_m = max(reaches_at_s - at_s, 0.0)
                ended += stepped(rules, (place[0] + far_m, place[1], place[2]), level, dt_s / parts)
        return ended

    once, often = outcomes(1), outcomes(3)
    # The hand turns a corner when it is there; within that one step the course differs a little.
    assert [one.points for one in once] == [one.points for one in often]
    for one, other in zip(once, often, strict=True):
        assert one.error_m == pytest.approx(other.error_m, abs=0.11)


def test_a_place_is_announced_later_at_a_higher_level(rules: CatchRules) -> None:
    asked = demands(1.0)
    age_s, announced_s = 0.0, None
    while announced_s is None:
        stepped(rules, level=1.0, dt_s=0.01)
        age_s += 0.01
        announced_s = age_s if rules.scene().aim is not None else None
    assert announced_s == pytest.approx(asked.flight_s - HARD_NOTICE_S, abs=0.05)


def test_a_level_changes_no_butterfly_that_flies(rules: CatchRules) -> None:
    stepped(rules, level=0.0)
    stepped(rules, level=1.0)
    flying = thing(rules, "butterfly")
    assert flying is not None
    assert flying.radius_m == EASY_RADIUS_M
    rules.clear()
    stepped(rules, level=1.0)
    other = thing(rules, "butterfly")
    assert other is not None
    assert other.radius_m == HARD_RADIUS_M


@given(low=levels, high=levels)
def test_every_demand_grows_with_the_level(low: float, high: float) -> None:
    low, high = sorted((low, high))
    easy, hard = demands(low), demands(high)
    assert easy.flight_s >= hard.flight_s
    assert easy.notice_s >= hard.notice_s
    assert easy.linger_s >= hard.linger_s
    assert easy.radius_m >= hard.radius_m
    assert hard.notice_s <= hard.flight_s


def test_ids_are_never_used_twice(rules: CatchRules) -> None:
    seen: dict[int, str] = {}
    for _ in range(1200):
        stepped(rules, level=1.0)
        for one in rules.scene().things:
            assert seen.setdefault(one.id, one.kind) == one.kind
    assert len(seen) > 10


def test_a_cleared_round_shows_nothing_and_the_next_butterfly_comes(rules: CatchRules) -> None:
    stepped(rules)
    rules.clear()
    assert rules.scene().things == ()
    assert rules.scene().trial == 0
    stepped(rules)
    assert thing(rules, "butterfly") is not None


def success(player: Player, level: float, workspace: Workspace) -> float:
    game = Play(
        "catch", CatchRules, workspace, 3, GameSettings(rounds=1, round_s=120.0, start_level=level, pinned=True)
    )
    play(game, player, 130.0)
    return float(np.mean([trial.success for trial in game.trials]))


def test_a_weak_hand_catches_nearly_all_at_the_lowest_level(usual: Workspace) -> None:
    assert success(Player(WEAK, 5), 0.0, usual) > 0.9


def test_a_quick_hand_misses_most_at_the_highest_level(usual: Workspace) -> None:
    assert success(Player(QUICK, 5), 1.0, usual) < 0.5


def test_the_easiest_butterfly_leaves_time() -> None:
    asked = demands(0.0)
    assert (asked.flight_s, asked.notice_s, asked.linger_s) == (EASY_FLIGHT_S, EASY_FLIGHT_S, EASY_LINGER_S)
