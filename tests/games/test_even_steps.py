"""Even steps are the same however the time was cut up."""

from __future__ import annotations

from itertools import pairwise

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from games.even_steps import STEP_S, EvenSteps, Moment
from games.rules import PlayInput

steps_s = st.lists(st.floats(0.005, 0.1), min_size=2, max_size=40)


def straight(steps: EvenSteps, times_s: list[float]) -> list[Moment]:
    """Hands that go straight at 1 m/s, looked at after each of these steps."""
    at_s, moments = 0.0, list[Moment]()
    for dt_s in times_s:
        at_s += dt_s
        moments += steps.take(PlayInput(dt_s, (at_s, 0.0, 0.0), (-at_s, 0.0, 0.0), 0.5))
    return moments


@given(times_s=steps_s)
def test_a_hand_at_even_speed_is_seen_at_even_distances(times_s: list[float]) -> None:
    # Before the first input nobody knows where the hands were.
    moments = straight(EvenSteps(), [STEP_S, *times_s])
    places_m = [moment.hand[0] for moment in moments]
    assert [b - a for a, b in pairwise(places_m)] == pytest.approx([STEP_S] * (len(places_m) - 1))
    assert len(moments) == pytest.approx(1 + np.sum(times_s) / STEP_S, abs=1.0)
    assert all(moment.healthy_hand == (-moment.hand[0], 0.0, 0.0) for moment in moments)


def test_a_healthy_hand_that_is_lost_is_not_made_up() -> None:
    steps = EvenSteps()
    steps.take(PlayInput(0.05, (0.0, 0.0, 0.0), (0.1, 0.0, 0.0), 0.5))
    moments = steps.take(PlayInput(0.05, (0.0, 0.0, 0.0), None, 0.5))
    assert {moment.healthy_hand for moment in moments} == {None}


def test_after_forgetting_a_jump_is_no_movement() -> None:
    steps = EvenSteps()
    steps.take(PlayInput(0.05, (0.0, 0.0, 0.0), None, 0.5))
    steps.forget()
    moments = steps.take(PlayInput(0.05, (1.0, 0.0, 0.0), None, 0.5))
    assert {moment.hand for moment in moments} == {(1.0, 0.0, 0.0)}


def test_no_time_gives_no_steps() -> None:
    assert EvenSteps().take(PlayInput(0.0, (0.0, 0.0, 0.0), None, 0.5)) == ()
