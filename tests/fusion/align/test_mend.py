"""Exchanged sides are put back whichever way the patient turns; what cannot be told is left out."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from fusion.align.mend import SIDED, Mending, SideKeeper
from fusion.skeleton import INDEX, SIDES_SWAPPED

from .turning import LENSES, PERIOD_S, rightly_named, sample, turned, watched

TO_THE_FRONT = np.pi


def kept(frames, sides=None):
    """Every frame as mended, with what was done and whether its names are right."""
    sides = sides or SideKeeper()
    for seen in frames:
        mended, what = sides.mend(seen.frame)
        yield mended, what, rightly_named(mended, seen.body)


def standing(_):
    return TO_THE_FRONT, (0.0, 0.0)


def test_a_sensor_that_exchanges_the_sides_of_somebody_who_stands_is_mended_at_once(bodies):
    sides = SideKeeper()
    list(kept(watched(bodies.BODY, standing, 2.0), sides))
    exchanged = sample("right", 2.0, bodies.BODY[SIDES_SWAPPED], LENSES["right"])
    mended, what = sides.mend(exchanged)
    assert what is Mending.SWAPPED_BACK
    np.testing.assert_array_equal(mended.positions_in_room, bodies.BODY)


def test_a_single_sensor_that_exchanges_sides_is_mended_within_a_tenth_of_a_second(bodies):
    def names(body, lens):
        names.frame += 1
        return body if names.frame < 60 else body[SIDES_SWAPPED]

    names.frame = 0
    right = [good for *_, good in kept(watched(bodies.BODY, standing, 6.0, ("front",), names))]
    assert all(right[:59])
    assert all(right[62:])


@pytest.mark.parametrize("speed_rad_s", [0.6, 1.5, 2.5, -1.5])
def test_somebody_who_turns_round_keeps_left_and_right_though_both_sensors_take_the_back_for_a_front(
    bodies, speed_rad_s
):
    """A frame or two after the sensor has named anew nothing can be known; that is all that may be wrong."""

    def turning(t_s):
        return TO_THE_FRONT + speed_rad_s * max(0.0, t_s - 1.0), (0.0, 0.0)

    told = list(kept(watched(bodies.BODY, turning, 1.0 + 2 * np.pi / abs(speed_rad_s), noise_m=0.005)))
    used = [good for _, what, good in told if what is not Mending.SIDES_REFUSED]
    assert len(used) > 0.97 * len(told)
    assert np.mean(used) > 0.98


def test_a_walk_in_a_circle_keeps_left_and_right(bodies):
    def circle(t_s):
        heading = TO_THE_FRONT - 1.2 * t_s
        return heading, (0.5 * np.cos(heading), -0.5 * np.sin(heading))

    told = list(kept(watched(bodies.BODY, circle, 10.0, noise_m=0.005)))
    used = [good for _, what, good in told if what is not Mending.SIDES_REFUSED]
    assert len(used) > 0.97 * len(told)
    assert np.mean(used) > 0.98


@settings(max_examples=25)
@given(st.floats(0.2, 2.5), st.sampled_from([-1, 1]), st.sampled_from([("front",), ("front", "right")]))
def test_a_sensor_that_names_backs_rightly_is_never_mended(speed_rad_s, sign, sensors):
    body = _body()

    def turning(t_s):
        return TO_THE_FRONT + sign * speed_rad_s * t_s, (0.0, 0.0)

    def rightly(positions, _):
        return positions

    done = {what for _, what, _ in kept(watched(body, turning, 4.0, sensors, rightly))}
    assert done == {Mending.NONE}


def test_stepping_back_slowly_is_not_taken_for_turning_round(bodies):
    def back(t_s):
        return TO_THE_FRONT, (0.0, 0.45 * t_s)

    done = {what for _, what, _ in kept(watched(bodies.BODY, back, 4.0))}
    assert done == {Mending.NONE}


def test_a_sensor_whose_line_contradicts_the_other_without_being_its_reverse_loses_its_sides_only(bodies):
    sides = SideKeeper()
    list(kept(watched(bodies.BODY, standing, 2.0), sides))
    for k in range(1, 40):  # drifts away by 2.6° a frame: nothing was named anew
        t_s = 2.0 + k * PERIOD_S
        sides.mend(sample("front", t_s, bodies.BODY))
        strange, what = sides.mend(
            sample("right", t_s + 0.01, turned(bodies.BODY, np.pi - k * np.radians(2.6)), LENSES["right"])
        )
    assert what is Mending.SIDES_REFUSED
    assert (strange.state[SIDED] == 0).all()
    assert strange.state[INDEX["SpineMid"]] == 2


def test_a_frame_without_shoulders_and_hips_keeps_the_decision(bodies):
    sides = SideKeeper()
    list(kept(watched(bodies.BODY, standing, 2.0), sides))
    exchanged = sample("right", 2.0, bodies.BODY[SIDES_SWAPPED], LENSES["right"])
    sides.mend(exchanged)
    state = exchanged.state.copy()
    state[[INDEX[name] for name in ("ShoulderLeft", "ShoulderRight", "HipLeft", "HipRight")]] = 0
    _, what = sides.mend(replace(exchanged, t_s=2.03, state=state))
    assert what is Mending.SWAPPED_BACK


def test_a_body_that_nobody_can_see_is_let_through(bodies):
    nothing = replace(sample("front", 0.0, np.full_like(bodies.BODY, np.nan)), state=np.zeros(25, dtype=np.uint8))
    assert SideKeeper().mend(nothing) == (nothing, Mending.NONE)


def test_a_late_frame_does_not_turn_back_the_clock(bodies):
    sides = SideKeeper()
    list(kept(watched(bodies.BODY, standing, 1.0), sides))
    before_s = sides.facing.t_s
    sides.mend(sample("right", before_s - 0.2, bodies.BODY, LENSES["right"]))
    assert sides.facing.t_s == before_s


def _body():
    from ..conftest import BODY  # a fixture cannot be given to @given

    return BODY
