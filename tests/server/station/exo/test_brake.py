"""The way to rest: what is planned is what its closed form says, and it holds no angle back (SR-2)."""

from __future__ import annotations

from math import sqrt

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from ruckig import RuckigError

from server.station.exo.brake import Brake, Motion

motions = st.builds(Motion, st.floats(-3, 3), st.floats(-5, 5), st.floats(-20, 20))


def _closed_form_s(v: float, a: float, largest: float, jerk: float) -> float:
    """Duration of the three phases: to the deceleration, at it, and away from it."""
    if v + a * abs(a) / (2 * jerk) < 0:
        v, a = -v, -a
    peak = min(largest, sqrt(max(jerk * v + a * a / 2, 0.0)))
    there = abs(a + peak) / jerk
    reached = v + there * (a - peak) / 2
    return there + max(reached - peak * peak / (2 * jerk), 0.0) / max(peak, 1e-12) + peak / jerk


@settings(max_examples=300, derandomize=True, deadline=None)
@given(motions, st.floats(0.5, 20), st.floats(10, 2000))
def test_the_plan_is_as_short_as_the_closed_form(motion: Motion, largest: float, jerk: float) -> None:
    a = min(max(motion.acceleration_rad_s2, -largest), largest)
    begun = Motion(motion.angle_rad, motion.velocity_rad_s, a)
    expected_s = _closed_form_s(begun.velocity_rad_s, a, largest, jerk)
    assert Brake.of(begun, largest, jerk).trajectory.duration == pytest.approx(expected_s, rel=1e-6, abs=1e-6)


@settings(max_examples=300, derandomize=True, deadline=None)
@given(motions, st.floats(0.5, 20), st.floats(10, 2000))
def test_no_angle_on_the_way_lies_beyond_the_two_that_are_told(motion: Motion, largest: float, jerk: float) -> None:
    brake = Brake.of(motion, largest, jerk)
    way = [brake.after(brake.trajectory.duration * k / 50).angle_rad for k in range(51)]
    assert brake.low_rad - 1e-9 <= min(way)
    assert max(way) <= brake.high_rad + 1e-9


def test_what_is_left_of_a_brake_is_the_brake_from_there() -> None:
    brake = Brake.of(Motion(0.4, -1.0, 5.0), 8.0, 200.0)
    later = Brake.of(brake.after(0.03), 8.0, 200.0)
    for ahead_s in (0.01, 0.05, 0.1):
        there, same = brake.after(0.03 + ahead_s), later.after(ahead_s)
        assert there.angle_rad == pytest.approx(same.angle_rad, abs=1e-12)
        assert there.velocity_rad_s == pytest.approx(same.velocity_rad_s, abs=1e-12)


def test_its_end_stands_exactly_still() -> None:
    brake = Brake.of(Motion(0.4, -1.0, 5.0), 8.0, 200.0)
    assert brake.after(1.0) == Motion(brake.after(2.0).angle_rad, 0.0, 0.0)


@pytest.mark.parametrize(("largest", "jerk"), [(0.0, 200.0), (8.0, 0.0), (float("nan"), 200.0)])
def test_limits_that_leave_no_way_to_rest_are_refused(largest: float, jerk: float) -> None:
    with pytest.raises(RuckigError):
        Brake.of(Motion(0.0, 1.0), largest, jerk)
