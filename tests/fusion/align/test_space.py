"""Laws of the mounting: exact at any angle, equivariant, robust, and a recursion whose order does not matter."""

from __future__ import annotations

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from scipy.spatial.transform import Rotation

from fusion.align.space import Moments, fit_robustly, mounting, swapped_frames
from fusion.align.track import Pairs, pair
from fusion.geometry import rotation_angle_rad
from fusion.skeleton import SIDES_SWAPPED

TIMES = np.arange(0.0, 6.0, 1 / 15)
LAWS = settings(max_examples=25, deadline=None, derandomize=True)
turns = (
    st.tuples(*[st.floats(-1, 1)] * 3)
    .filter(lambda v: np.linalg.norm(v) > 0.1)
    .flatmap(
        lambda axis: st.floats(-np.pi, np.pi).map(
            lambda a: Rotation.from_rotvec(np.array(axis) / np.linalg.norm(axis) * a)
        )
    )
)
places = st.tuples(*[st.floats(-3, 3)] * 3).map(np.array)


@pytest.fixture(scope="session")
def seen_by(bodies):
    """Pairs of the reference and a sensor mounted anyhow."""

    def make(rotation, translation, noise_m=0.0):
        reference = bodies.track(TIMES, noise_m=noise_m, seed=1)
        return pair(reference, bodies.track(TIMES, rotation, translation, noise_m=noise_m, seed=2), 0.0)

    return make


def off(fit, rotation, translation):
    """Angle (rad) and distance at the body (m) from the true mounting."""
    body = np.array([0.0, 0.0, 2.4])
    sensor = rotation.inv().apply(body - translation)
    there = fit.mounting.rotation @ sensor + fit.mounting.translation_m
    return rotation_angle_rad(fit.mounting.rotation.T @ rotation.as_matrix()), float(np.linalg.norm(there - body))


@LAWS
@given(turns, places)
def test_exact_at_any_angle_on_clean_data(seen_by, rotation, translation):
    angle, distance = off(fit_robustly(seen_by(rotation, translation)), rotation, translation)
    assert angle < 1e-5
    assert distance < 1e-5


@LAWS
@given(turns, places)
def test_moving_the_sensor_moves_the_mounting_and_nothing_else(seen_by, rotation, translation):
    pairs = seen_by(Rotation.from_euler("y", 1.5), np.array([2.0, 0.1, 2.0]), noise_m=0.02)
    moved = Pairs(
        pairs.reference, rotation.apply(pairs.sensor.reshape(-1, 3)).reshape(pairs.sensor.shape) + translation,
        pairs.velocity, pairs.weight,
    )  # fmt: skip
    before, after = fit_robustly(pairs), fit_robustly(moved)
    turned = after.mounting.rotation @ rotation.as_matrix()
    assert rotation_angle_rad(turned.T @ before.mounting.rotation) < 1e-4
    assert after.residual_m == pytest.approx(before.residual_m, rel=1e-3)


@LAWS
@given(st.integers(0, 10_000), st.floats(0.0, 0.3), st.floats(0.0, 0.3))
def test_a_third_of_the_frames_swapped_and_a_third_of_the_joints_lost_change_little(seen_by, seed, swaps, losses):
    rotation, translation = Rotation.from_euler("yx", [1.6, 0.2]), np.array([2.2, 0.1, 2.0])
    pairs = seen_by(rotation, translation, noise_m=0.02)
    chance = np.random.default_rng(seed)
    sensor = pairs.sensor.copy()
    exchanged = chance.random(len(pairs)) < swaps
    sensor[exchanged] = sensor[exchanged][:, SIDES_SWAPPED]
    lost = chance.random(pairs.weight.shape) < losses
    sensor[lost] += chance.normal(0, 1.0, (int(lost.sum()), 3))
    fit = fit_robustly(Pairs(pairs.reference, sensor, pairs.velocity, pairs.weight))
    angle, distance = off(fit, rotation, translation)
    assert np.degrees(angle) < 1.0
    assert distance < 0.01


def test_swapped_frames_are_named(seen_by):
    pairs = seen_by(Rotation.from_euler("y", 1.5), np.array([2.0, 0.0, 2.0]), noise_m=0.02)
    sensor = pairs.sensor.copy()
    sensor[10:20] = sensor[10:20][:, SIDES_SWAPPED]
    mixed = Pairs(pairs.reference, sensor, pairs.velocity, pairs.weight)
    found = swapped_frames(mixed, fit_robustly(mixed).mounting)
    assert found[10:20].all()
    assert not np.delete(found, np.arange(10, 20)).any()


@LAWS
@given(st.permutations(range(6)))
def test_the_order_of_the_recursion_does_not_matter(seen_by, order):
    pairs = seen_by(Rotation.from_euler("y", -1.2), np.array([-1.5, 0.3, 1.0]), noise_m=0.03)
    blocks = np.array_split(np.arange(len(pairs)), 6)

    def sums(index):
        return Moments.of(
            pairs.reference[index].reshape(-1, 3), pairs.sensor[index].reshape(-1, 3), pairs.weight[index].ravel()
        )

    summed = Moments.nothing()
    for k in order:
        summed = summed.joined(sums(blocks[k]))
    at_once, recursive = mounting(sums(np.arange(len(pairs)))), mounting(summed)
    np.testing.assert_allclose(recursive.rotation, at_once.rotation, atol=1e-10)
    np.testing.assert_allclose(recursive.translation_m, at_once.translation_m, atol=1e-10)
    assert recursive.rotation_std_rad == pytest.approx(at_once.rotation_std_rad, rel=1e-6)


def test_fading_halves_the_weight_and_keeps_the_answer(seen_by):
    pairs = seen_by(Rotation.from_euler("y", 1.0), np.array([1.0, 0.0, 1.0]), noise_m=0.03)
    sums = fit_robustly(pairs).moments(pairs)
    faded = sums.faded(0.5)
    assert faded.weight == pytest.approx(0.5 * sums.weight)
    np.testing.assert_allclose(mounting(faded).rotation, mounting(sums).rotation, atol=1e-12)
    assert mounting(faded).rotation_std_rad > mounting(sums).rotation_std_rad


def test_no_point_at_all_determines_nothing():
    assert mounting(Moments.nothing()).rotation_std_rad == np.inf


def test_the_stated_deviation_covers_the_error(seen_by):
    rotation, translation = Rotation.from_euler("y", 1.5), np.array([2.0, 0.0, 2.0])
    fit = fit_robustly(seen_by(rotation, translation, noise_m=0.03))
    angle, distance = off(fit, rotation, translation)
    assert angle < 3 * fit.mounting.rotation_std_rad < np.radians(5.0)
    assert distance < 3 * fit.mounting.position_std_m < 0.05
