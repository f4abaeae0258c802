"""One joint's set-point: it arrives, and no limit of it is ever broken (SR-1, SR-2)."""

from __future__ import annotations

from dataclasses import replace
from math import cos, inf, nan, sin

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from server.station.exo.limiter import Box, Motion, to_rest, towards

BOX = Box(low_rad=-0.5, high_rad=1.5, velocity_rad_s=1.5, acceleration_rad_s2=8.0, jerk_rad_s3=200.0)
DT_S = 0.01
SLACK = 1e-9

boxes = st.builds(
    Box,
    low_rad=st.floats(-2, 0),
    high_rad=st.floats(0.1, 2),
    velocity_rad_s=st.floats(0.05, 5),
    acceleration_rad_s2=st.floats(0.2, 40),
    jerk_rad_s3=st.floats(5, 4000),
)
spells = st.lists(
    st.tuples(
        st.floats(-20, 20) | st.sampled_from([-0.5, 1.5, inf, -inf, nan]),
        st.floats(-50, 50) | st.sampled_from([inf, nan]),
        st.floats(0, 1),
        st.floats(1e-4, 0.02),
        st.integers(1, 50),
        st.booleans(),
    ),
    min_size=1,
    max_size=10,
)
Spells = list[tuple[float, float, float, float, int, bool]]


def _held(before: Motion, after: Motion, box: Box, dt_s: float) -> None:
    assert box.low_rad - SLACK <= after.angle_rad <= box.high_rad + SLACK
    assert abs(after.velocity_rad_s) <= box.velocity_rad_s + SLACK
    assert abs(after.acceleration_rad_s2) <= box.acceleration_rad_s2 + SLACK
    assert abs(after.acceleration_rad_s2 - before.acceleration_rad_s2) <= box.jerk_rad_s3 * dt_s + SLACK
    assert abs(after.velocity_rad_s - before.velocity_rad_s) <= box.acceleration_rad_s2 * dt_s + SLACK
    assert abs(after.angle_rad - before.angle_rad) <= box.velocity_rad_s * dt_s + SLACK


@settings(max_examples=250, derandomize=True, deadline=None)
@given(boxes, spells, st.floats(0, 1))
def test_sr1_sr2_no_goal_takes_the_set_point_out_of_range_speed_acceleration_or_jerk(
    box: Box, moves: Spells, start: float
) -> None:
    motion = Motion(box.low_rad + start * (box.high_rad - box.low_rad))
    for goal, goal_speed, speed, dt_s, ticks, rests in moves:
        for _ in range(ticks):
            before = motion
            motion = to_rest(motion, box, dt_s) if rests else towards(motion, goal, goal_speed, box, speed, dt_s)
            _held(before, motion, box, dt_s)


@settings(max_examples=150, derandomize=True, deadline=None)
@given(st.floats(-2, 2), st.lists(st.tuples(st.floats(-3, 3), st.floats(1e-4, 0.02)), min_size=50, max_size=200))
def test_sr2_a_goal_that_jumps_every_tick_breaks_no_limit(start: float, jumps: list[tuple[float, float]]) -> None:
    motion = Motion(min(max(start, BOX.low_rad), BOX.high_rad))
    for goal, dt_s in jumps:
        before, motion = motion, towards(motion, goal, 0.0, BOX, 1.0, dt_s)
        _held(before, motion, BOX, dt_s)


@settings(max_examples=150, derandomize=True, deadline=None)
@given(spells, st.floats(0.1, 1), st.floats(0.1, 1), st.floats(0.2, 1))
def test_sr2_limits_lowered_in_mid_motion_are_met_within_the_stopping_time(
    moves: Spells, slower: float, weaker: float, narrower: float
) -> None:
    motion = Motion(0.0)
    for goal, goal_speed, speed, dt_s, ticks, _ in moves:
        for _ in range(ticks):
            motion = towards(motion, goal, goal_speed, BOX, speed, dt_s)
    box = replace(
        BOX,
        high_rad=BOX.high_rad * narrower,
        velocity_rad_s=BOX.velocity_rad_s * slower,
        acceleration_rad_s2=BOX.acceleration_rad_s2 * weaker,
    )
    longest_s = BOX.velocity_rad_s / box.acceleration_rad_s2 + 3 * BOX.acceleration_rad_s2 / box.jerk_rad_s3
    for _ in range(int(longest_s / DT_S) + 1):
        before, motion = motion, towards(motion, 1.0, 0.0, box, 1.0, DT_S)
        assert abs(motion.acceleration_rad_s2 - before.acceleration_rad_s2) <= box.jerk_rad_s3 * DT_S + SLACK
    assert abs(motion.velocity_rad_s) <= box.velocity_rad_s + SLACK
    assert abs(motion.acceleration_rad_s2) <= box.acceleration_rad_s2 + SLACK


@pytest.mark.parametrize("outside", [-0.7, 1.8])
def test_sr1_a_start_outside_the_range_comes_in_and_never_further_out(outside: float) -> None:
    motion = Motion(outside)
    for _ in range(300):
        before, motion = motion, towards(motion, 0.5, 0.0, BOX, 1.0, DT_S)
        assert abs(motion.angle_rad - 0.5) <= abs(before.angle_rad - 0.5) + 1e-5
    assert motion.angle_rad == pytest.approx(0.5, abs=1e-3)


def test_a_step_is_reached_without_overshoot_beyond_a_milliradian() -> None:
    motion, furthest = Motion(0.0), 0.0
    for _ in range(200):
        motion = towards(motion, 1.0, 0.0, BOX, 1.0, DT_S)
        furthest = max(furthest, motion.angle_rad)
    assert abs(motion.angle_rad - 1.0) < 1e-3
    assert furthest < 1.001


def test_a_slow_human_movement_is_followed_with_little_lag() -> None:
    motion, worst = Motion(0.5), 0.0
    for tick in range(600):
        t_s = tick * DT_S
        goal, goal_speed = 0.5 + 0.5 * sin(2 * t_s), cos(2 * t_s)
        motion = towards(motion, goal, goal_speed, BOX, 1.0, DT_S)
        worst = max(worst, abs(motion.angle_rad - goal)) if t_s > 1 else worst
    assert worst < 0.015  # rad, at 1 rad/s: 15 ms


def test_sr1_a_goal_beyond_the_range_is_met_at_its_end_without_hammering() -> None:
    motion, turns, last = Motion(0.0), 0, 0.0
    for _ in range(300):
        before, motion = motion, towards(motion, 5.0, 3.0, BOX, 1.0, DT_S)
        jerk = motion.acceleration_rad_s2 - before.acceleration_rad_s2
        turns, last = turns + (jerk * last < -1e-4), jerk
    assert motion.angle_rad == pytest.approx(BOX.high_rad, abs=1e-3)
    assert turns <= 3


def test_sr4_speed_zero_brings_the_set_point_to_rest() -> None:
    motion = Motion(0.0, 1.0)
    for _ in range(100):
        motion = towards(motion, 1.0, 0.5, BOX, 0.0, DT_S)
    assert abs(motion.velocity_rad_s) < 1e-3


def _ticks_to_rest(motion: Motion) -> int:
    ticks = 0
    while motion.velocity_rad_s or motion.acceleration_rad_s2:
        motion, ticks = to_rest(motion, BOX, DT_S), ticks + 1
    return ticks


def test_sr3_sr7_rest_from_full_speed_takes_deceleration_and_one_jerk_time() -> None:
    assert _ticks_to_rest(Motion(0.0, 1.5)) * DT_S <= 1.5 / 8.0 + 8.0 / 200.0 + DT_S


@settings(max_examples=200, derandomize=True, deadline=None)
@given(st.floats(-1, 1), st.floats(-1, 1))
def test_sr3_sr7_rest_from_anywhere_takes_no_longer_than_stated_and_is_exact(v: float, a: float) -> None:
    """Worst: full speed reached while still speeding up; two jerk times and full deceleration."""
    acceleration = 8.0 * a
    fading = acceleration * abs(acceleration) / (2 * BOX.jerk_rad_s3)
    velocity = min(max(1.5 * v, -1.5 - min(fading, 0)), 1.5 - max(fading, 0))
    longest_s = 1.5 / 8.0 + 2 * 8.0 / BOX.jerk_rad_s3
    assert _ticks_to_rest(Motion(0.0, velocity, acceleration)) * DT_S <= longest_s + DT_S
