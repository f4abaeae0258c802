"""Laws of twists and rigid motions, over many of them."""

import numpy as np
from hypothesis import given
from hypothesis import strategies as st
from numpy.testing import assert_allclose
from scipy.linalg import expm

from fusion.inertial.lie import exp_se3, inverse, log_se3, moved, revolute_twist

numbers = st.floats(-2.0, 2.0)
vectors = st.tuples(numbers, numbers, numbers).map(np.array)
twists = st.tuples(vectors, vectors.map(lambda v: v * 0.9)).map(lambda parts: np.concatenate(parts)[None])
axes = vectors.filter(lambda v: np.linalg.norm(v) > 0.1).map(lambda v: v / np.linalg.norm(v))
angles = st.floats(-3.0, 3.0)


def hat(twist: np.ndarray) -> np.ndarray:
    v, (x, y, z) = twist[:3], twist[3:]
    return np.array([[0, -z, y, v[0]], [z, 0, -x, v[1]], [-y, x, 0, v[2]], [0, 0, 0, 0]])


@given(twists)
def test_exp_is_the_matrix_exponential(twist: np.ndarray) -> None:
    assert_allclose(exp_se3(twist)[0], expm(hat(twist[0])), atol=1e-12)


@given(twists)
def test_log_undoes_exp_below_half_a_turn(twist: np.ndarray) -> None:
    if np.linalg.norm(twist[0, 3:]) < 3.1:
        assert_allclose(log_se3(exp_se3(twist)), twist, atol=1e-9)


@given(twists, st.sampled_from([0.0, 1e-12, 1e-8, 0.99e-4, 1.01e-4]))
def test_small_turns_lose_no_digits(twist: np.ndarray, size: float) -> None:
    small = np.concatenate([twist[:, :3], twist[:, 3:] * size], axis=1)
    assert_allclose(exp_se3(small)[0], expm(hat(small[0])), atol=1e-14)


@given(twists, twists, twists)
def test_rigid_motions_are_a_group(a: np.ndarray, b: np.ndarray, c: np.ndarray) -> None:
    one, two, three = exp_se3(a), exp_se3(b), exp_se3(c)
    product = one @ two
    rotation = product[0, :3, :3]
    assert_allclose(rotation @ rotation.T, np.eye(3), atol=1e-12)
    assert_allclose(np.linalg.det(rotation), 1.0)
    assert_allclose(product[0, 3], [0, 0, 0, 1])
    assert_allclose((one @ two) @ three, one @ (two @ three), atol=1e-12)
    assert_allclose(one @ inverse(one), np.eye(4)[None], atol=1e-12)
    assert_allclose(inverse(one), exp_se3(-a), atol=1e-12)


@given(axes, vectors, angles, angles)
def test_turns_about_one_axis_add_up(axis: np.ndarray, centre: np.ndarray, first: float, second: float) -> None:
    twist = revolute_twist(axis, centre)[None]
    assert_allclose(exp_se3(twist * first) @ exp_se3(twist * second), exp_se3(twist * (first + second)), atol=1e-12)


@given(axes, vectors, angles, numbers)
def test_a_hinge_leaves_its_axis_where_it_is(axis: np.ndarray, centre: np.ndarray, angle: float, along: float) -> None:
    motion = exp_se3(angle * revolute_twist(axis, centre)[None])
    point = centre + along * axis
    assert_allclose(moved(motion, point)[0], point, atol=1e-12)


@given(twists, vectors, vectors)
def test_rigid_motions_keep_distances(twist: np.ndarray, one: np.ndarray, other: np.ndarray) -> None:
    motion = exp_se3(twist)
    apart = np.linalg.norm(moved(motion, one) - moved(motion, other))
    assert_allclose(apart, np.linalg.norm(one - other), atol=1e-12)
