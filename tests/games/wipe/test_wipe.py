"""Wiping: what becomes clear and when, patches and pictures, what is measured, what a level asks."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from fusion.skeleton import Side
from games.game import GameSettings, Point, ThingView, Workspace
from games.play import Play
from games.player import QUICK, WEAK, Ability, Player, play
from games.rules import Ended, PlayInput
from games.wipe.rules import EASY_CELLS, HARD_CELLS, POINTS, WipeRules
from games.workspace import hand_at, middle_pose

FAR: Point = (9.0, 9.0, 9.0)
DT_S = 0.05


@pytest.fixture
def rules(usual: Workspace) -> WipeRules:
    return WipeRules(usual, np.random.default_rng(3))


def stepped(rules: WipeRules, hand: Point | None = FAR, level: float = 0.3, dt_s: float = DT_S) -> tuple[Ended, ...]:
    """A step with the hand somewhere, or (None) where it is wanted."""
    return rules.step(PlayInput(dt_s, hand or rules.scene().aim or FAR, None, level))


def begun(rules: WipeRules, level: float = 0.3) -> WipeRules:
    while not rules.scene().trial:
        stepped(rules, level=level)
    return rules


def things(rules: WipeRules, kind: str) -> list[ThingView]:
    return [one for one in rules.scene().things if one.kind == kind]


def clear(rules: WipeRules) -> float:
    return things(rules, "pane")[0].progress


def off(place: Point, metres: float) -> Point:
    """So far from the pane towards the eyes."""
    x, y, z = place
    return x, y + metres * float(np.sin(0.65)), z + metres * float(np.cos(0.65))


def test_a_hand_on_the_pane_clears_the_patch(rules: WipeRules) -> None:
    begun(rules, 0.0)
    ended = next(one for _ in range(200) for one in stepped(rules, None, 0.0))
    assert (ended.success, ended.points, ended.feedback) == (True, POINTS + EASY_CELLS, ("wiped",))
    assert ended.error_m == pytest.approx(0.0, abs=1e-9)


def test_a_hand_too_far_from_the_pane_clears_nothing_and_the_wiper_says_so(rules: WipeRules) -> None:
    aim = begun(rules).scene().aim
    assert aim is not None
    for metres, state in ((0.4, "off"), (-0.8, "off"), (0.05, "on"), (-0.05, "on")):
        before = clear(rules)
        stepped(rules, off(aim, metres), dt_s=0.005)  # no way between: only where it arrives counts
        rules._time.forget()
        for _ in range(4):
            stepped(rules, off(aim, metres))
        assert things(rules, "wiper")[0].state == state
        assert (clear(rules) > before) == (state == "on")


def test_the_distance_from_the_pane_is_measured(usual: Workspace) -> None:
    rules = begun(WipeRules(usual, np.random.default_rng(3)), 0.0)
    ended: tuple[Ended, ...] = ()
    while not ended:
        aim = rules.scene().aim
        assert aim is not None
        ended = stepped(rules, off(aim, 0.03), 0.0)
    assert ended[0].error_m == pytest.approx(0.03, abs=0.002)


def test_time_that_is_over_ends_the_patch_and_keeps_what_is_clear(rules: WipeRules) -> None:
    begun(rules)
    for _ in range(6):
        stepped(rules, None)
    wiped = clear(rules)
    ended: tuple[Ended, ...] = ()
    while not ended:
        ended = stepped(rules)
    assert (ended[0].success, ended[0].points) == (False, 0)
    assert clear(rules) == pytest.approx(wiped, abs=0.03)
    assert clear(begun(rules)) >= wiped


def test_clearness_never_falls_within_a_picture_and_the_whole_becomes_clear(rules: WipeRules) -> None:
    before, said = 0.0, []
    while "picture" not in said:
        said += [word for one in stepped(rules, None) for word in one.feedback]
        assert clear(rules) >= before
        before = clear(rules)
    assert before == 1.0
    assert set(things(rules, "pane")[0].state) == {"9", ".", "/"}


def test_every_picture_is_another_one_and_reaches_nearer_to_the_rim(rules: WipeRules) -> None:
    misted: dict[int, int] = {}
    for _ in range(4000):
        stepped(rules, None, 1.0)
        pane = things(rules, "pane")[0]
        misted.setdefault(pane.id, sum(sign.isdigit() for sign in pane.state))
        if len(misted) == 4:
            break
    counts = list(misted.values())
    assert counts[0] < counts[1] < counts[2] == counts[3]


def test_patches_begin_in_the_middle_and_go_outwards(rules: WipeRules) -> None:
    centre = things(rules, "pane")[0].position
    far: list[float] = []
    while clear(rules) < 0.95:
        begun(rules, 0.3)
        far.append(float(np.mean([np.linalg.norm(np.subtract(c.position, centre)) for c in things(rules, "cell")])))
        while rules.scene().trial:
            stepped(rules, None)
    assert far[0] < 0.1
    assert far[0] < min(far[1:])
    assert np.mean(far[1:3]) < np.mean(far[-2:])


@given(
    hands=st.lists(st.tuples(*[st.floats(-0.6, 0.6)] * 3), min_size=1, max_size=30),
    level=st.floats(0, 1),
    seed=st.integers(0, 3),
)
@settings(max_examples=30)
def test_what_is_drawn_is_always_whole(usual: Workspace, hands: list[Point], level: float, seed: int) -> None:
    rules = WipeRules(usual, np.random.default_rng(seed))
    kinds: dict[int, str] = {}
    for hand in hands:
        stepped(rules, hand, level, 0.1)
        scene = rules.scene()
        assert len({one.id for one in scene.things}) == len(scene.things) <= HARD_CELLS + 3
        assert all(0.0 <= one.progress <= 1.0 and np.isfinite(one.position).all() for one in scene.things)
        assert (scene.aim is None) == (scene.trial == 0)
        assert all(kinds.setdefault(one.id, one.kind) == one.kind for one in scene.things)


def test_a_round_that_ends_takes_the_patch_back(rules: WipeRules) -> None:
    begun(rules)
    rules.clear()
    assert rules.scene().trial == 0
    assert rules.scene().aim is None


def outcomes(workspace: Workspace, dt_s: float) -> list[Ended]:
    """What becomes of the patches for a hand that sweeps to and fro the same whatever the frame rate."""
    rules, ended = WipeRules(workspace, np.random.default_rng(8)), []
    centre = np.asarray(things(rules, "pane")[0].position)
    for k in range(round(60.0 / dt_s)):
        t_s = (k + 1) * dt_s
        aside = np.array([0.25 * np.sin(1.4 * t_s), 0.15 * np.sin(0.45 * t_s), -0.11 * np.sin(0.45 * t_s)])
        x, y, z = (centre + aside).tolist()
        ended += rules.step(PlayInput(dt_s, (x, y, z), None, 0.2))
    return ended


def test_success_and_points_do_not_hang_on_the_frame_rate(usual: Workspace) -> None:
    fine, coarse = outcomes(usual, 0.01), outcomes(usual, 0.05)
    assert len(fine) > 4
    assert [one.success for one in fine[:5]] == [one.success for one in coarse[:5]]
    assert [one.points for one in fine[:5]] == [one.points for one in coarse[:5]]


def succeeded(workspace: Workspace, ability: Ability, level: float) -> float:
    game = Play("wipe", WipeRules, workspace, 3, GameSettings(1, 150.0, start_level=level, pinned=True))
    play(game, Player(ability, 5), 160.0)
    return float(np.mean([trial.success for trial in game.trials]))


def test_the_easiest_is_for_the_weakest_and_the_hardest_is_hard_for_the_quickest(usual: Workspace) -> None:
    assert succeeded(usual, WEAK, 0.0) >= 0.9
    assert succeeded(usual, QUICK, 1.0) <= 0.5


@pytest.mark.parametrize("side", list(Side))
def test_a_hand_that_follows_clears_whole_pictures_on_both_sides(
    workspace_of: Callable[[Side], Workspace], side: Side
) -> None:
    rules = WipeRules(workspace_of(side), np.random.default_rng(1))
    said = [word for _ in range(1500) for one in stepped(rules, None, 0.3) for word in one.feedback]
    assert "picture" in said


@pytest.mark.parametrize("side", list(Side))
def test_where_an_arm_moves_little_a_hand_at_rest_wipes_nothing_and_a_weak_one_wins_at_the_easiest(
    small_workspace_of: Callable[[Side], Workspace], side: Side
) -> None:
    workspace = small_workspace_of(side)
    hand = hand_at(workspace, middle_pose(workspace))
    for level in (0.2, 0.5, 1.0):
        rules = WipeRules(workspace, np.random.default_rng(7))
        ended = [one for _ in range(600) for one in stepped(rules, hand, level)]
        assert ended
        assert not any(one.success for one in ended)
    assert succeeded(workspace, WEAK, 0.0) >= 0.9


def test_an_elbow_that_moves_alone_has_more_to_wipe_than_a_hand_at_rest_wipes() -> None:
    elbow = Workspace(Side.LEFT, (0, 0, 0), 0.28, 0.33, (1.0, 1.002), (0.7, 0.702), (0.0, 0.002), (0.0, 2.3))
    assert succeeded(elbow, WEAK, 0.0) >= 0.9
    hand = hand_at(elbow, middle_pose(elbow))
    rules = WipeRules(elbow, np.random.default_rng(7))
    ended = [one for level in (0.5, 1.0) for _ in range(600) for one in stepped(rules, hand, level)]
    assert ended
    assert not any(one.success for one in ended)


def test_an_arm_that_cannot_move_still_wipes_its_one_cell() -> None:
    fixed = Workspace(Side.LEFT, (0, 0, 0), 0.28, 0.33, (0.9, 0.9), (0.9, 0.9), (0.0, 0.0), (1.0, 1.0))
    rules = WipeRules(fixed, np.random.default_rng(0))
    said = [word for _ in range(200) for one in stepped(rules, None, 0.3) for word in one.feedback]
    assert said.count("picture") >= 2
