"""A session's figures on sessions whose answers are known, and on sessions too poor to have any."""

from __future__ import annotations

from dataclasses import replace
from math import isfinite, pi

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from scipy.signal import butter, sosfiltfilt

from fusion.messages import Floats
from fusion.metrics.metric import ONE_SENSOR, PASSIVE_DRIVE, SLOW, UNRELIABLE, Metric
from fusion.metrics.range_of_movement import angle_range
from fusion.metrics.record import SensorTrack, SessionRecord
from fusion.metrics.session import session_metrics
from fusion.metrics.symmetry import likeness
from fusion.skeleton import Side

RATE = 100.0


def reaching(seconds: float, period_s: float = 2.0, far_m: float = 0.3) -> Floats:
    """A hand that reaches ahead in one second, rests, comes back in one second, rests: (T, 3)."""
    t = np.arange(0, seconds, 1 / RATE)
    u = np.clip((t % period_s) - 0.5, 0, 1)
    share = 10 * u**3 - 15 * u**4 + 6 * u**5
    back = (t // period_s).astype(int) % 2 == 1
    hand = np.zeros((len(t), 3))
    hand[:, 2] = -far_m * np.where(back, 1 - share, share) - 0.2
    return hand


def angles(t_s: Floats) -> Floats:
    """(T, 4) angles that sway with different rhythms."""
    return np.column_stack(
        [
            0.8 + 0.4 * np.sin(0.9 * t_s),
            1.0 + 0.3 * np.sin(1.3 * t_s),
            0.2 * np.sin(0.7 * t_s),
            1.2 + 0.5 * np.sin(1.7 * t_s + 1),
        ]
    )


def record(seconds: float = 40.0, lag_s: float = 0.15) -> SessionRecord:
    hand = reaching(seconds)
    t_s = np.arange(len(hand)) / RATE
    state = np.where(t_s < 2.0, "ready", "engaged")
    seen = (np.full(len(t_s), 30.0), np.full(len(t_s), 0.02), np.linspace(0, 0.04, len(t_s)))
    return SessionRecord(
        t_s=t_s,
        state=state,
        healthy_side=Side.LEFT,
        healthy_rad=angles(t_s),
        healthy_valid=np.ones(len(t_s), dtype=bool),
        affected_rad=angles(t_s - lag_s),
        hand_in_trunk=hand,
        trunk_displacement_m=np.linspace(0, 0.1, len(t_s)),
        sensors=(SensorTrack("kinect-1", *seen), SensorTrack("kinect-2", *seen)),
        hits=9,
        misses=3,
        shoulder_hitch_m=np.linspace(0, 0.05, len(t_s)),
    )


def named(metrics: tuple[Metric, ...], name: str, joint: str | None = None, side: Side | None = None) -> Metric:
    found = [m for m in metrics if m.name == name and m.joint == joint and (side is None or m.side is side)]
    assert len(found) == 1, (name, found)
    return found[0]


def value(metrics: tuple[Metric, ...], name: str, joint: str | None = None, side: Side | None = None) -> float:
    return named(metrics, name, joint, side).value


@pytest.fixture(scope="module")
def usual() -> tuple[Metric, ...]:
    return session_metrics(record())


def test_a_hand_that_never_moves_has_no_movements() -> None:
    still = record(10.0)
    figures = session_metrics(replace(still, hand_in_trunk=np.zeros_like(still.hand_in_trunk)))
    assert not [metric for metric in figures if metric.name == "movements"]
    assert value(figures, "time_engaged") > 0


def test_movements_are_counted_and_measured(usual: tuple[Metric, ...]) -> None:
    assert value(usual, "movements") == 19
    # A minimum-jerk reach of 0.3 m in 1 s: peak 1.875 × 0.3 m/s; it is above 15 % of that for 0.79 s.
    assert value(usual, "peak_speed") == pytest.approx(0.5625, rel=0.03)
    assert value(usual, "movement_time") == pytest.approx(0.79, abs=0.05)
    assert value(usual, "mean_speed") == pytest.approx(0.3 / 0.79, rel=0.05)
    assert value(usual, "path_ratio") == pytest.approx(1.0, abs=0.01)
    # A whole minimum-jerk movement has -1.41; cutting its ends off costs 0.11.
    assert value(usual, "sparc") == pytest.approx(-1.52, abs=0.03)


def test_a_detour_lengthens_the_path_ratio() -> None:
    bent = record()
    hand = bent.hand_in_trunk.copy()
    hand[:, 0] = 0.15 * np.sin(pi * (hand[:, 2] + 0.2) / 0.3)
    assert value(session_metrics(replace(bent, hand_in_trunk=hand)), "path_ratio") > 1.3


def test_a_shaking_hand_is_less_smooth() -> None:
    shaking = record()
    hand = shaking.hand_in_trunk.copy()
    speed = np.abs(np.gradient(hand[:, 2], 1 / RATE))
    hand[:, 2] += 0.02 * speed / speed.max() * np.sin(2 * pi * 2.5 * shaking.t_s)
    calm, shaky = (value(session_metrics(one), "sparc") for one in (shaking, replace(shaking, hand_in_trunk=hand)))
    assert shaky < calm - 0.2


def test_a_reach_in_three_steps_has_three_velocity_peaks(usual: tuple[Metric, ...]) -> None:
    assert value(usual, "velocity_peaks") == 1.0
    stepped = record()
    hand = stepped.hand_in_trunk.copy()
    hand[:, 2] += 0.016 * np.sin(2 * pi * 3 * (hand[:, 2] + 0.2) / 0.3)
    assert value(session_metrics(replace(stepped, hand_in_trunk=hand)), "velocity_peaks") > 1.5


def test_a_figure_of_many_movements_says_how_sure_it_is(usual: tuple[Metric, ...]) -> None:
    calm = named(usual, "movement_time").sem
    rushed = record()
    warp = np.cumsum(1.0 + 0.5 * np.sin(2 * pi * rushed.t_s / 16)) / RATE
    uneven = replace(
        rushed, hand_in_trunk=np.column_stack([np.interp(rushed.t_s, warp, c) for c in rushed.hand_in_trunk.T])
    )
    varied = named(session_metrics(uneven), "movement_time").sem
    assert calm is not None
    assert varied is not None
    assert varied > 2 * calm
    assert named(usual, "movements").sem is None
    assert named(usual, "range_of_movement", "elbow", Side.LEFT).sem is not None


def test_slow_movements_say_that_the_sensors_noise_is_as_fast() -> None:
    quick = record()
    quick = replace(quick, hand_in_trunk=1.5 * quick.hand_in_trunk)
    slow = replace(quick, hand_in_trunk=0.5 * quick.hand_in_trunk)
    assert named(session_metrics(quick), "movement_time").caveat_key is None
    assert named(session_metrics(slow), "movement_time").caveat_key == SLOW


def test_what_one_sensor_saw_alone_says_so() -> None:
    both = record()
    quick = replace(both, hand_in_trunk=1.5 * both.hand_in_trunk)
    lost = replace(quick.sensors[1], frames_per_s=np.full(len(quick.t_s), np.nan))
    figures = session_metrics(replace(quick, sensors=(quick.sensors[0], lost)))
    assert named(figures, "mean_speed").caveat_key == ONE_SENSOR
    assert named(figures, "range_of_movement", "elbow", Side.LEFT).caveat_key == ONE_SENSOR
    assert named(figures, "peak_speed").caveat_key == UNRELIABLE


def test_noise_neither_makes_nor_hides_a_movement() -> None:
    # As a fused depth camera's hand has it: 1 cm, correlated over a third of a second.
    noisy = record()
    rng = np.random.default_rng(2)
    white = rng.normal(size=noisy.hand_in_trunk.shape)
    smooth = sosfiltfilt(butter(1, 0.5, fs=RATE, output="sos"), white, axis=0)
    figures = session_metrics(replace(noisy, hand_in_trunk=noisy.hand_in_trunk + 0.01 * smooth / smooth.std()))
    assert value(figures, "movements") == pytest.approx(19, abs=1)
    assert value(figures, "movement_time") == pytest.approx(0.79, abs=0.12)
    assert value(figures, "path_ratio") < 1.1


def test_ranges_of_both_arms_are_those_of_the_sines(usual: tuple[Metric, ...]) -> None:
    for side in Side:
        assert value(usual, "range_of_movement", "elbow", side) == pytest.approx(1.0, abs=0.03)
        assert value(usual, "range_lowest", "elevation", side) == pytest.approx(0.7, abs=0.03)
        assert value(usual, "range_highest", "elevation", side) == pytest.approx(1.3, abs=0.03)


def test_the_affected_arms_figures_say_that_the_drive_made_them(usual: tuple[Metric, ...]) -> None:
    assert named(usual, "range_of_movement", "elbow", Side.RIGHT).caveat_key == PASSIVE_DRIVE
    assert named(usual, "range_of_movement", "elbow", Side.LEFT).caveat_key is None
    assert named(usual, "lag", "elbow").caveat_key == PASSIVE_DRIVE
    assert named(usual, "symmetry", "elbow").caveat_key == PASSIVE_DRIVE


@pytest.mark.parametrize("lag_s", [0.0, 0.07, 0.15, 0.4])
def test_the_lag_between_the_arms_is_found(lag_s: float) -> None:
    metrics = session_metrics(record(lag_s=lag_s))
    for joint in ("plane", "elevation", "elbow"):
        assert value(metrics, "lag", joint) == pytest.approx(lag_s, abs=0.01)
        assert value(metrics, "symmetry", joint) == pytest.approx(1.0, abs=0.01)


def test_an_arm_that_does_half_the_movement_is_not_symmetric() -> None:
    t_s = np.arange(0, 60, 0.02)
    whole = np.sin(t_s)
    half = likeness([np.column_stack([whole, 0.5 * whole])])
    shifted = likeness([np.column_stack([whole, whole + 1.0])])
    assert half is not None
    assert shifted is not None
    assert half.symmetry == pytest.approx(0.8, abs=0.01)
    assert shifted.symmetry == pytest.approx(0.5, abs=0.02)


def test_an_arm_that_does_not_move_has_no_lag() -> None:
    assert likeness([np.column_stack([np.sin(np.arange(0, 60, 0.02)), np.zeros(3000)])]) is None


def test_time_is_kept_per_state(usual: tuple[Metric, ...]) -> None:
    assert value(usual, "time_ready") == pytest.approx(2.0, abs=0.02)
    assert value(usual, "time_engaged") == pytest.approx(38.0, abs=0.02)
    assert value(usual, "active_minutes") == pytest.approx(19 * 0.79 / 60, rel=0.05)


def test_a_hole_in_the_ticks_counts_for_no_state() -> None:
    whole = record()
    keep = (whole.t_s < 10) | (whole.t_s > 20)
    cut = replace(
        whole,
        t_s=whole.t_s[keep],
        state=whole.state[keep],
        healthy_rad=whole.healthy_rad[keep],
        healthy_valid=whole.healthy_valid[keep],
        affected_rad=whole.affected_rad[keep],
        hand_in_trunk=whole.hand_in_trunk[keep],
        trunk_displacement_m=whole.trunk_displacement_m[keep],
        shoulder_hitch_m=None,
    )
    assert value(session_metrics(cut), "time_engaged") == pytest.approx(28.0, abs=0.05)


def test_targets_trunk_and_sensors_are_reported(usual: tuple[Metric, ...]) -> None:
    assert value(usual, "targets_collected") == 9
    assert value(usual, "targets_missed") == 3
    assert value(usual, "success_rate") == 0.75
    assert value(usual, "trunk_displacement") == pytest.approx(0.0525, abs=0.001)
    assert value(usual, "trunk_displacement_p95") == pytest.approx(0.095, abs=0.001)
    assert value(usual, "shoulder_hitch_p95") == pytest.approx(0.0475, abs=0.001)
    assert value(usual, "sensor_frame_rate", "kinect-1") == 30.0
    assert value(usual, "sensor_residual", "kinect-1") == 0.02
    assert value(usual, "sensor_age_p95", "kinect-1") == pytest.approx(0.038)


@given(t=st.floats(-pi, pi))
def test_a_range_through_half_a_turn_is_no_jump(t: float) -> None:
    swing = t + 0.3 * np.sin(np.linspace(0, 20, 2000))
    low, high = angle_range((swing + pi) % (2 * pi) - pi)
    assert high - low == pytest.approx(0.6, abs=0.02)


def empty() -> SessionRecord:
    none = np.zeros(0)
    return SessionRecord(
        t_s=none,
        state=np.array([], dtype=str),
        healthy_side=Side.LEFT,
        healthy_rad=np.zeros((0, 4)),
        healthy_valid=np.zeros(0, dtype=bool),
        affected_rad=np.zeros((0, 4)),
        hand_in_trunk=np.zeros((0, 3)),
        trunk_displacement_m=none,
        sensors=(),
        hits=0,
        misses=0,
    )


def test_an_empty_session_has_no_figures() -> None:
    assert session_metrics(empty()) == ()


@given(seconds=st.floats(0.02, 3.0), missing=st.floats(0, 1), seed=st.integers(0, 99))
def test_no_figure_is_ever_a_nan(seconds: float, missing: float, seed: int) -> None:
    short = record(seconds)
    lost = np.random.default_rng(seed).random(len(short.t_s)) < missing
    short.hand_in_trunk[lost] = np.nan
    short.healthy_rad[lost] = np.nan
    short.trunk_displacement_m[lost] = np.nan
    assert all(isfinite(metric.value) for metric in session_metrics(replace(short, healthy_valid=~lost)))


def test_a_session_in_which_nothing_was_ever_driven_has_times_only() -> None:
    never = record()
    figures = session_metrics(replace(never, state=np.full(len(never.t_s), "hold"), hits=0, misses=0, sensors=()))
    assert {metric.name for metric in figures} == {"time_hold"}
