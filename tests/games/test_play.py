"""Laws of an exercise: time, pause, score, adaptation, early rests, posture, what is kept of attempts."""

from __future__ import annotations

from dataclasses import replace
from itertools import pairwise

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from games.catalogue import open_game
from games.game import GameInput, GameSettings, GameView, Phase, Point, Wish, Workspace
from games.play import BEGINS_AFTER_S, GRACE_S, LARGEST_BONUS, Play
from games.posture import EASED, LASTS_S, LEAN_M
from games.reach.rules import POINTS

DT_S = 0.05
FAR: Point = (9.0, 9.0, 9.0)
SHORT = GameSettings(rounds=2, round_s=12.0, rest_s=3.0)
hands = st.tuples(*[st.floats(-0.6, 0.6)] * 3)
inputs = st.lists(
    st.builds(GameInput, st.floats(0, 0.2), hands, st.booleans(), wish=st.sampled_from(list(Wish))), max_size=60
)


def stepped(game: Play, hand: Point = FAR, wish: Wish = Wish.NONE, *, active: bool = True) -> GameView:
    return game.step(GameInput(DT_S, hand, active, wish=wish))


def begun(workspace: Workspace, settings: GameSettings = SHORT) -> Play:
    game = open_game("reach", workspace, 3, settings)
    stepped(game, wish=Wish.START)
    return game


def played(game: Play, seconds: float) -> list[GameView]:
    """The pictures of a hand that is always where it is wanted."""
    views = [game.view()]
    for _ in range(round(seconds / DT_S)):
        views.append(stepped(game, views[-1].aim or views[-1].hand))
    return views


def test_a_game_begins_when_it_is_wished_or_after_a_moments_patience(usual: Workspace) -> None:
    assert stepped(open_game("reach", usual, 3, SHORT), wish=Wish.START).phase is Phase.PLAYING
    views = played(open_game("reach", usual, 3, SHORT), BEGINS_AFTER_S + 0.2)
    assert [view.phase for view in (views[1], views[-1])] == [Phase.WAITING, Phase.PLAYING]


@given(given_inputs=inputs)
def test_the_score_never_falls_and_counts_follow_it(usual: Workspace, given_inputs: list[GameInput]) -> None:
    game = begun(usual)
    before = game.view()
    for one in given_inputs:
        after = game.step(one)
        assert (after.score > before.score) == (after.hits > before.hits) == ("hit" in after.feedback)
        assert len(game.trials) == after.hits + after.misses
        assert 0.0 <= after.level <= 1.0
        before = after


def test_while_the_arm_is_not_driven_nothing_changes_but_the_hand(usual: Workspace) -> None:
    game = begun(usual)
    view = played(game, 3.2)[-1]
    for k in range(400):
        still = stepped(game, (0.001 * k, 0.0, -0.3), active=False)
        assert replace(still, hand=view.hand, feedback=view.feedback) == view


def test_a_paused_game_goes_on_where_it_was(usual: Workspace) -> None:
    game = begun(usual)
    before = played(game, 3.2)[-1]
    assert stepped(game, wish=Wish.PAUSE).phase is Phase.PAUSED
    paused = [stepped(game) for _ in range(100)]
    assert {view.time_left_s for view in paused} == {before.time_left_s}
    after = stepped(game, wish=Wish.GO_ON)
    assert after.phase is Phase.PLAYING
    assert after.things[0].id == before.things[0].id


def test_rounds_and_rests_follow_one_another_and_an_attempt_may_be_finished(usual: Workspace) -> None:
    game = begun(usual)
    views = [stepped(game) for _ in range(round(60.0 / DT_S))]
    phases = [view.phase for view in views]
    changes = [a for a, b in pairwise(phases) if a is not b]
    assert changes == [Phase.PLAYING, Phase.REST, Phase.PLAYING]
    assert phases[-1] is Phase.OVER
    playing_s = sum(phase is Phase.PLAYING for phase in phases) * DT_S
    assert 2 * SHORT.round_s <= playing_s + DT_S <= 2 * (SHORT.round_s + GRACE_S) + DT_S
    assert all(view.time_left_s >= 0.0 for view in views)


def test_a_rest_that_is_wished_comes_at_once_and_its_round_goes_on_after_it(usual: Workspace) -> None:
    game = begun(usual)
    left_s = played(game, 3.0)[-1].time_left_s
    resting = stepped(game, wish=Wish.REST)
    assert (resting.phase, resting.round, resting.things) == (Phase.REST, 1, ())
    again = stepped(game, wish=Wish.GO_ON)
    assert (again.phase, again.round) == (Phase.PLAYING, 1)
    assert again.time_left_s == pytest.approx(left_s - DT_S)


def test_a_rest_that_is_wished_when_the_last_rounds_time_is_over_ends_the_game(usual: Workspace) -> None:
    game = begun(usual, replace(SHORT, rounds=1))
    while game.view().time_left_s > 0.0:
        stepped(game)
    assert game.view().phase is Phase.PLAYING
    assert stepped(game, wish=Wish.REST).phase is Phase.OVER


def test_a_game_that_is_over_stays_over(usual: Workspace) -> None:
    game = begun(usual)
    assert stepped(game, wish=Wish.QUIT).feedback == ("over",)
    for wish in Wish:
        assert stepped(game, wish=wish).phase is Phase.OVER


def test_a_run_of_hits_is_worth_a_little_more_up_to_a_limit(usual: Workspace) -> None:
    views = played(begun(usual, GameSettings(round_s=300.0, pinned=True)), 60.0)
    gains = [b.score - a.score for a, b in pairwise(views) if b.hits > a.hits]
    assert gains[0] == POINTS
    assert gains == sorted(gains)
    assert gains[-1] == POINTS + LARGEST_BONUS


@pytest.mark.parametrize("bad", [(float("nan"), 0.0, 0.0), (float("inf"), 0.0, 0.0)])
def test_a_hand_that_is_not_known_stays_where_it_was(usual: Workspace, bad: Point) -> None:
    game = begun(usual)
    before = stepped(game, (0.1, 0.0, -0.3))
    assert stepped(game, bad).hand == before.hand


def test_a_stalled_machine_costs_the_patient_nothing(usual: Workspace) -> None:
    game = begun(usual)
    stepped(game)
    assert game.step(GameInput(30.0, FAR, active=True)).misses == 0


def test_the_level_rests_where_three_of_four_attempts_succeed(usual: Workspace) -> None:
    # A patient whose chance to reach a target falls with the level from 100 % to 50 %: 75 % lies at level 0.5.
    rng = np.random.default_rng(5)
    game = begun(usual, GameSettings(rounds=1, round_s=1e6))
    view, able, shown = stepped(game), True, -1
    for _ in range(30_000):
        target = view.things[0] if view.things else None
        if target is not None and target.id != shown:
            shown, able = target.id, rng.random() < 1.0 - 0.5 * view.level
        view = game.step(GameInput(0.1, target.position if target and able else FAR, active=True))
    assert view.hits / (view.hits + view.misses) == pytest.approx(0.75, abs=0.04)


def test_a_pinned_level_stays_until_it_is_set_free(usual: Workspace) -> None:
    game = begun(usual)
    game.step(GameInput(DT_S, FAR, active=False, wish=Wish.PIN, level=0.7))
    assert {view.level for view in played(game, 10.0)} == {0.7}
    stepped(game, wish=Wish.ADAPT)
    assert len({view.level for view in played(game, 20.0)}) > 1


def test_leaning_is_said_and_makes_what_comes_next_easier(usual: Workspace) -> None:
    game = begun(usual, GameSettings(round_s=60.0, start_level=0.5, pinned=True))
    upright = stepped(game)

    def leaning(hand: Point) -> GameView:
        return game.step(GameInput(DT_S, hand, active=True, trunk_lean_m=LEAN_M + 0.02))

    for _ in range(round(LASTS_S / DT_S) + 2):
        view = leaning(FAR)
    assert (upright.posture, view.posture) == ("", "lean")
    while not view.hits:
        view = leaning(upright.things[0].position)
    view = leaning(FAR)
    assert view.things[0].radius_m > upright.things[0].radius_m
    assert view.level == 0.5
    while view.hits < 2:
        view = leaning(view.things[0].position if view.things else FAR)
    assert [trial.level for trial in game.trials] == [0.5, pytest.approx(0.5 - EASED)]


def test_of_every_attempt_is_kept_when_the_hand_set_out_and_how_it_went(usual: Workspace) -> None:
    game = open_game("reach", usual, 3, SHORT)
    start = stepped(game, (0.2, -0.1, -0.3), Wish.START)
    for _ in range(9):
        stepped(game, start.hand)
    while not game.trials:
        stepped(game, start.things[0].position)
    (trial,) = game.trials
    assert trial.success
    assert trial.reaction_s == pytest.approx(10 * DT_S, abs=DT_S)
    assert trial.duration_s == pytest.approx(trial.reaction_s + (trial.movement_s or 0.0))
    assert trial.path_ratio == pytest.approx(1.0)
