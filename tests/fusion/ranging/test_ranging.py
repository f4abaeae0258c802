"""Laws of ranging: exact ranges give exact positions, biases cancel, blocked anchors are dropped, drift is bounded."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from fusion.errors import InputError
from fusion.ranging.calibration import calibrate, uncalibrated
from fusion.ranging.experiment import somebody_walks_around, walk_around_a_square
from fusion.ranging.inertial import Inertial, carried_on, joined, reset_if_worse
from fusion.ranging.links import growth, unknown_links
from fusion.ranging.locate import locate, require_solvable
from fusion.ranging.multilateration import solve_position
from fusion.ranging.pushes import integrated
from fusion.ranging.ranges import Ranges, gathered
from fusion.ranging.rig import Rig, learn_rig, turn
from fusion.ranging.self_calibration import self_calibrate
from fusion.ranging.two_anchors import choose, intersect
from fusion.ranging.two_way import LIGHT_M_S, TwoWayStamps, range_from_stamps

SQUARE = np.array([[-3.5, 3.0, 1.0], [3.6, 3.0, 1.1], [3.6, -3.0, 1.0], [-3.5, -3.0, 1.05], [0.0, 3.1, 1.0]])
ROOM = np.array([[-3.5, 3.0, 0.2], [3.6, 3.0, 2.4], [3.6, -3.0, 0.3], [-3.5, -3.0, 2.2], [0.0, 3.1, 1.2]])
inside = st.tuples(st.floats(-2.5, 2.5), st.floats(-2.5, 2.5), st.floats(0.5, 1.8))


def distances(anchors, positions):
    """(…, A)."""
    return np.linalg.norm(np.asarray(positions)[..., None, :] - anchors, axis=-1)


def walk(seconds=20.0, rate_hz=50.0):
    """Times, and a rig's tags (T, 3, 3) that walk and turn."""
    t_s = np.arange(0, seconds, 1 / rate_hz)
    middle = np.stack([1.5 * np.sin(0.5 * t_s), 1.2 * np.sin(0.37 * t_s + 1), np.full(len(t_s), 1.0)], axis=-1)
    offsets = np.array([[0.2, 0.0, 0.0], [-0.1, 0.15, 0.0], [-0.1, -0.15, 0.0]])
    return t_s, np.array([Rig(offsets).positions(m, 0.6 * np.sin(0.3 * t)) for t, m in zip(t_s, middle, strict=True)])


def measured(t_s, tags, noise_m=0.0, bias_m=0.0, anchors=SQUARE, seed=0):
    """Ranges of every tag to every anchor."""
    exact = np.moveaxis(distances(anchors, tags), 1, 2)  # (T, A, K)
    noise = np.random.default_rng(seed).normal(0, noise_m, exact.shape) if noise_m else 0.0
    return Ranges(anchors, t_s, exact + noise + bias_m)


# ---------------------------------------------------------------- stamps


@given(
    st.floats(0.1, 100), st.floats(-20e-6, 20e-6), st.floats(-1e3, 1e3), st.floats(1e-4, 5e-3), st.floats(1e-4, 5e-3)
)
def test_stamps_give_the_distance_whatever_the_clocks_offset_and_rate(range_m, rate, offset_s, reply_1, reply_2):
    flight = range_m / LIGHT_M_S
    t = np.cumsum([0.0, flight, reply_1, flight, reply_2, flight])
    other = (t * (1 + rate)) + offset_s * 1e-6
    stamps = TwoWayStamps(t[0], other[1], other[2], t[3], t[4], other[5])
    assert range_from_stamps(stamps) == pytest.approx(range_m, abs=1e-3 + range_m * 3e-5)


def test_stamps_that_run_backwards_are_refused():
    with pytest.raises(InputError, match="forward"):
        range_from_stamps(TwoWayStamps(0.0, 1.0, 0.9, 2.0, 2.1, 3.0))


# ---------------------------------------------------------------- single positions


@settings(max_examples=30)
@given(inside)
def test_exact_ranges_give_the_exact_position_in_the_plane_and_in_the_room(point):
    flat = solve_position(SQUARE[:3], distances(SQUARE[:3], point), 0.1, height_m=point[2])
    whole = solve_position(ROOM, distances(ROOM, point), 0.1)
    np.testing.assert_allclose(flat.position, point, atol=1e-5)
    np.testing.assert_allclose(whole.position, point, atol=1e-4)


@settings(max_examples=20)
@given(inside, st.integers(0, 4), st.floats(0.6, 3.0))
def test_a_blocked_anchor_is_dropped_and_the_position_is_that_of_the_others(point, blocked, longer_m):
    ranges_m = distances(SQUARE, point)
    ranges_m[blocked] += longer_m
    fix = solve_position(SQUARE, ranges_m, 0.02, height_m=point[2])
    np.testing.assert_allclose(fix.position, point, atol=1e-2)
    assert not fix.used[blocked]


def test_three_anchors_that_disagree_give_no_position():
    ranges_m = np.add(distances(SQUARE[:3], [0.0, 0.0, 1.0]), [0, 0, 2.0])
    assert solve_position(SQUARE[:3], ranges_m, 0.1, height_m=1.0) is None


@given(inside)
def test_one_of_two_anchors_crossings_is_the_position_and_the_prediction_finds_it(point):
    candidates = intersect(SQUARE[:2], distances(SQUARE[:2], point), point[2])
    assert np.linalg.norm(candidates - point, axis=1).min() < 1e-5
    near = np.add(point, [0.02, 0.02, 0.0])
    np.testing.assert_allclose(choose(candidates, near, near, 0.2, 0.2), point, atol=1e-5)
    assert choose(candidates, near + 1.0, near, 0.2, 0.2) is None


# ---------------------------------------------------------------- the inertial join


@settings(max_examples=10)
@given(st.floats(0.01, 0.2), st.floats(-0.04, 0.04), st.integers(0, 5))
def test_drift_stays_bounded_while_the_radio_is_good(radio_sigma_m, accel_bias, seed):
    rng = np.random.default_rng(seed)
    inertial, dt_s, worst = Inertial(np.zeros(3), np.zeros(3)), 0.02, 0.0
    for _ in range(3000):
        inertial = carried_on(inertial, np.full(3, accel_bias), dt_s)
        position = joined(rng.normal(0, radio_sigma_m / 10, 3), radio_sigma_m, inertial)
        inertial = reset_if_worse(inertial, radio_sigma_m, position)
        worst = max(worst, np.abs(inertial.position).max())
        assert inertial.sigma_m <= radio_sigma_m + 0.05 * dt_s * (inertial.since_reset_s + dt_s)
    assert worst < 6 * radio_sigma_m


@given(st.floats(0.01, 1), st.floats(0.1, 5))
def test_the_join_lies_between_both_and_nearer_to_the_surer(sigma_m, since_s):
    inertial = Inertial(np.ones(3), np.zeros(3), since_s)
    x = joined(np.zeros(3), sigma_m, inertial)[0]
    assert 0 <= x <= 1
    assert (x > 0.5) == (inertial.sigma_m < sigma_m) or x == pytest.approx(0.5)


def rms_m(found, outcome):
    return float(np.sqrt(np.mean(np.sum((found - outcome.truth) ** 2, axis=1))))


def test_standing_at_the_middle_the_join_halves_what_somebody_walking_around_does():
    for seed in range(3):
        outcome = somebody_walks_around(seed)
        assert rms_m(outcome.joined, outcome) < 0.6 * rms_m(outcome.radio_alone, outcome)
        assert rms_m(outcome.mended, outcome) < 0.2 * rms_m(outcome.radio_alone, outcome)
        assert np.abs(outcome.joined - outcome.truth).max() < 0.25


def test_around_the_square_honest_variances_mend_what_the_papers_rule_makes_worse():
    for seed in range(2):
        outcome = walk_around_a_square(seed)
        assert rms_m(outcome.joined, outcome) > rms_m(outcome.radio_alone, outcome)
        assert rms_m(outcome.mended, outcome) < 0.4 * rms_m(outcome.radio_alone, outcome)


@settings(max_examples=20)
@given(st.floats(-3, 3), st.floats(-3, 3), st.floats(0.3, 3.0))
def test_pushes_are_the_displacement_beyond_what_the_velocity_at_the_beginning_does(ax, ay, dt_s):
    t_s = np.arange(0, 10, 0.01)
    constant = integrated(t_s, np.tile([ax, ay, 0.0], (len(t_s), 1)))
    push = constant.between(4.0, 4.0 + dt_s)
    np.testing.assert_allclose(push.velocity_m_s, [ax * dt_s, ay * dt_s, 0.0], atol=1e-9)
    np.testing.assert_allclose(push.displacement_m, np.array([ax, ay, 0.0]) * dt_s**2 / 2, atol=1e-4)
    assert constant.between(9.0, 11.0) is None


@settings(max_examples=5)
@given(st.floats(-3, 3))
def test_the_sensors_heading_is_found_from_nothing_and_carries_the_track_through_a_blackout(heading_rad):
    t_s, tags = walk(20.0)
    ranges = measured(t_s, tags[:, :1], noise_m=0.03)
    ranges.range_m[800:875] = np.nan
    accel = np.gradient(np.gradient(tags[:, 0], t_s, axis=0), t_s, axis=0) @ turn(heading_rad)
    pushed, alone = (
        locate(ranges, uncalibrated(ranges), height_m=1.0, inertial=[beside]).positions[800:875, 0] - tags[800:875, 0]
        for beside in (integrated(t_s, accel), None)
    )
    assert np.abs(pushed).max() < 0.15
    assert np.abs(pushed).max() < 0.5 * np.abs(alone).max()


@settings(max_examples=5)
@given(st.floats(0.02, 0.08), st.floats(-0.03, 0.03))
def test_what_grows_with_distance_is_learnt_by_all_links_together(slope_m, bend_m):
    t_s, tags = walk(12.0)
    exact = measured(t_s, tags)
    grown = replace(exact, range_m=exact.range_m + growth(exact.range_m) @ [slope_m, bend_m])
    learnt = calibrate(grown, t_s, tags)
    at_m = np.array([1.5, 3.5, 5.5])
    found = growth(at_m) @ learnt.links.growth_m
    np.testing.assert_allclose(found - found[1], growth(at_m) @ [slope_m, bend_m], atol=0.02)


@given(st.floats(0.01, 0.2), st.floats(0.05, 1.0), st.floats(1e-3, 10.0))
def test_a_range_soon_after_another_counts_less_and_one_long_after_counts_whole(sigma_m, coherence_s, since_s):
    links = replace(unknown_links(1, 1), sigma_m=sigma_m, coherence_s=coherence_s)
    phi = np.exp(-since_s / coherence_s)
    assert links.variance_m2(since_s) == pytest.approx(sigma_m**2 * (1 + phi) / (1 - phi))
    assert links.variance_m2(np.inf) == pytest.approx(sigma_m**2)


# ---------------------------------------------------------------- the rig, calibration and the filter


@settings(max_examples=10)
@given(st.floats(-3, 3), inside)
def test_a_rig_is_learnt_and_its_pose_found_again(yaw, middle):
    _, tags = walk(5.0)
    rig = learn_rig(tags)
    there = rig.positions(np.array(middle), yaw)
    found, turned = rig.pose(there)
    np.testing.assert_allclose(rig.positions(found, turned), there, atol=1e-9)
    np.testing.assert_allclose(turn(turned), turn(yaw), atol=1e-9)


def test_tags_that_move_on_their_own_are_no_rig():
    t_s, tags = walk(5.0)
    tags[:, 1, 0] += 0.1 * np.sin(t_s)
    assert learn_rig(tags) is None


@settings(max_examples=3)
@given(st.lists(st.floats(-0.1, 0.4), min_size=5, max_size=5), st.sampled_from([0.0, 0.06]))
def test_constant_biases_and_a_lag_make_no_difference_after_calibration(biases, lag_s):
    t_s, tags = walk(12.0)
    ranges = measured(t_s, tags, bias_m=np.array(biases)[:, None])
    learnt = calibrate(ranges.between(0.0, 10.0), t_s[t_s < 10] + lag_s, tags[t_s < 10])
    assert learnt.lag_s == pytest.approx(lag_s, abs=0.02)
    # A bias that is unlike its neighbours is thought a little smaller, and the rest of the model makes up for it.
    np.testing.assert_allclose(learnt.links.bias_m, np.tile(biases, (3, 1)).T, atol=0.05)
    track = locate(ranges, learnt, height_m=1.0)
    assert np.linalg.norm(track.positions - tags, axis=-1)[50:].max() < 0.05


def test_a_blocked_anchor_does_not_move_the_track_and_the_truth_stays_in_the_bound():
    t_s, tags = walk(12.0)
    ranges = measured(t_s, tags, noise_m=0.05)
    ranges.range_m[300:450, 2] += 1.0
    track = locate(ranges, calibrate(ranges.between(0.0, 5.0), t_s[t_s < 5], tags[t_s < 5]), height_m=1.0)
    off = np.linalg.norm(track.positions - tags, axis=-1)
    assert off[300:450].max() < 0.1
    assert (track.anchors_used[310:450] <= 4).all()
    assert (off <= track.bound_m).mean() >= 0.99


def test_nothing_of_the_future_is_used():
    t_s, tags = walk(4.0)
    ranges = measured(t_s, tags, noise_m=0.05)
    whole = locate(ranges, uncalibrated(ranges), height_m=1.0)
    cut = locate(ranges.between(0.0, 2.0), uncalibrated(ranges), height_m=1.0)
    np.testing.assert_array_equal(whole.positions[: len(cut.t_s)], cut.positions)


def test_the_bound_grows_while_nothing_is_in_sight_and_the_track_returns():
    t_s, tags = walk(8.0)
    ranges = measured(t_s, tags, noise_m=0.03)
    ranges.range_m[150:250] = np.nan
    track = locate(ranges, uncalibrated(ranges), height_m=1.0)
    assert (track.bound_m[249] > 1.5 * track.bound_m[149]).all()
    off = np.linalg.norm(track.positions - tags, axis=-1)
    assert (off <= track.bound_m).all()
    assert off[300:].max() < 0.15


def test_tags_are_located_in_the_room_without_a_height_where_anchors_are_not_flat():
    t_s, tags = walk(4.0)
    ranges = measured(t_s, tags, noise_m=0.02, anchors=ROOM)
    track = locate(ranges, uncalibrated(ranges))
    assert np.linalg.norm(track.positions - tags, axis=-1)[100:].max() < 0.1


def test_biases_are_found_without_any_truth():
    t_s, tags = walk(20.0)
    biases = np.array([0.1, 0.3, 0.2, 0.15, 0.25])[:, None]
    learnt = self_calibrate(measured(t_s, tags, noise_m=0.02, bias_m=biases), 1.0)
    np.testing.assert_allclose(learnt.links.bias_m, np.tile(biases, (1, 3)), atol=0.03)
    with pytest.raises(InputError, match="three anchors"):
        self_calibrate(measured(t_s, tags, anchors=SQUARE[:3]), 1.0)


def test_single_ranges_are_gathered_by_instant():
    ranges = gathered(SQUARE, 2, np.array([1.0, 0.0, 1.0]), np.array([2, 0, 3]), np.array([0, 1, 1]), np.arange(3.0))
    np.testing.assert_array_equal(ranges.t_s, [0.0, 1.0])
    assert (ranges.range_m[1, 2, 0], ranges.range_m[0, 0, 1], ranges.range_m[1, 3, 1]) == (0.0, 1.0, 2.0)
    assert np.isfinite(ranges.range_m).sum() == 3


@pytest.mark.parametrize(
    ("anchors", "height_m", "says"),
    [
        (SQUARE[:2], 1.0, "too few"),
        (SQUARE[:3], None, "one plane"),
        (np.column_stack([SQUARE[:, :2], np.ones(5)]), None, "one plane"),
        (np.array([[0.0, 0, 1], [1, 1, 1], [2, 2, 1]]), 1.0, "one line"),
    ],
)
def test_anchors_that_cannot_tell_are_refused_in_words(anchors, height_m, says):
    with pytest.raises(InputError, match=says):
        require_solvable(anchors, height_m)
