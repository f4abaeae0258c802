"""A task made of stays: order, what leaving costs, what is measured, how long it may take."""

from __future__ import annotations

import pytest

from games.even_steps import STEP_S
from games.everyday.errand import LEAVING, Errand, Stay, time_for
from games.game import Point

HERE: Point = (0.1, -0.2, -0.4)
THERE: Point = (0.4, -0.2, -0.4)
AWAY: Point = (9.0, 9.0, 9.0)


@pytest.fixture
def errand() -> Errand:
    stays = (Stay("take", HERE, 0.05, 0.2), Stay("put", THERE, 0.05, 0.4))
    return Errand(1, "stack", 7, stays, time_s=2.0, hand=AWAY)


def held(errand: Errand, hand: Point, steps: int) -> Errand:
    for _ in range(steps):
        errand = errand.after(hand)
    return errand


def test_a_stay_is_complete_after_its_time_inside(errand: Errand) -> None:
    assert not held(errand, HERE, 19).is_stayed
    assert held(errand, HERE, 20).is_stayed
    assert not held(errand, AWAY, 200).is_stayed


def test_leaving_loses_the_stay_at_half_the_speed_and_never_more_than_there_was(errand: Errand) -> None:
    there = held(errand, HERE, 10)
    assert held(there, AWAY, 4).stayed_s == pytest.approx(there.stayed_s - 4 * LEAVING * STEP_S)
    assert held(there, AWAY, 100).stayed_s == 0.0


def test_the_next_stay_begins_at_nothing_while_the_time_goes_on(errand: Errand) -> None:
    first = held(errand, HERE, 20)
    second = first.next()
    assert (second.stay.verb, second.progress, second.inside, second.age_s) == ("put", 0.0, (), first.age_s)
    assert (first.is_last, second.is_last) == (False, True)


def test_the_error_is_the_mean_distance_of_the_hand_inside(errand: Errand) -> None:
    x, y, z = HERE
    wandered = held(held(held(errand, (x + 0.02, y, z), 5), (x, y - 0.04, z), 5), AWAY, 3)
    assert wandered.off_m == pytest.approx(0.03)


def test_a_hand_that_left_for_good_has_left_no_places(errand: Errand) -> None:
    assert held(held(errand, HERE, 5), AWAY, 30).inside == ()


def test_the_share_of_time_ends_at_one(errand: Errand) -> None:
    assert held(errand, AWAY, 100).gone == pytest.approx(0.5)
    assert held(errand, AWAY, 300).gone == 1.0


def test_the_time_is_for_the_ways_at_the_pace_the_stays_and_a_spare_for_each(errand: Errand) -> None:
    assert time_for((0.1, -0.2, -0.1), errand.stays, pace_m_s=0.1, spare_s=1.0) == pytest.approx(3.0 + 3.0 + 0.6 + 2.0)
