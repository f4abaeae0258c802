"""The strips in the room hold every point of the box in range, azimuth and elevation."""

from __future__ import annotations

import numpy as np
from hypothesis import given, settings
from hypothesis import strategies as st
from scipy.spatial.transform import Rotation

from fusion.estimation.error_box import half_width_in_room
from fusion.estimation.vectors import Vector

COUNT = 25


def vector(a: np.ndarray) -> Vector:
    return (float(a[0]), float(a[1]), float(a[2]))


def spherical(points: np.ndarray) -> np.ndarray:
    """Range, azimuth, elevation."""
    r = np.linalg.norm(points, axis=1)
    return np.stack([r, np.arctan2(points[:, 0], points[:, 2]), np.arcsin(points[:, 1] / r)], axis=1)


def cartesian(ray: np.ndarray) -> np.ndarray:
    r, azimuth, elevation = ray.T
    flat = r * np.cos(elevation)
    return np.stack([flat * np.sin(azimuth), r * np.sin(elevation), flat * np.cos(azimuth)], axis=1)


@settings(derandomize=True, max_examples=100, deadline=None)
@given(seed=st.integers(0, 2**32 - 1))
def test_every_point_of_the_box_is_within_the_strips(seed: int) -> None:
    rng = np.random.default_rng(seed)
    rotation = np.array(Rotation.random(random_state=seed % 2**31).as_matrix(), order="C")
    in_sensor = rng.uniform((-1.5, -1.0, 0.8), (1.5, 1.0, 4.5), (COUNT, 3))
    half_m = rng.uniform(0.02, 0.6, (COUNT, 3))
    ray = spherical(in_sensor)
    flat = ray[:, 0] * np.cos(ray[:, 2])
    half_ray = half_m / np.stack([np.ones(COUNT), flat, ray[:, 0]], axis=1)
    off = np.sign(rng.normal(size=ray.shape)) * np.minimum(rng.uniform(0, 2, ray.shape), 1.0)  # corners most of all
    measured = in_sensor @ rotation.T  # from the lens
    true = cartesian(ray + off * half_ray) @ rotation.T
    half_room = np.array(
        [half_width_in_room(vector(a), rotation, vector(h)) for a, h in zip(measured, half_m, strict=True)]
    )
    assert (np.abs(true - measured) <= half_room + 1e-9).all()


def test_a_small_box_in_front_of_the_lens_is_hardly_widened() -> None:
    half = half_width_in_room((0.0, 0.0, 2.5), np.eye(3), (0.05, 0.04, 0.03))
    np.testing.assert_allclose(half, (0.04, 0.03, 0.05), rtol=0.03)  # across is x, up is y, range is z


def test_a_point_in_the_lens_itself_gives_finite_strips() -> None:
    half = half_width_in_room((0.0, 0.0, 0.0), np.eye(3), (0.2, 0.2, 0.2))
    assert np.isfinite(half).all()
    assert min(half) > 0
