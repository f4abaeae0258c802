"""A command's trajectory ends at rest, inside the range, and never brakes softer than it must."""

from __future__ import annotations

from itertools import pairwise

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from server.emulated.robot import Path
from server.station.exo.rosbridge.trajectory import trajectory

NAMES = ("a", "b", "c")
ENDS = np.array([(-1.0, 1.0), (-2.0, 2.0), (0.0, 0.5)])
BRAKING = np.array([10.0, 5.0, 20.0])
LEAD_S = 0.02
angles = st.tuples(*[st.floats(low, high) for low, high in ENDS.tolist()])
speeds = st.tuples(*[st.floats(-3, 3)] * 3)


def _made(angle, speed):
    return trajectory(NAMES, np.array(angle), np.array(speed), BRAKING, ENDS, LEAD_S)


def _path(made, angle, speed):
    times = [0.0] + [point.time_from_start.seconds for point in made.points]
    return Path(
        np.array(times),
        np.vstack(([angle], [point.positions for point in made.points])),
        np.vstack(([speed], [point.velocities for point in made.points])),
    )


@given(angles, speeds)
def test_sr3_every_trajectory_ends_at_rest_with_growing_times(angle, speed) -> None:
    points = _made(angle, speed).points
    assert not any(points[-1].velocities)
    times = [point.time_from_start.seconds for point in points]
    assert times[0] == pytest.approx(LEAD_S)
    assert all(later - sooner > 0.001 for sooner, later in pairwise(times))


@given(angles, speeds)
def test_sr1_no_instant_after_the_first_point_is_outside_the_range(angle, speed) -> None:
    made = _made(angle, speed)
    path = _path(made, angle, speed)
    for t_s in np.linspace(LEAD_S, path.t_s[-1] + 0.1, 60):
        at, _ = path.at(float(t_s))
        assert (at >= ENDS[:, 0] - 1e-3).all()
        assert (at <= ENDS[:, 1] + 1e-3).all()


@given(speeds)
def test_sr3_where_there_is_room_each_joint_brakes_at_its_own_limit(speed) -> None:
    wide = np.array([(-9.0, 9.0)] * 3)
    made = trajectory(NAMES, np.zeros(3), np.array(speed), BRAKING, wide, LEAD_S)
    way = np.array(made.points[-1].positions)
    expected = np.array(speed) * LEAD_S + np.sign(speed) * np.square(speed) / (2 * BRAKING)
    assert way == pytest.approx(expected, abs=5e-5)  # brakes under 2 ms are left out: 4e-5 rad


def test_a_joint_at_rest_is_one_point_where_it_is() -> None:
    (point,) = _made((0.3, -1.0, 0.1), (0.0, 0.0, 0.0)).points
    assert point.positions == (0.3, -1.0, 0.1)


def test_a_steady_movement_is_led_by_its_speed() -> None:
    first = _made((0.0, 0.0, 0.1), (1.0, -0.5, 0.0)).points[0]
    assert first.positions == pytest.approx((0.02, -0.01, 0.1))
    assert first.velocities == pytest.approx((1.0, -0.5, 0.0))
