"""One joint's set-point: it arrives, and it never leaves its box (SR-1, SR-2)."""

from __future__ import annotations

from math import cos, sin

from hypothesis import given, settings
from hypothesis import strategies as st

from server.station.exo.limiter import Box, Motion, to_rest, towards

BOX = Box(low_rad=-0.5, high_rad=1.5, velocity_rad_s=1.5, acceleration_rad_s2=8.0, jerk_rad_s3=200.0)
DT_S = 0.01
SLACK = 1e-9

goals = st.lists(
    st.tuples(
        st.floats(-20, 20),
        st.floats(-50, 50),
        st.floats(0, 1),
        st.floats(0.0005, 0.02),
        st.integers(1, 60),
        st.booleans(),
    ),
    min_size=1,
    max_size=12,
)


@settings(max_examples=400, derandomize=True, deadline=None)
@given(goals, st.floats(-0.5, 1.5))
def test_sr1_sr2_no_goal_takes_the_set_point_out_of_range_speed_or_acceleration(
    moves: list[tuple[float, float, float, float, int, bool]], start: float
) -> None:
    motion = Motion(start)
    for goal, goal_speed, speed, dt_s, ticks, rests in moves:
        for _ in range(ticks):
            before = motion
            motion = to_rest(motion, BOX, dt_s) if rests else towards(motion, goal, goal_speed, BOX, speed, dt_s)
            assert BOX.low_rad - SLACK <= motion.angle_rad <= BOX.high_rad + SLACK
            assert abs(motion.velocity_rad_s) <= BOX.velocity_rad_s + SLACK
            assert abs(motion.velocity_rad_s - before.velocity_rad_s) <= BOX.acceleration_rad_s2 * dt_s + SLACK


def test_a_step_is_reached_without_overshoot_beyond_five_milliradians() -> None:
    motion, furthest = Motion(0.0), 0.0
    for _ in range(300):
        motion = towards(motion, 1.0, 0.0, BOX, 1.0, DT_S)
        furthest = max(furthest, motion.angle_rad)
    assert abs(motion.angle_rad - 1.0) < 1e-3
    assert furthest < 1.005


def test_a_slow_human_movement_is_followed_with_little_lag() -> None:
    motion, worst = Motion(0.5), 0.0
    for tick in range(600):
        t_s = tick * DT_S
        goal, goal_speed = 0.5 + 0.5 * sin(2 * t_s), cos(2 * t_s)
        motion = towards(motion, goal, goal_speed, BOX, 1.0, DT_S)
        worst = max(worst, abs(motion.angle_rad - goal)) if t_s > 1 else worst
    assert worst < 0.015  # rad, at 1 rad/s: 15 ms


def test_sr2_jerk_is_limited_away_from_the_ends_of_the_range() -> None:
    motion = Motion(0.0)
    for _ in range(200):
        before = motion
        motion = towards(motion, 1.0, 0.0, BOX, 1.0, DT_S)
        assert abs(motion.acceleration_rad_s2 - before.acceleration_rad_s2) <= BOX.jerk_rad_s3 * DT_S + SLACK


def test_sr4_speed_zero_brings_the_set_point_to_rest() -> None:
    motion = Motion(0.0, 1.0)
    for _ in range(100):
        motion = towards(motion, 1.0, 0.5, BOX, 0.0, DT_S)
    assert abs(motion.velocity_rad_s) < 1e-3


def test_to_rest_takes_no_longer_than_full_deceleration_needs() -> None:
    motion, ticks = Motion(0.0, 1.5), 0
    while motion.velocity_rad_s:
        motion, ticks = to_rest(motion, BOX, DT_S), ticks + 1
    assert ticks <= 1.5 / 8.0 / DT_S + 1
