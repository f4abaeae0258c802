"""Rules of tracing: the light goes with the hand, forwards and inside the tube; what a level asks."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from games.game import Point, ThingView, Workspace
from games.rules import Ended, PlayInput
from games.trace.polyline import Polyline, polyline
from games.trace.rules import (
    BREATH_S,
    EASY_PATIENCE_S,
    EASY_RADIUS_M,
    EASY_TIME_S,
    HARD_RADIUS_M,
    LARGEST_BONUS,
    POINTS,
    TraceRules,
    demands,
)

DT_S = 0.05
FAR: Point = (9.0, 9.0, 9.0)


@pytest.fixture
def rules(usual: Workspace) -> TraceRules:
    return TraceRules(usual, np.random.default_rng(3))


def stepped(rules: TraceRules, hand: Point = FAR, level: float = 0.2, dt_s: float = DT_S) -> tuple[Ended, ...]:
    return rules.step(PlayInput(dt_s, hand, None, level))


def light(rules: TraceRules) -> ThingView:
    return next(thing for thing in rules.scene().things if thing.kind == "light")


def end(rules: TraceRules) -> ThingView:
    return next(thing for thing in rules.scene().things if thing.kind == "end")


def way(rules: TraceRules) -> Polyline:
    return polyline(np.array(rules.scene().way))


def traced(rules: TraceRules, speed_m_s: float, beside_m: float = 0.0, dt_s: float = DT_S) -> list[Ended]:
    """A hand that goes along the path at a speed, so far above it, until the path is over."""
    line, along_m, ended = way(rules), 0.0, ()
    while not ended:
        x, y, z = line.at(along_m)
        ended = stepped(rules, (x, y + beside_m, z), dt_s=dt_s)
        along_m = min(along_m + speed_m_s * dt_s, line.length_m)
    return list(ended)


def test_a_hand_that_goes_along_the_path_carries_the_light_to_its_end(rules: TraceRules) -> None:
    stepped(rules)
    assert light(rules).state == "waiting"
    (ended,) = traced(rules, 0.2)
    assert ended.success
    assert ended.points == POINTS + LARGEST_BONUS
    assert ended.feedback == ("steady",)
    assert ended.error_m == pytest.approx(0.0, abs=1e-3)


def test_the_error_is_the_mean_distance_from_the_path(rules: TraceRules) -> None:
    stepped(rules)
    line = way(rules)
    places = [line.at(along_m) for along_m in np.linspace(0.0, line.length_m, 100)]
    away_m = [line.nearest((x, y + 0.03, z), 0.0, line.length_m)[1] for x, y, z in places]
    (ended,) = traced(rules, 0.2, beside_m=0.03)
    assert ended.success
    assert ended.error_m == pytest.approx(np.mean(away_m), abs=0.003)


def test_a_hand_beside_the_tube_leads_nothing(rules: TraceRules) -> None:
    stepped(rules)
    (ended,) = traced(rules, 0.2, beside_m=0.3)
    assert ended == Ended(success=False, points=0)


def test_the_light_waits_where_the_hand_left_it_and_goes_on_when_it_comes_back(rules: TraceRules) -> None:
    stepped(rules)
    line = way(rules)
    for along_m in np.arange(0.0, 0.12, 0.01):
        stepped(rules, line.at(along_m))
    assert light(rules).state == "led"
    where = light(rules).position
    stepped(rules, FAR)
    assert light(rules).state == "left"
    assert light(rules).position == pytest.approx(where)
    assert rules.scene().aim == pytest.approx(where)
    stepped(rules, where)
    assert light(rules).state == "led"


def test_a_light_that_was_left_for_long_brings_fewer_points_and_is_not_called_steady(rules: TraceRules) -> None:
    stepped(rules)
    stepped(rules, way(rules).at(0.0))
    for _ in range(round(3.0 / DT_S)):
        stepped(rules, FAR)
    (ended,) = traced(rules, 0.2)
    assert ended.success
    assert POINTS <= ended.points < POINTS + LARGEST_BONUS
    assert ended.feedback == ()


@settings(max_examples=30)
@given(hands=st.lists(st.tuples(*[st.floats(-0.6, 0.6)] * 3), max_size=40), seed=st.integers(0, 50))
def test_the_light_never_goes_back(hands: list[Point], seed: int, usual: Workspace) -> None:
    rules, before = TraceRules(usual, np.random.default_rng(seed)), (0, 0.0)
    for hand in hands:
        stepped(rules, hand)
        if rules.scene().trial:
            after = (rules.scene().trial, light(rules).progress)
            assert after >= before
            before = after


def test_a_path_cannot_be_cut_short_from_its_beginning_to_its_end(rules: TraceRules) -> None:
    stepped(rules, level=1.0)
    line = way(rules)
    stepped(rules, line.at(0.0))
    stepped(rules, line.at(line.length_m))
    assert light(rules).progress < 0.5


def test_a_path_nobody_takes_up_goes_away_without_points(rules: TraceRules) -> None:
    ended = [one for _ in range(round((EASY_PATIENCE_S + 0.1) / DT_S)) for one in stepped(rules, level=0.0)]
    assert ended == [Ended(success=False, points=0)]


def test_time_runs_only_once_the_light_is_taken_up(rules: TraceRules) -> None:
    stepped(rules, level=0.0)
    for _ in range(round(0.8 * EASY_PATIENCE_S / DT_S)):
        stepped(rules)
    assert end(rules).progress == 1.0
    start = way(rules).at(0.0)
    ended = [one for _ in range(round((EASY_TIME_S - 0.1) / DT_S)) for one in stepped(rules, start)]
    assert ended == []
    assert end(rules).progress < 0.02
    ended = [one for _ in range(4) for one in stepped(rules, start)]
    assert [(one.success, one.points) for one in ended] == [(False, 0)]


def test_after_a_path_there_is_a_breath_and_then_another_one(rules: TraceRules) -> None:
    stepped(rules)
    first = rules.scene()
    traced(rules, 0.3)
    assert rules.scene().things == ()
    assert rules.scene().trial == 0
    for _ in range(round(BREATH_S / DT_S) + 1):
        stepped(rules)
    assert rules.scene().trial == first.trial + 1
    assert not {thing.id for thing in rules.scene().things} & {thing.id for thing in first.things}


def test_a_cleared_round_shows_nothing(rules: TraceRules) -> None:
    stepped(rules)
    rules.clear()
    assert rules.scene().things == ()
    assert rules.scene().way == ()


def test_a_level_changes_no_path_that_lies_there(rules: TraceRules) -> None:
    stepped(rules, level=0.0)
    assert light(rules).radius_m == EASY_RADIUS_M
    stepped(rules, level=1.0)
    assert light(rules).radius_m == EASY_RADIUS_M
    rules.clear()
    for _ in range(round(BREATH_S / DT_S) + 1):
        stepped(rules, level=1.0)
    assert light(rules).radius_m == HARD_RADIUS_M


def test_each_level_asks_more_than_the_one_below() -> None:
    levels = [demands(level) for level in np.linspace(0, 1, 11)]
    assert [one.length_m for one in levels] == sorted(one.length_m for one in levels)
    assert [one.winding for one in levels] == sorted(one.winding for one in levels)
    assert [one.radius_m for one in levels] == sorted((one.radius_m for one in levels), reverse=True)
    assert [one.time_s for one in levels] == sorted((one.time_s for one in levels), reverse=True)


@pytest.mark.parametrize("level", [0.0, 0.5, 1.0])
@pytest.mark.parametrize("dt_s", [0.005, 0.033, 0.1])
def test_few_pictures_count_as_many(usual: Workspace, level: float, dt_s: float) -> None:
    rules = TraceRules(usual, np.random.default_rng(5))
    stepped(rules, level=level)
    usually, rarely = [], []
    for found, step_s in ((usually, 0.016), (rarely, dt_s)):
        rules = TraceRules(usual, np.random.default_rng(5))
        stepped(rules, level=level)
        found += traced(rules, 1.05 * way(rules).length_m / demands(level).time_s, beside_m=0.01, dt_s=step_s)
    assert rarely == [replace(one, error_m=pytest.approx(one.error_m, abs=2e-3)) for one in usually]
    assert usually[0].success
