"""Laws of the set algebra: nothing that may be true is ever cut away."""

from __future__ import annotations

import numpy as np
from hypothesis import given, settings
from hypothesis import strategies as st

from fusion.estimation.ellipse import Ellipse, cut, outer_sum

COUNT = 20
SEEDS = st.integers(0, 2**32 - 1)


def an_ellipse(rng: np.random.Generator) -> Ellipse:
    """Of very different axes, metres beside centimetres."""
    turn = np.linalg.qr(rng.normal(size=(2, 2)))[0]
    shape = turn @ np.diag(10.0 ** rng.uniform(-2, 1, 2)) ** 2 @ turn.T
    return ellipse(rng.normal(size=2), shape)


def ellipse(centre: np.ndarray, shape: np.ndarray) -> Ellipse:
    return Ellipse(*(float(x) for x in (*centre, shape[0, 0], shape[0, 1], shape[1, 1])))


def centre_of(body: Ellipse) -> np.ndarray:
    return np.array([body.p, body.v])


def shape_of(body: Ellipse) -> np.ndarray:
    return np.array([[body.pp, body.pv], [body.pv, body.vv]])


def a_point_of(rng: np.random.Generator, body: Ellipse) -> np.ndarray:
    """As often on its skin as inside."""
    direction = rng.normal(size=2)
    share = min(rng.uniform(0, 2), 1.0)
    return centre_of(body) + np.linalg.cholesky(shape_of(body)) @ (share * direction / np.linalg.norm(direction))


def depth(body: Ellipse, point: np.ndarray) -> float:
    """(x-c)' P^-1 (x-c), at most 1 inside."""
    away = point - centre_of(body)
    return float(away @ np.linalg.solve(shape_of(body), away))


def cut_by(body: Ellipse, normal: np.ndarray, middle: float, half: float) -> tuple[Ellipse, bool]:
    return cut(body, (float(normal[0]), float(normal[1])), float(middle), float(half))


@settings(derandomize=True, max_examples=60, deadline=None)
@given(seed=SEEDS)
def test_the_sum_holds_every_sum_of_members(seed: int) -> None:
    rng = np.random.default_rng(seed)
    for _ in range(COUNT):
        body, addend = an_ellipse(rng), an_ellipse(rng)
        point = a_point_of(rng, body) + a_point_of(rng, addend) - centre_of(addend)
        assert depth(outer_sum(body, addend.pp, addend.pv, addend.vv), point) <= 1 + 1e-9


@settings(derandomize=True, max_examples=100, deadline=None)
@given(seed=SEEDS)
def test_a_cut_keeps_every_member_that_is_in_the_strip(seed: int) -> None:
    rng = np.random.default_rng(seed)
    for _ in range(COUNT):
        body, normal, half = an_ellipse(rng), rng.normal(size=2), 10.0 ** rng.uniform(-3, 1)
        point = a_point_of(rng, body)
        after, met = cut_by(body, normal, point @ normal + rng.uniform(-1, 1) * half, half)
        assert met
        assert depth(after, point) <= 1 + 1e-6


@settings(derandomize=True, max_examples=60, deadline=None)
@given(seed=SEEDS)
def test_a_cut_never_adds_area_and_stays_positive_definite(seed: int) -> None:
    rng = np.random.default_rng(seed)
    for _ in range(COUNT):
        body, normal = an_ellipse(rng), rng.normal(size=2)
        after, _ = cut_by(body, normal, a_point_of(rng, body) @ normal, 10.0 ** rng.uniform(-4, 1))
        before_log, after_log = (np.linalg.slogdet(shape_of(each))[1] for each in (body, after))
        assert after_log <= before_log + 1e-9
        assert (np.linalg.eigvalsh(shape_of(after)) > 0).all()


def test_a_strip_that_misses_leaves_the_set_and_says_so() -> None:
    body = Ellipse(0.0, 0.0, 1.0, 0.0, 1.0)
    after, met = cut(body, (1.0, 0.0), 3.0, 1.5)
    assert not met
    assert after == body


def test_a_strip_wider_than_the_set_changes_nothing() -> None:
    body = Ellipse(0.0, 0.0, 1.0, 0.0, 1.0)
    after, met = cut(body, (1.0, 0.0), 0.2, np.inf)
    assert met
    np.testing.assert_allclose(after, body)


def test_the_least_ellipse_around_a_centred_strip_of_the_unit_disc() -> None:
    """In the plane it has half-width √2 γ across the strip and √2 √(1-γ²)... at most √2 along it (John's ellipse)."""
    half = 0.1
    after, _ = cut(Ellipse(0.0, 0.0, 1.0, 0.0, 1.0), (1.0, 0.0), 0.0, half)
    # The corners (γ, √(1-γ²)) lie on the skin of the least ellipse: x²/a² + y²/b² = 1 with each term one half.
    np.testing.assert_allclose([after.pp, after.vv], [2 * half**2, 2 * (1 - half**2)], rtol=1e-9)
