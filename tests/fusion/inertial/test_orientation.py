"""Orientation from raw measurements: on real ones with optical truth, and how the error is judged."""

from pathlib import Path

import numpy as np
import pytest
from numpy.testing import assert_allclose
from scipy.spatial.transform import Rotation

from fusion.errors import InputError
from fusion.inertial.orientation import Inertial, orient, orient_to_north, orientation_error, together
from fusion.recording.reader import read_recording


def still(t_s: np.ndarray, site: str = "hand-left") -> Inertial:
    return Inertial(site, t_s, np.zeros((len(t_s), 3)), np.tile([0.0, 0.0, 9.81], (len(t_s), 1)))


@pytest.mark.recordings
@pytest.mark.parametrize(("name", "most_deg"), [("imu-broad-02", 1.3), ("imu-broad-36", 1.6)])
def test_orientation_to_north_is_near_the_optical_truth(recordings: Path, name: str, most_deg: float) -> None:
    source = read_recording(recordings / name)
    (stream,), truth = source.imu_streams, source.orientation_truth
    assert truth is not None
    imu = Inertial(stream.site, stream.t_s, stream.gyro_rad_s, stream.accel_m_s2, stream.magnet_ut)
    error = orientation_error(orient_to_north(imu), truth.orientation, truth.moving)
    assert error.samples > 10_000
    assert np.degrees(error.total_rad) < most_deg
    assert error.inclination_rad < error.total_rad
    assert error.heading_free_rad < error.total_rad


@pytest.mark.recordings
def test_a_magnet_does_nothing_to_an_orientation_that_asks_no_magnetometer(recordings: Path) -> None:
    source = read_recording(recordings / "imu-broad-36")
    (stream,), truth = source.imu_streams, source.orientation_truth
    assert truth is not None
    found = orient(Inertial(stream.site, stream.t_s, stream.gyro_rad_s, stream.accel_m_s2))
    error = orientation_error(found.sensor_to_earth, truth.orientation, truth.moving)
    assert np.degrees(error.inclination_rad) < 0.7


def test_an_error_has_a_heading_and_an_inclination_and_knows_the_constant_offset() -> None:
    truth = Rotation.random(500, rng=np.random.default_rng(0))
    counts = np.ones(500, dtype=bool)
    turned = Rotation.from_euler("z", 20, degrees=True) * truth
    error = orientation_error(turned, truth.as_quat(scalar_first=True), counts)
    assert_allclose(np.degrees([error.total_rad, error.heading_offset_rad]), 20)
    assert_allclose([error.inclination_rad, error.heading_free_rad], 0, atol=1e-7)
    tilted = Rotation.from_euler("x", 5, degrees=True) * truth
    error = orientation_error(tilted, truth.as_quat(scalar_first=True), counts)
    assert_allclose(np.degrees([error.total_rad, error.inclination_rad, error.heading_free_rad]), 5)


def test_samples_that_do_not_count_or_have_no_truth_are_left_out() -> None:
    truth = Rotation.random(4, rng=np.random.default_rng(0))
    quaternions = truth.as_quat(scalar_first=True)
    quaternions[0] = np.nan
    wrong = Rotation.concatenate([truth[:1], Rotation.from_euler("x", 1) * truth[1:2], truth[2:]])
    error = orientation_error(wrong, quaternions, np.array([True, False, True, True]))
    assert error.samples == 2
    assert_allclose(error.total_rad, 0, atol=1e-7)
    with pytest.raises(InputError, match="no true orientation counts"):
        orientation_error(wrong, quaternions, np.zeros(4, dtype=bool))


def test_sensors_meet_on_the_slowest_ones_even_clock() -> None:
    fast, slow = still(np.arange(0, 5, 0.005)), still(np.arange(1, 6, 0.01))
    one, other = together((fast, slow))
    assert_allclose(one.t_s, other.t_s)
    assert one.t_s[0] == 1
    assert_allclose(np.diff(one.t_s), 0.01)
    assert one.t_s[-1] <= 4.995


def test_what_cannot_be_put_on_a_clock_is_named() -> None:
    t_s = np.arange(0, 5, 0.01)
    with pytest.raises(InputError, match=r"'hand-left' has a gap of 0\.31 s after 2\.00 s"):
        together((still(np.where(t_s > 2, t_s + 0.3, t_s)),))
    with pytest.raises(InputError, match="do not overlap"):
        together((still(t_s), still(t_s + 4.5)))
    with pytest.raises(InputError, match="hardly any samples"):
        together((still(t_s[:1]),))
    with pytest.raises(InputError, match="no magnetometer"):
        orient_to_north(still(t_s))
