"""A session's exercises: in turn, by gesture or wish, and replayed to the same score."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace

import pytest
from hypothesis import given
from hypothesis import strategies as st

from fusion.errors import InputError
from fusion.skeleton import Side
from games.game import GameInput, GameSettings, GameView, Phase, Point, Wish, Workspace
from games.menu import DWELL_S
from games.player import MIDDLE, Player, play
from games.programme import BETWEEN_S, Exercise, Programme
from games.replay import GameRecord, played, replay
from games.workspace import distance_m

DT_S = 0.05
SHORT = GameSettings(rounds=1, round_s=8.0, rest_s=2.0)
TWO = (Exercise("reach", SHORT), Exercise("reach", SHORT))
hands = st.tuples(*[st.floats(-0.6, 0.6)] * 3)
inputs = st.lists(
    st.builds(GameInput, st.floats(0, 0.2), hands, st.booleans(), wish=st.sampled_from(list(Wish))), max_size=60
)


ELSEWHERE = (9.0, 9.0, 9.0)


def spot(programme: Programme, wish: Wish) -> Point:
    """Where that choice stands."""
    return next(choice.position for choice in programme.view().choices if choice.id is wish)


def chosen(programme: Programme, wish: Wish) -> GameView:
    """Come to the spot of that choice and stay there for as long as it takes."""
    place = spot(programme, wish)
    view = programme.step(GameInput(DT_S, ELSEWHERE, active=True))
    for _ in range(round(DWELL_S / DT_S) + 2):
        view = programme.step(GameInput(DT_S, place, active=True))
    return view


def test_the_patient_starts_pauses_goes_on_and_quits_by_gesture(usual: Workspace) -> None:
    programme = Programme(TWO, usual, 4)
    assert chosen(programme, Wish.START).phase is Phase.PLAYING
    while not programme.view().choices:
        programme.step(GameInput(DT_S, (9.0, 9.0, 9.0), active=True))
    assert chosen(programme, Wish.PAUSE).phase is Phase.PAUSED
    assert chosen(programme, Wish.GO_ON).phase is Phase.PLAYING
    programme.step(GameInput(DT_S, (9.0, 9.0, 9.0), active=True, wish=Wish.PAUSE))
    assert chosen(programme, Wish.NEXT).exercise == 2
    programme.step(GameInput(DT_S, (9.0, 9.0, 9.0), active=True, wish=Wish.PAUSE))
    assert chosen(programme, Wish.QUIT).phase is Phase.OVER


@pytest.mark.parametrize("wish", [Wish.GO_ON, Wish.QUIT, Wish.NEXT])
def test_a_hand_that_lies_at_a_spot_when_the_game_pauses_chooses_nothing(usual: Workspace, wish: Wish) -> None:
    programme = Programme(TWO, usual, 4)
    programme.step(GameInput(DT_S, ELSEWHERE, active=True, wish=Wish.START))
    programme.step(GameInput(DT_S, ELSEWHERE, active=True, wish=Wish.PAUSE))
    place = spot(programme, wish)
    programme.step(GameInput(DT_S, place, active=True, wish=Wish.GO_ON))
    programme.step(GameInput(DT_S, place, active=True, wish=Wish.PAUSE))
    for _ in range(round(3 * DWELL_S / DT_S)):
        view = programme.step(GameInput(DT_S, place, active=True))
    assert (view.phase, view.exercise) == (Phase.PAUSED, 1)
    assert all(choice.progress == 0.0 for choice in view.choices)
    chosen(programme, wish)
    assert programme.view().phase is not Phase.PAUSED


def test_who_pauses_by_hand_and_stays_there_quits_nothing_where_two_spots_are_one(usual: Workspace) -> None:
    """An arm whose elbow alone moves has its lowest place and its outermost one at the same end."""
    still = replace(usual, plane_rad=(1.0, 1.002), elevation_rad=(0.7, 0.702), rotation_rad=(0.0, 0.002))
    programme = Programme(TWO, still, 4)
    programme.step(GameInput(DT_S, ELSEWHERE, active=True, wish=Wish.START))
    while not programme.view().choices:
        programme.step(GameInput(DT_S, ELSEWHERE, active=True))
    place = spot(programme, Wish.PAUSE)
    assert chosen(programme, Wish.PAUSE).phase is Phase.PAUSED
    for _ in range(round(3 * DWELL_S / DT_S)):
        view = programme.step(GameInput(DT_S, place, active=True))
    assert (view.phase, view.exercise) == (Phase.PAUSED, 1)


def test_a_hand_that_passes_by_chooses_nothing(usual: Workspace) -> None:
    programme = Programme(TWO, usual, 4)
    place = programme.view().choices[0].position
    for k in range(100):
        programme.step(GameInput(DT_S, place if k % 2 else (9.0, 9.0, 9.0), active=True))
    assert programme.view().phase is Phase.WAITING


@pytest.mark.parametrize("side", list(Side))
def test_no_two_choices_that_stand_together_can_be_chosen_at_once(
    workspace_of: Callable[[Side], Workspace], side: Side
) -> None:
    programme = Programme(TWO, workspace_of(side), 4)
    view = programme.step(GameInput(DT_S, (9.0, 9.0, 9.0), active=True, wish=Wish.PAUSE))
    places = [choice.position for choice in view.choices]
    gaps = [distance_m(a, b) for i, a in enumerate(places) for b in places[:i]]
    assert len(places) == 3
    assert min(gaps) > 2 * view.choices[0].radius_m


def test_exercises_follow_one_another_and_the_points_add_up(usual: Workspace) -> None:
    programme = Programme(TWO, usual, 4)
    views = play(programme, Player(MIDDLE, 1), 60.0)
    phases = [view.phase for view in views]
    assert Phase.BETWEEN in phases
    assert views[-1].phase is Phase.OVER
    assert views[-1].exercise == 2
    assert views[-1].total_score == sum(outcome.score for outcome in programme.outcomes) > 0
    waits = [view.time_left_s for view in views if view.phase is Phase.BETWEEN]
    assert waits[0] == pytest.approx(BETWEEN_S)
    assert waits == sorted(waits, reverse=True)
    ids = {thing.id: view.exercise for view in views for thing in view.things}
    assert all(thing.id in ids and ids[thing.id] == view.exercise for view in views for thing in view.things)


@pytest.mark.parametrize("wish", [Wish.GO_ON, Wish.NEXT])
def test_what_comes_next_may_come_at_once(usual: Workspace, wish: Wish) -> None:
    programme = Programme(TWO, usual, 4)
    while programme.view().phase is not Phase.BETWEEN:
        programme.step(GameInput(0.1, (9.0, 9.0, 9.0), active=True))
    view = programme.step(GameInput(0.1, (9.0, 9.0, 9.0), active=True, wish=wish))
    assert (view.exercise, view.phase) == (2, Phase.PLAYING)


def test_a_pause_between_two_exercises_waits_with_its_menu(usual: Workspace) -> None:
    programme = Programme(TWO, usual, 4)
    while programme.view().phase is not Phase.BETWEEN:
        programme.step(GameInput(0.1, (9.0, 9.0, 9.0), active=True))
    programme.step(GameInput(0.1, (9.0, 9.0, 9.0), active=True, wish=Wish.PAUSE))
    for _ in range(round(2 * BETWEEN_S / 0.1)):
        view = programme.step(GameInput(0.1, (9.0, 9.0, 9.0), active=True))
    assert (view.exercise, view.phase) == (2, Phase.PAUSED)
    assert chosen(programme, Wish.GO_ON).phase is Phase.WAITING


def test_quitting_ends_all_exercises(usual: Workspace) -> None:
    programme = Programme(TWO, usual, 4)
    for _ in range(1000):
        view = programme.step(GameInput(0.1, (9.0, 9.0, 9.0), active=True, wish=Wish.QUIT))
    assert (view.phase, view.exercise, view.next_game) == (Phase.OVER, 1, "")


@given(seed=st.integers(0, 2**32), given_inputs=inputs)
def test_the_same_seed_and_inputs_give_the_same_games(
    usual: Workspace, seed: int, given_inputs: list[GameInput]
) -> None:
    record = GameRecord(TWO, usual, seed)
    assert list(replay(record, given_inputs)) == list(replay(record, given_inputs))


def test_recorded_games_are_played_again_to_the_same_score_and_the_same_attempts(usual: Workspace) -> None:
    programme, player = Programme(TWO, usual, 7), Player(MIDDLE, 7)
    recorded: list[GameInput] = []
    while programme.view().phase is not Phase.OVER:
        hand: Point = player.step(programme.view(), DT_S)
        recorded.append(GameInput(DT_S, hand, active=True))
        programme.step(recorded[-1])
    again = played(GameRecord(TWO, usual, 7), recorded)
    assert again.outcomes == programme.outcomes
    assert again.trials == programme.trials
    assert sum(outcome.score for outcome in again.outcomes) > 0


def test_another_seed_gives_another_game(usual: Workspace) -> None:
    starts = [
        Programme(TWO, usual, seed).step(GameInput(DT_S, (0.0, 0.0, 0.0), True, wish=Wish.START)) for seed in (1, 2)
    ]
    assert starts[0].things[0].position != starts[1].things[0].position


def test_an_unknown_game_is_named(usual: Workspace) -> None:
    with pytest.raises(InputError, match="chess"):
        Programme((Exercise("chess", SHORT),), usual, 1)
