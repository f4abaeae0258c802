"""Laws of the set algebra: nothing that may be true is ever cut away."""

from __future__ import annotations

import numpy as np
from hypothesis import given, settings
from hypothesis import strategies as st

from fusion.estimation.ellipsoid import Ellipsoids, choose, cut, half_width, outer_sum

DIMENSION = 3
SEEDS = st.integers(0, 2**32 - 1)


def some_ellipsoids(rng: np.random.Generator, count: int = 20) -> Ellipsoids:
    """Of very different axes, metres beside centimetres."""
    axes = np.linalg.qr(rng.normal(size=(count, DIMENSION, DIMENSION)))[0]
    lengths = 10.0 ** rng.uniform(-2, 1, (count, DIMENSION))
    shape = np.einsum("nik,nk,njk->nij", axes, lengths**2, axes)
    return Ellipsoids(rng.normal(size=(count, DIMENSION)), shape)


def points_within(rng: np.random.Generator, body: Ellipsoids) -> np.ndarray:
    """One point per ellipsoid, as often on its skin as inside."""
    direction = rng.normal(size=body.centre.shape)
    direction /= np.linalg.norm(direction, axis=1, keepdims=True)
    share = np.minimum(rng.uniform(0, 2, (len(direction), 1)), 1.0)
    root = np.linalg.cholesky(body.shape)
    return body.centre + np.einsum("nij,nj->ni", root, share * direction)


def depth(body: Ellipsoids, points: np.ndarray) -> np.ndarray:
    """(x-c)' P^-1 (x-c), at most 1 inside."""
    away = points - body.centre
    return np.einsum("ni,ni->n", away, np.linalg.solve(body.shape, away[..., None])[..., 0])


@settings(derandomize=True, max_examples=60, deadline=None)
@given(seed=SEEDS)
def test_the_sum_holds_every_sum_of_members(seed: int) -> None:
    rng = np.random.default_rng(seed)
    body = some_ellipsoids(rng)
    second = some_ellipsoids(rng, 1).shape[0]
    addend = Ellipsoids(np.zeros_like(body.centre), np.broadcast_to(second, body.shape.shape))
    points = points_within(rng, body) + points_within(rng, addend)
    assert (depth(outer_sum(body, second), points) <= 1 + 1e-9).all()


@settings(derandomize=True, max_examples=100, deadline=None)
@given(seed=SEEDS)
def test_a_cut_keeps_every_member_that_is_in_the_strip(seed: int) -> None:
    rng = np.random.default_rng(seed)
    body = some_ellipsoids(rng)
    points = points_within(rng, body)
    normal = rng.normal(size=DIMENSION)
    half = 10.0 ** rng.uniform(-3, 1, len(points))
    middle = points @ normal + rng.uniform(-1, 1, len(points)) * half
    after, met = cut(body, normal, middle, half)
    assert met.all()
    assert (depth(after, points) <= 1 + 1e-6).all()


@settings(derandomize=True, max_examples=60, deadline=None)
@given(seed=SEEDS)
def test_a_cut_never_adds_volume_and_stays_positive_definite(seed: int) -> None:
    rng = np.random.default_rng(seed)
    body = some_ellipsoids(rng)
    middle = (points_within(rng, body)) @ (normal := rng.normal(size=DIMENSION))
    after, _ = cut(body, normal, middle, 10.0 ** rng.uniform(-4, 1, len(middle)))
    assert (np.linalg.slogdet(after.shape)[1] <= np.linalg.slogdet(body.shape)[1] + 1e-9).all()
    assert (np.linalg.eigvalsh(after.shape) > 0).all()


def test_a_strip_that_misses_leaves_the_set_and_says_so() -> None:
    body = Ellipsoids(np.zeros((1, 2)), np.eye(2)[None])
    after, met = cut(body, np.array([1.0, 0.0]), np.array([3.0]), np.array([1.5]))
    assert not met.any()
    np.testing.assert_array_equal(after.shape, body.shape)
    np.testing.assert_array_equal(after.centre, body.centre)


def test_a_strip_wider_than_the_set_changes_nothing() -> None:
    body = Ellipsoids(np.zeros((1, 2)), np.eye(2)[None])
    after, met = cut(body, np.array([1.0, 0.0]), np.array([0.2]), np.array([np.inf]))
    assert met.all()
    np.testing.assert_allclose(after.shape, body.shape)


def test_the_least_ellipse_around_a_centred_strip_of_the_unit_disc() -> None:
    """In the plane it has half-width √2 γ across the strip and √2 √(1-γ²)... at most √2 along it (John's ellipse)."""
    half = 0.1
    body = Ellipsoids(np.zeros((1, 2)), np.eye(2)[None])
    after, _ = cut(body, np.array([1.0, 0.0]), np.zeros(1), np.array([half]))
    width = half_width(after)[0]
    # The corners (γ, √(1-γ²)) lie on the skin of the least ellipse: x²/a² + y²/b² = 1 with each term one half.
    np.testing.assert_allclose(width, [half * np.sqrt(2), np.sqrt(2 * (1 - half**2))], rtol=1e-9)


def test_choose_takes_one_by_one() -> None:
    yes, no = (Ellipsoids(np.full((2, 2), value), np.stack([np.eye(2) * value] * 2)) for value in (1.0, 2.0))
    picked = choose(np.array([True, False]), yes, no)
    np.testing.assert_array_equal(picked.centre[:, 0], [1.0, 2.0])
    np.testing.assert_array_equal(picked.shape[:, 0, 0], [1.0, 2.0])
