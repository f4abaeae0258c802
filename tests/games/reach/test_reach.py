"""Rules of reaching: targets that wait, the dwell that collects them, what a level asks."""

from __future__ import annotations

import numpy as np
import pytest

from games.game import Point, ThingView, Workspace
from games.reach.rules import EASY_RADIUS_M, EASY_TIME_S, HARD_RADIUS_M, POINTS, ReachRules
from games.rules import Ended, PlayInput

DT_S = 0.05
FAR: Point = (9.0, 9.0, 9.0)


@pytest.fixture
def rules(usual: Workspace) -> ReachRules:
    return ReachRules(usual, np.random.default_rng(3))


def stepped(rules: ReachRules, hand: Point = FAR, level: float = 0.2) -> tuple[Ended, ...]:
    return rules.step(PlayInput(DT_S, hand, None, level))


def target(rules: ReachRules) -> ThingView:
    (only,) = rules.scene().things
    return only


def test_a_hand_that_stays_collects_the_target(rules: ReachRules) -> None:
    stepped(rules)
    place = target(rules).position
    ended = [one for _ in range(30) for one in stepped(rules, place) if one.points]
    assert (ended[0].success, ended[0].points, ended[0].error_m) == (True, POINTS, 0.0)
    assert ended[0].hold_m == pytest.approx(0.0, abs=1e-12)


def test_the_error_and_the_stillness_are_those_of_the_hand_inside(rules: ReachRules) -> None:
    stepped(rules)
    x, y, z = target(rules).position
    ended: tuple[Ended, ...] = ()
    for k in range(60):
        ended = ended or stepped(rules, (x + (0.01 if k % 2 else -0.01), y, z))
    assert ended[0].error_m == pytest.approx(0.01)
    assert ended[0].hold_m == pytest.approx(0.01, rel=0.1)


def test_a_target_nobody_reaches_is_taken_away_without_points(rules: ReachRules) -> None:
    stepped(rules, level=0.0)
    first = target(rules).id
    ended = [one for _ in range(round((EASY_TIME_S + 0.1) / DT_S)) for one in stepped(rules, level=0.0)]
    assert ended == [Ended(success=False, points=0)]
    assert target(rules).id == first + 1


def test_leaving_a_target_loses_the_dwell_at_half_the_speed(rules: ReachRules) -> None:
    stepped(rules)
    place = target(rules).position
    held = []
    for _ in range(6):
        stepped(rules, place)
        held.append(target(rules).progress)
    stepped(rules)
    assert held == sorted(held)
    assert target(rules).progress == pytest.approx(held[-1] - 0.5 * (held[1] - held[0]))


def test_a_level_makes_targets_smaller_and_changes_none_that_waits(rules: ReachRules) -> None:
    stepped(rules, level=0.0)
    assert target(rules).radius_m == EASY_RADIUS_M
    stepped(rules, level=1.0)
    assert target(rules).radius_m == EASY_RADIUS_M
    rules.clear()
    stepped(rules, level=1.0)
    assert target(rules).radius_m == HARD_RADIUS_M


def test_a_cleared_round_shows_nothing(rules: ReachRules) -> None:
    stepped(rules)
    rules.clear()
    assert rules.scene().things == ()
    assert rules.scene().trial == 0
