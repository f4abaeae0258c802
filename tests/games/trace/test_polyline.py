"""Laws of a line through space: nearest places, even spacing, rounded corners."""

from __future__ import annotations

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from games.trace.polyline import Polyline, evenly, polyline, rounded

coordinates = st.floats(-1.0, 1.0)
places = st.tuples(coordinates, coordinates, coordinates)


def drawn(seed: int, count: int = 12) -> Polyline:
    return polyline(np.random.default_rng(seed).normal(size=(count, 3)))


@given(seed=st.integers(0, 999), place=places, ends=st.tuples(st.floats(0, 1), st.floats(0, 1)))
def test_the_nearest_place_is_on_the_part_asked_and_nearer_than_any_other(seed, place, ends) -> None:
    line = drawn(seed)
    from_m, to_m = (share * line.length_m for share in sorted(ends))
    along_m, away_m = line.nearest(place, from_m, to_m)
    assert from_m - 1e-9 <= along_m <= to_m + 1e-9
    assert away_m == pytest.approx(float(np.linalg.norm(np.subtract(line.at(along_m), place))), abs=1e-9)
    others = [line.at(m) for m in np.linspace(from_m, to_m, 50)]
    assert away_m <= min(float(np.linalg.norm(np.subtract(other, place))) for other in others) + 1e-9


@given(seed=st.integers(0, 999), share=st.floats(0.05, 1.0))
def test_an_even_line_is_as_long_as_asked_and_no_piece_is_longer_than_another_by_much(seed, share) -> None:
    line = drawn(seed)
    even = evenly(line, share * line.length_m, 0.02)
    assert even.length_m <= share * line.length_m + 1e-9
    assert even.length_m > 0.9 * share * line.length_m
    assert np.diff(even.reached_m).max() < 0.025


def test_a_line_ends_where_asked_or_at_its_own_end() -> None:
    straight = polyline(np.array([[0.0, 0.0, 0.0], [1.0, 0.0, 0.0]]))
    assert evenly(straight, 0.4, 0.1).at(9.0) == pytest.approx((0.4, 0.0, 0.0))
    assert evenly(straight, 4.0, 0.1).length_m == pytest.approx(1.0)
    assert straight.winding == pytest.approx(1.0)


@given(seed=st.integers(0, 999), corners=st.integers(3, 7))
def test_rounding_keeps_the_ends_and_stays_within_what_the_corners_span(seed, corners) -> None:
    points = np.random.default_rng(seed).normal(size=(corners, 4))
    smooth = rounded(points, 4)
    np.testing.assert_allclose(smooth[[0, -1]], points[[0, -1]])
    assert (smooth.min(axis=0) >= points.min(axis=0) - 1e-12).all()
    assert (smooth.max(axis=0) <= points.max(axis=0) + 1e-12).all()
    assert len(smooth) > 5 * corners


def test_rounding_leaves_no_corner_sharp() -> None:
    smooth = rounded(np.array([[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [1.0, 1.0, 0.0]]), 4)
    steps = np.diff(smooth, axis=0)
    units = steps / np.linalg.norm(steps, axis=1, keepdims=True)
    assert np.arccos(np.clip((units[:-1] * units[1:]).sum(axis=1), -1, 1)).max() < np.radians(15)
