"""Laws that every game keeps: replay, reach, frame rate, mirror, idleness, pause, broken hands, a level's span."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace
from functools import partial
from itertools import accumulate

import numpy as np
import pytest
from scipy.optimize import minimize

from fusion.skeleton import Side
from games.catalogue import GAMES, open_game
from games.game import Game, GameInput, GameSettings, GameView, Phase, Point, Trial, Wish, Workspace
from games.play import Play
from games.player import MIDDLE, QUICK, WEAK, Ability, Player
from games.programme import Exercise
from games.replay import GameRecord, Played, opened, played
from games.workspace import hand_at, middle_pose, reachable

DT_S = 0.05
NAN = float("nan")
WorkspaceOf = Callable[[Side], Workspace]
every_game = pytest.mark.parametrize("game", list(GAMES))
both_sides = pytest.mark.parametrize("side", list(Side))


def settings(level: float, round_s: float = 600.0) -> GameSettings:
    return GameSettings(rounds=1, round_s=round_s, start_level=level, pinned=True)


def begun(game: str, workspace: Workspace, level: float = 0.2, seed: int = 3) -> Play:
    opened = open_game(game, workspace, seed, settings(level))
    opened.step(GameInput(DT_S, opened.view().hand, active=True, wish=Wish.START))
    return opened


def mirrored(place: Point) -> Point:
    return (-place[0], place[1], place[2])


def given(hand: Point, dt_s: float = DT_S) -> GameInput:
    return GameInput(dt_s, hand, active=True, healthy_hand=mirrored(hand))


def course(game: Game, ability: Ability, seconds: float, dt_s: float = DT_S) -> tuple[list[GameInput], list[GameView]]:
    """What a player did with a game, and the pictures it saw."""
    player, inputs, views = Player(ability, 5), [], [game.view()]
    for _ in range(round(seconds / dt_s)):
        inputs.append(given(player.step(views[-1], dt_s), dt_s))
        views.append(game.step(inputs[-1]))
    return inputs, views


def outcomes(trials: tuple[Trial, ...]) -> list[tuple[bool, int]]:
    return [(trial.success, trial.number) for trial in trials]


@every_game
def test_a_recorded_game_is_played_again_to_the_same_score_and_trials(game: str, usual: Workspace) -> None:
    adapting = GameSettings(rounds=2, round_s=20.0, rest_s=2.0)
    record = GameRecord((Exercise(game, adapting),), usual, 7)
    first = opened(record)
    inputs, _ = course(first, MIDDLE, 40.0)
    again = played(record, inputs)
    assert again == Played(first.outcomes, first.trials)
    assert again.outcomes[0].score > 0


@every_game
@both_sides
def test_wherever_a_game_wants_the_hand_it_can_go(game: str, side: Side, workspace_of: WorkspaceOf) -> None:
    workspace = workspace_of(side)
    aims = set()
    for level in (0.0, 0.5, 1.0):
        _, views = course(begun(game, workspace, level), QUICK, 20.0)
        aims |= {tuple(round(part, 2) for part in view.aim) for view in views if view.aim is not None}
    assert len(aims) >= 3
    assert farthest_from_reach_m(workspace, sorted(aims)) < 0.02


def farthest_from_reach_m(workspace: Workspace, places: list[Point]) -> float:
    """The largest distance to one of a few of the places that an arm inside its ranges leaves."""
    limits = (workspace.plane_rad, workspace.elevation_rad, workspace.rotation_rad, workspace.elbow_rad)
    drawn = reachable(workspace, 400, np.random.default_rng(0))
    known, poses = np.array([one.position for one in drawn]), [one.pose_rad for one in drawn]
    worst_m = 0.0
    for place in places[:: max(1, len(places) // 12)]:
        nearest = poses[int(np.argmin(np.linalg.norm(known - place, axis=1)))]
        found = minimize(partial(squared_distance, workspace, place), nearest, bounds=limits)
        worst_m = max(worst_m, float(np.sqrt(found.fun)))
    return worst_m


def squared_distance(workspace: Workspace, place: Point, angles: np.ndarray) -> float:
    plane, elevation, rotation, elbow = (float(angle) for angle in angles)
    return float(np.sum(np.subtract(hand_at(workspace, (plane, elevation, rotation, elbow)), place) ** 2))


@every_game
@pytest.mark.parametrize("seed", range(3))
def test_the_first_attempt_ends_alike_however_often_the_hand_is_looked_at(
    game: str, seed: int, usual: Workspace
) -> None:
    fine_s = 0.01
    inputs, _ = course(begun(game, usual, 0.1, seed), MIDDLE, 14.0, fine_s)
    hands = [one.hand for one in inputs]
    often = first_end(begun(game, usual, 0.1, seed), hands, [1] * len(hands), fine_s)
    rng = np.random.default_rng(seed)
    for gaps in ([10] * len(hands), [3] * len(hands), rng.integers(1, 11, len(hands)).tolist()):
        seldom = first_end(begun(game, usual, 0.1, seed), hands, gaps, fine_s)
        assert (seldom.success, seldom.number) == (often.success, often.number)
        assert seldom.duration_s == pytest.approx(often.duration_s, abs=0.25)


def first_end(game: Play, hands: list[Point], gaps: list[int], fine_s: float) -> Trial:
    """How the first attempt ends for somebody who looks at only some of the hand's places."""
    before = 0
    for k in accumulate(gaps, initial=0):
        game.step(given(hands[min(k, len(hands) - 1)], max(k - before, 1) * fine_s))
        before = k
        if game.trials:
            break
    return game.trials[0]


@every_game
def test_a_mirrored_workspace_is_the_same_game_mirrored(game: str, workspace_of: WorkspaceOf) -> None:
    right = begun(game, workspace_of(Side.RIGHT), 0.3)
    left = begun(game, workspace_of(Side.LEFT), 0.3)
    inputs, views = course(right, MIDDLE, 20.0)
    for one, seen in zip(inputs, views[1:], strict=True):
        assert one.healthy_hand is not None
        there = left.step(replace(one, hand=mirrored(one.hand), healthy_hand=mirrored(one.healthy_hand)))
        assert (there.score, there.hits, there.misses) == (seen.score, seen.hits, seen.misses)
        if seen.aim is None:
            assert there.aim is None
        else:
            assert there.aim == pytest.approx(mirrored(seen.aim), abs=1e-6)


@every_game
@pytest.mark.parametrize("seed", range(3))
def test_a_hand_that_does_nothing_never_scores(game: str, seed: int, usual: Workspace) -> None:
    idle = begun(game, usual, 0.0, seed)
    hand = hand_at(usual, middle_pose(usual))
    views = [idle.step(given(hand)) for _ in range(round(40.0 / DT_S))]
    assert views[-1].score == 0
    assert views[-1].misses >= 1


@every_game
def test_a_paused_game_changes_nothing_but_the_hand(game: str, usual: Workspace) -> None:
    opened = begun(game, usual)
    _, views = course(opened, MIDDLE, 6.3)
    before = views[-1]
    for k in range(100):
        held = opened.step(GameInput(DT_S, (0.002 * k, 0.0, -0.3), active=False))
        assert replace(held, hand=before.hand, feedback=before.feedback) == before


@every_game
@pytest.mark.parametrize("bad", [(NAN, 0.0, 0.0), (NAN, NAN, NAN), (0.0, float("inf"), 0.0)])
def test_a_hand_that_is_not_known_harms_nothing(game: str, bad: Point, usual: Workspace) -> None:
    opened = begun(game, usual)
    course(opened, MIDDLE, 4.0)
    before = opened.view()
    for _ in range(20):
        view = opened.step(GameInput(DT_S, bad, active=True, healthy_hand=bad))
        assert view.hand == before.hand
        places = [thing.position for thing in view.things]
        assert np.isfinite(np.array([view.hand, *places, *view.way])).all()
    _, views = course(opened, QUICK, 25.0)
    assert views[-1].score > before.score


@every_game
@pytest.mark.parametrize("dt_s", [0.0, 30.0])
def test_a_stalled_or_stopped_clock_costs_the_patient_nothing(game: str, dt_s: float, usual: Workspace) -> None:
    opened = begun(game, usual)
    course(opened, MIDDLE, 0.5)
    before = opened.view()
    after = opened.step(given(before.hand, dt_s))
    assert (after.misses, after.phase) == (before.misses, Phase.PLAYING)


@every_game
def test_a_number_names_one_thing_only(game: str, usual: Workspace) -> None:
    _, views = course(begun(game, usual, 0.3), MIDDLE, 30.0)
    kinds: dict[int, str] = {}
    for view in views:
        assert len({thing.id for thing in view.things}) == len(view.things)
        assert all(kinds.setdefault(thing.id, thing.kind) == thing.kind for thing in view.things)
    assert len(kinds) > 3


@every_game
def test_the_levels_reach_from_what_a_weak_hand_does_to_what_a_quick_one_misses(game: str, usual: Workspace) -> None:
    easy, hard = begun(game, usual, 0.0), begun(game, usual, 1.0)
    course(easy, WEAK, 80.0)
    course(hard, QUICK, 60.0)
    assert np.mean([trial.success for trial in easy.trials]) >= 0.9
    assert np.mean([trial.success for trial in hard.trials]) <= 0.55
