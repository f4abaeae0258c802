"""The belief about facing is a distribution, turns with the room, and knows what a person can do."""

from __future__ import annotations

import numpy as np
from hypothesis import given
from hypothesis import strategies as st

from fusion.align.facing import DIRECTIONS, Facing, ShoulderLine, shoulder_line
from fusion.skeleton import INDEX

from .turning import TRACKED, turned

ANGLE = st.floats(-np.pi, np.pi)
LOOK = st.tuples(st.sampled_from("ab"), st.floats(0.0, 0.4), ANGLE, ANGLE, st.floats(0.0, 1.0))
SMALL_RAD = 2 * np.pi / DIRECTIONS


def line(facing_rad, weight=1.0):
    return ShoulderLine(facing_rad, weight, (0.0, 0.0))


def after(looks, turn_rad=0.0):
    """The belief after some looks: sensor, time since the last, line, lens and weight; the room turned."""
    belief = Facing.at_first(0.0, turn_rad)
    for sensor, dt_s, facing_rad, lens_rad, weight in looks:
        belief = belief.at(belief.t_s + dt_s)
        belief = belief.seen(sensor, belief.t_s, line(facing_rad + turn_rad, weight), lens_rad + turn_rad)
        belief = belief.walked((np.sin(lens_rad + turn_rad), np.cos(lens_rad + turn_rad)), dt_s)
    return belief


@given(st.lists(LOOK, max_size=12))
def test_the_belief_stays_a_distribution(looks):
    belief = after(looks)
    assert np.isclose(belief.share.sum(), 1.0)
    assert (belief.share > 0).all()
    assert ((belief.exchanged >= 0) & (belief.exchanged <= 1)).all()


@given(st.lists(LOOK, max_size=6), st.integers(0, DIRECTIONS - 1))
def test_a_turned_room_turns_the_belief(looks, steps):
    straight, round_about = after(looks), after(looks, steps * SMALL_RAD)
    np.testing.assert_allclose(round_about.share, np.roll(straight.share, steps), atol=1e-9)
    for sensor in "ab":
        assert np.isclose(straight.log_odds_exchanged(sensor), round_about.log_odds_exchanged(sensor), atol=1e-6)


@given(ANGLE)
def test_a_shoulder_line_tells_the_facing(facing_rad):
    from ..conftest import BODY  # a fixture cannot be given to @given

    found = shoulder_line(turned(BODY, facing_rad), TRACKED)
    assert np.cos(found.facing_rad - facing_rad) > 1 - 1e-9
    assert found.weight == 1.0


def test_hips_stand_in_for_a_lost_shoulder(bodies):
    state = TRACKED.copy()
    state[INDEX["ShoulderLeft"]] = 0
    assert np.cos(shoulder_line(turned(bodies.BODY, 1.0), state).facing_rad - 1.0) > 1 - 1e-9


def test_time_without_looks_makes_it_forget():
    belief = after([("a", 0.1, 0.0, 0.0, 1.0)] * 10)
    later = belief.at(belief.t_s + 2.5)
    assert later.share.max() < 0.5 * belief.share.max()
    assert np.isclose(later.share.sum(), 1.0)


def test_brisk_walking_tells_the_facing_and_slow_steps_do_not():
    belief = Facing.at_first(0.0, 0.0)
    assert belief.walked((0.0, -0.4), 1.0) is belief
    assert np.cos(belief.walked((0.0, -1.2), 2.0).facing_rad) < 0
