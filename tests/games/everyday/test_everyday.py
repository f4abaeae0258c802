"""Everyday tasks: the order of steps, what goes with the hand, what is measured, what a level asks."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from fusion.skeleton import Side
from games.everyday.rules import BREATH_S, EASY_RADIUS_M, POINTS, EverydayRules
from games.game import GameSettings, Point, ThingView, Workspace
from games.play import Play
from games.player import QUICK, WEAK, Ability, Player, play
from games.rules import Ended, PlayInput

FAR: Point = (9.0, 9.0, 9.0)
DT_S = 0.05


@pytest.fixture
def rules(usual: Workspace) -> EverydayRules:
    return EverydayRules(usual, np.random.default_rng(3))


def stepped(
    rules: EverydayRules, hand: Point | None = FAR, level: float = 0.3, dt_s: float = DT_S
) -> tuple[Ended, ...]:
    """A step with the hand somewhere, or (None) where it is wanted."""
    return rules.step(PlayInput(dt_s, hand or rules.scene().aim or FAR, None, level))


def thing(rules: EverydayRules, kind: str) -> ThingView:
    return next(one for one in rules.scene().things if one.kind == kind)


def verbs(rules: EverydayRules, seconds: float, level: float = 0.3) -> list[str]:
    """The steps as they follow one another for a hand that is always where it is wanted."""
    seen: list[tuple[int, str]] = []
    for _ in range(round(seconds / DT_S)):
        stepped(rules, None, level)
        seen += [(one.id, one.state) for one in rules.scene().things if one.kind == "goal"]
    return [state for _, state in dict.fromkeys(seen)]


def test_a_table_is_filled_drunk_and_built_in_order(rules: EverydayRules) -> None:
    steps = verbs(rules, 16.0, level=0.0)
    assert steps[:6] == ["take", "pour", "put", "take", "drink", "put"]
    assert steps[6:10] == ["take", "stack", "take", "stack"]
    assert steps[10:12] == ["take", "pour"]


def test_every_task_that_is_done_says_what_it_was_and_earns_its_points(rules: EverydayRules) -> None:
    ended = [one for _ in range(300) for one in stepped(rules, None, 0.0)][:4]
    assert [one.feedback for one in ended] == [("poured",), ("drunk",), ("stacked",), ("stacked", "tower")]
    assert [one.points for one in ended] == [POINTS["pour"], POINTS["drink"], POINTS["stack"], POINTS["stack"]]
    assert all(one.success for one in ended)
    assert max(one.error_m or 0.0 for one in ended) < EASY_RADIUS_M
    assert max(one.hold_m or 9.0 for one in ended) < EASY_RADIUS_M


def test_a_thing_goes_with_the_hand_once_the_hand_has_stayed_at_it(rules: EverydayRules) -> None:
    while not rules.scene().trial:
        stepped(rules)
    assert (thing(rules, "jug").state, thing(rules, "cup").state) == ("wanted", "standing")
    while thing(rules, "goal").state == "take":
        stepped(rules, None)
    stepped(rules, (0.1, 0.2, -0.3))
    assert thing(rules, "jug").state == "held"
    assert thing(rules, "jug").position == pytest.approx((0.1, 0.2, -0.3))


def test_the_cup_fills_while_poured_and_empties_while_drunk(rules: EverydayRules) -> None:
    filled: dict[str, list[float]] = {"pour": [], "drink": []}
    for _ in range(200):
        stepped(rules, None)
        if rules.scene().trial and thing(rules, "goal").state in filled:
            filled[thing(rules, "goal").state].append(thing(rules, "cup").progress)
    pour, drink = filled["pour"], filled["drink"]
    assert pour == sorted(pour)
    assert drink == sorted(drink, reverse=True)
    assert max(pour) > 0.8
    assert min(drink) < 0.2


def test_blocks_lie_on_one_another_once_they_are_stacked(rules: EverydayRules) -> None:
    said: list[str] = []
    while "tower" not in said:
        said += [word for one in stepped(rules, None, 1.0) for word in one.feedback]
    stacked = [one for one in rules.scene().things if one.state == "stacked"]
    heights = sorted(one.position[1] for one in stacked)
    assert [one.kind for one in stacked][-1] == "roof"
    assert stacked[-1].position[1] == heights[-1]
    assert np.diff(heights) == pytest.approx(0.07, abs=0.02)


def test_time_that_is_over_ends_the_task_without_points_and_puts_the_thing_back(rules: EverydayRules) -> None:
    while not rules.scene().trial:
        stepped(rules)
    home = thing(rules, "jug").position
    while thing(rules, "goal").state == "take":
        stepped(rules, None)
    ended: tuple[Ended, ...] = ()
    while not ended:
        ended = stepped(rules, (0.1, 0.2, -0.3))
    assert ended == (Ended(success=False, points=0),)
    assert (thing(rules, "jug").position, thing(rules, "jug").state) == (home, "standing")


def test_a_round_that_ends_puts_the_thing_back_and_asks_again(rules: EverydayRules) -> None:
    while not rules.scene().trial or thing(rules, "goal").state == "take":
        stepped(rules, None)
    rules.clear()
    assert rules.scene().trial == 0
    assert thing(rules, "jug").state == "standing"
    for _ in range(round((BREATH_S + 0.2) / DT_S)):
        stepped(rules)
    assert thing(rules, "jug").state == "wanted"


def outcomes(workspace: Workspace, dt_s: float, ability: Ability = QUICK, seconds: float = 60.0) -> list[Ended]:
    """What becomes of the tasks for a hand that moves the same whatever the frame rate."""
    rules, hand = EverydayRules(workspace, np.random.default_rng(8)), np.array([0.2, -0.3, -0.3])
    ended: list[Ended] = []
    for _ in range(round(seconds / dt_s)):
        aim = rules.scene().aim
        if aim is not None:
            way = np.subtract(aim, hand)
            hand = hand + way * min(1.0, ability.speed_m_s * dt_s / max(float(np.linalg.norm(way)), 1e-9))
        x, y, z = hand.tolist()
        ended += rules.step(PlayInput(dt_s, (x, y, z), None, 0.4))
    return ended


def test_success_and_points_do_not_hang_on_the_frame_rate(usual: Workspace) -> None:
    fine, coarse = outcomes(usual, 0.005), outcomes(usual, 0.08)
    common = min(len(fine), len(coarse))
    assert abs(len(fine) - len(coarse)) <= 2
    assert [(one.success, one.points) for one in fine[:common]] == [
        (one.success, one.points) for one in coarse[:common]
    ]


def succeeded(workspace: Workspace, ability: Ability, level: float) -> float:
    game = Play("everyday", EverydayRules, workspace, 3, GameSettings(1, 150.0, start_level=level, pinned=True))
    play(game, Player(ability, 5), 160.0)
    return float(np.mean([trial.success for trial in game.trials]))


def test_the_easiest_is_for_the_weakest_and_the_hardest_is_hard_for_the_quickest(usual: Workspace) -> None:
    assert succeeded(usual, WEAK, 0.0) >= 0.9
    assert succeeded(usual, QUICK, 1.0) <= 0.5


@given(
    hands=st.lists(st.tuples(*[st.floats(-0.6, 0.6)] * 3), min_size=1, max_size=40),
    level=st.floats(0, 1),
    seed=st.integers(0, 99),
)
def test_what_is_drawn_is_always_whole(usual: Workspace, hands: list[Point], level: float, seed: int) -> None:
    rules = EverydayRules(usual, np.random.default_rng(seed))
    for hand in hands:
        stepped(rules, hand, level, 0.1)
        scene = rules.scene()
        assert len({one.id for one in scene.things}) == len(scene.things) <= 10
        assert all(0.0 <= one.progress <= 1.0 and np.isfinite(one.position).all() for one in scene.things)
        assert (scene.aim is None) == (scene.trial == 0)


def test_goals_are_never_numbered_alike(rules: EverydayRules) -> None:
    goals: dict[int, str] = {}
    for _ in range(600):
        stepped(rules, None)
        for one in rules.scene().things:
            assert goals.setdefault(one.id, one.kind) == one.kind


@pytest.mark.parametrize("side", list(Side))
def test_a_quick_hand_does_all_tasks_on_both_sides(workspace_of: Callable[[Side], Workspace], side: Side) -> None:
    rules = EverydayRules(workspace_of(side), np.random.default_rng(1))
    ended = [one for _ in range(600) for one in stepped(rules, None, 1.0)]
    assert len(ended) > 5
    assert all(one.success for one in ended)
