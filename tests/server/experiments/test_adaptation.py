"""The study of the games' adaptation, made small, and its figures reckoned by hand."""

from __future__ import annotations

import pytest

from fusion.experiments.experiment import Setup
from fusion.experiments.house_style import rendered
from games.catalogue import GAMES
from games.game import Trial
from games.player import ABILITIES, WEAK
from server.experiments.catalogue import adaptation


def trials(*successes: bool) -> tuple[Trial, ...]:
    return tuple(Trial(k + 1, "reach", won, 0.5, 2.0, None, None, None, None, None) for k, won in enumerate(successes))


def found(*played: tuple[Trial, ...]) -> adaptation.Found:
    return adaptation.Found("reach", WEAK, played, 60.0)


def test_only_the_later_half_of_each_player_counts() -> None:
    won_late, won_all = trials(False, False, True, True), trials(True, True, True, True)
    assert found(won_late, won_all).share == 1.0
    assert found(won_all[:2] + won_late[:2], won_all).share == 0.5


def test_the_uncertainty_is_that_of_the_mean_over_players() -> None:
    shares = found(trials(True, True), trials(True, False), trials(True, True), trials(True, False))
    # A standard deviation of 0.577 over 4 players; Student's t for 95 % and 3 degrees of freedom is 3.182.
    assert shares.share == 0.5
    assert shares.either_way == pytest.approx(3.182 * 0.5774 / 2, rel=1e-3)


@pytest.mark.parametrize(("won", "met"), [(8, True), (10, False), (6, False)])
def test_the_goal_is_met_within_seven_points_of_75_percent(won: int, met: bool) -> None:
    one = trials(*([True] * 11 + [k < won for k in range(11)]))
    assert found(one, one).met is met


def test_every_game_and_ability_is_judged_and_drawn() -> None:
    outcome = adaptation.run(Setup(seed=2, effort=0.01))
    assert len(outcome.beside) == len(GAMES)
    assert [row[:2] for row in outcome.tables[0].rows] == [(game, each.name) for game in GAMES for each in ABILITIES]
    for picture in outcome.pictures:
        assert len(rendered(picture)["png"]) > 10_000
