"""Alignment is equivariant: move the reference's frame, the sensor's, or both, and the mounting moves with them."""

from __future__ import annotations

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from scipy.spatial.transform import Rotation

from fusion.align.space_time import refine
from fusion.align.track import BodyTrack
from fusion.geometry import rotation_angle_rad
from fusion.skeleton import SIDES_SWAPPED

TIMES = np.arange(0.0, 4.0, 1 / 15)
OFFSET_S = 0.12
rigid = st.tuples(st.tuples(*[st.floats(-3, 3)] * 3), st.tuples(*[st.floats(-4, 4)] * 3)).map(
    lambda parts: (Rotation.from_rotvec(parts[0]), np.array(parts[1]))
)
STILL = (Rotation.identity(), np.zeros(3))


@pytest.fixture(scope="session")
def tracks(bodies):
    """Reference and sensor, with noise, a share of frames with exchanged sides, and of joints gone astray."""
    rng = np.random.default_rng(4)
    reference = bodies.track(TIMES, noise_m=0.02, seed=1)
    sensor = bodies.track(TIMES, Rotation.from_euler("yx", [1.5, 0.2]), (2.0, 0.1, 2.0), OFFSET_S, noise_m=0.02, seed=2)
    positions = sensor.positions.copy()
    positions[20:28] = positions[20:28][:, SIDES_SWAPPED]
    astray = rng.random(positions.shape[:2]) < 0.1
    positions[astray] += rng.normal(0, 0.5, (int(astray.sum()), 3))
    return reference, BodyTrack(sensor.t_s, positions, sensor.state)


def moved(track, rotation, shift):
    there = rotation.apply(track.positions.reshape(-1, 3)).reshape(track.positions.shape) + shift
    return BodyTrack(track.t_s, there, track.state)


@settings(max_examples=12)
@given(of_reference=st.just(STILL) | rigid, of_sensor=st.just(STILL) | rigid)
def test_the_mounting_moves_with_the_frames_and_the_clock_does_not(tracks, of_reference, of_sensor):
    """With G of the reference's frame and H of the sensor's, R becomes G R H⁻¹; T, clock and residual follow."""
    plain = refine(*tracks, OFFSET_S + 0.01, 6)
    other = refine(moved(tracks[0], *of_reference), moved(tracks[1], *of_sensor), OFFSET_S + 0.01, 6)
    turned = of_reference[0].as_matrix() @ plain.rotation_sensor_to_reference @ of_sensor[0].inv().as_matrix()
    assert rotation_angle_rad(turned.T @ other.rotation_sensor_to_reference) < 1e-4
    seen = tracks[1].positions[10]
    expected = of_reference[0].apply(plain.in_reference(seen)) + of_reference[1]
    np.testing.assert_allclose(other.in_reference(of_sensor[0].apply(seen) + of_sensor[1]), expected, atol=1e-3)
    assert other.clock_offset_s == pytest.approx(plain.clock_offset_s, abs=1e-4)
    assert other.residual_m == pytest.approx(plain.residual_m, rel=1e-2)
    assert other.rotation_std_rad == pytest.approx(plain.rotation_std_rad, rel=1e-2)
    assert other.position_std_m == pytest.approx(plain.position_std_m, rel=1e-2)


def test_exchanging_the_two_sensors_inverts_the_mounting(tracks):
    there, back = refine(*tracks, OFFSET_S, 6), refine(tracks[1], tracks[0], -OFFSET_S, 6)
    both = back.rotation_sensor_to_reference @ there.rotation_sensor_to_reference
    assert rotation_angle_rad(both) < 0.01
    assert back.clock_offset_s == pytest.approx(-there.clock_offset_s, abs=0.01)
    seen = tracks[1].positions[40]
    np.testing.assert_allclose(back.in_reference(there.in_reference(seen)), seen, atol=0.02)
