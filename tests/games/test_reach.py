"""Laws of the reaching game: replay, score, time, pause, reach of every target, difficulty."""

from __future__ import annotations

from dataclasses import replace
from itertools import pairwise

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from fusion.skeleton import Side
from games.difficulty import EASY_RADIUS_M, EASY_TIME_S
from games.game import GameInput, GameSettings, GameView, Point, Workspace
from games.reach import LARGEST_BONUS, POINTS_PER_HIT, ReachGame
from games.replay import GameRecord, replay

DT_S = 0.05
SHORT = GameSettings(rounds=2, round_s=12.0, rest_s=3.0)


def workspace(side: Side = Side.RIGHT) -> Workspace:
    outward = 1.0 if side is Side.RIGHT else -1.0
    return Workspace(
        side=side,
        shoulder=(0.18 * outward, 0.0, 0.0),
        upper_arm_m=0.28,
        forearm_m=0.33,
        plane_rad=(0.2, 1.8),
        elevation_rad=(0.2, 1.5),
        rotation_rad=(-0.8, 0.8),
        elbow_rad=(0.2, 2.0),
    )


def stepped(game: ReachGame, hand: Point, *, active: bool = True, dt_s: float = DT_S) -> GameView:
    return game.step(GameInput(dt_s, hand, active))


def towards_target(view: GameView, speed_m_s: float) -> Point:
    """A hand that goes straight to the target."""
    if not view.targets:
        return view.hand
    way = np.subtract(view.targets[0].position, view.hand)
    far = float(np.linalg.norm(way))
    x, y, z = (float(v) for v in np.add(view.hand, way * min(1.0, speed_m_s * DT_S / max(far, 1e-9))))
    return x, y, z


def played(game: ReachGame, seconds: float, speed_m_s: float = 0.6) -> list[GameView]:
    views = [game.view()]
    for _ in range(round(seconds / DT_S)):
        views.append(stepped(game, towards_target(views[-1], speed_m_s)))
    return views


FAR: Point = (9.0, 9.0, 9.0)
hands = st.tuples(*[st.floats(-0.6, 0.6)] * 3)
inputs = st.lists(st.builds(GameInput, st.floats(0, 0.2), hands, st.booleans()), max_size=60)


@given(seed=st.integers(0, 2**32), given_inputs=inputs)
def test_the_same_seed_and_inputs_give_the_same_game(seed: int, given_inputs: list[GameInput]) -> None:
    record = GameRecord("reach", workspace(), seed, SHORT)
    assert list(replay(record, given_inputs)) == list(replay(record, given_inputs))


def test_a_recorded_game_is_played_again_to_the_same_score() -> None:
    game = ReachGame(workspace(), 7, SHORT)
    views = played(game, 20.0)
    recorded = [GameInput(DT_S, view.hand, True) for view in views[1:]]
    again = list(replay(GameRecord("reach", workspace(), 7, SHORT), recorded))
    assert again == views[1:]
    assert again[-1].score > 0


def test_another_seed_gives_other_targets() -> None:
    first, second = (stepped(ReachGame(workspace(), seed, SHORT), FAR).targets[0].position for seed in (1, 2))
    assert first != second


@pytest.mark.parametrize("side", list(Side))
def test_a_hand_that_goes_to_the_targets_collects_them(side: Side) -> None:
    views = played(ReachGame(workspace(side), 3, SHORT), SHORT.round_s)
    assert views[-1].hits >= 5
    assert views[-1].misses == 0


@given(given_inputs=inputs, seed=st.integers(0, 99))
def test_the_score_never_falls_and_counts_follow_it(given_inputs: list[GameInput], seed: int) -> None:
    game = ReachGame(workspace(), seed, SHORT)
    before = game.view()
    for one in given_inputs:
        after = game.step(one)
        assert after.score >= before.score
        assert after.hits >= before.hits
        assert (after.score > before.score) == (after.hits > before.hits)
        assert ("hit" in after.feedback) == (after.hits > before.hits)
        before = after


def test_a_paused_game_changes_nothing_but_the_hand() -> None:
    game = ReachGame(workspace(), 3, SHORT)
    view = played(game, 3.2)[-1]
    for k in range(400):
        paused = stepped(game, (0.001 * k, 0.0, -0.3), active=False)
        assert replace(paused, hand=view.hand, feedback=view.feedback) == view


def test_a_game_waits_until_the_arm_is_driven() -> None:
    game = ReachGame(workspace(), 3, SHORT)
    assert stepped(game, FAR, active=False).phase == "waiting"
    assert game.view().targets == ()
    started = stepped(game, FAR)
    assert started.phase == "playing"
    assert started.feedback == ("round",)


@given(steps=st.lists(st.floats(0.001, 0.1), min_size=1, max_size=800))
def test_rounds_and_rests_take_the_time_they_should(steps: list[float]) -> None:
    game = ReachGame(workspace(), 3, GameSettings(rounds=3, round_s=2.0, rest_s=1.0))
    passed_s = 0.0
    for dt_s in steps:
        view = stepped(game, FAR, dt_s=dt_s)
        passed_s += dt_s
        expected = next((i for i, end in enumerate((2.0, 3.0, 5.0, 6.0, 8.0)) if passed_s < end - 1e-9), 5)
        assert (view.phase, view.round) == (
            ("playing", 1),
            ("rest", 1),
            ("playing", 2),
            ("rest", 2),
            ("playing", 3),
            ("over", 3),
        )[expected]


def test_a_game_that_is_over_stays_over() -> None:
    game = ReachGame(workspace(), 3, GameSettings(rounds=1, round_s=1.0))
    views = played(game, 3.0)
    assert views[-1].phase == "over"
    assert views[-1].time_left_s == 0.0
    assert [v.feedback for v in views].count(("over",)) == 1


def test_no_target_stands_while_the_patient_rests() -> None:
    views = played(ReachGame(workspace(), 3, SHORT), 14.5)
    assert views[-1].phase == "rest"
    assert views[-1].targets == ()


def test_a_target_nobody_reaches_is_taken_away_without_loss() -> None:
    game = ReachGame(workspace(), 3, GameSettings(round_s=60.0, start_level=0.0))
    views = [stepped(game, FAR) for _ in range(round((EASY_TIME_S + 0.2) / DT_S))]
    assert views[-1].misses == 1
    assert views[-1].score == 0
    assert views[-1].targets[0].id == views[0].targets[0].id + 1


def test_leaving_a_target_loses_the_dwell_slowly() -> None:
    game = ReachGame(workspace(), 3, GameSettings(pinned_level=1.0))
    target = stepped(game, FAR).targets[0]
    held = [stepped(game, target.position).targets[0].progress for _ in range(6)]
    left = stepped(game, FAR).targets[0].progress
    assert held == sorted(held)
    assert left == pytest.approx(held[-1] - 0.5 * (held[1] - held[0]))


def test_a_run_of_hits_is_worth_a_little_more_up_to_a_limit() -> None:
    views = played(ReachGame(workspace(), 3, GameSettings(round_s=300.0, pinned_level=0.2)), 60.0)
    gains = [b.score - a.score for a, b in pairwise(views) if b.hits > a.hits]
    assert gains[0] == POINTS_PER_HIT
    assert gains == sorted(gains)
    assert gains[-1] == POINTS_PER_HIT + LARGEST_BONUS


@pytest.mark.parametrize("bad", [(float("nan"), 0.0, 0.0), (float("inf"), 0.0, 0.0)])
def test_a_hand_that_is_not_known_stays_where_it_was(bad: Point) -> None:
    game = ReachGame(workspace(), 3, SHORT)
    before = stepped(game, (0.1, 0.0, -0.3))
    assert stepped(game, bad).hand == before.hand


def test_a_stalled_machine_costs_the_patient_nothing() -> None:
    game = ReachGame(workspace(), 3, SHORT)
    stepped(game, FAR)
    assert stepped(game, FAR, dt_s=30.0).misses == 0


def test_the_level_rests_where_three_of_four_targets_are_collected() -> None:
    # A patient whose chance to reach a target falls with the level from 100 % to 50 %: 75 % lies at level 0.5.
    rng = np.random.default_rng(5)
    game = ReachGame(workspace(), 11, GameSettings(rounds=1, round_s=1e6))
    view = stepped(game, FAR)
    able, shown = True, -1
    for _ in range(30_000):
        target = view.targets[0] if view.targets else None
        if target is not None and target.id != shown:
            shown, able = target.id, rng.random() < 1.0 - 0.5 * view.level
        view = stepped(game, target.position if target and able else FAR, dt_s=0.1)
    assert view.hits / (view.hits + view.misses) == pytest.approx(0.75, abs=0.04)


def test_a_pinned_level_stays() -> None:
    views = played(ReachGame(workspace(), 3, GameSettings(pinned_level=0.7)), 30.0)
    assert {view.level for view in views} == {0.7}
    assert views[1].targets[0].radius_m < EASY_RADIUS_M
