"""The paper's linear mounting: good near 90°, and no further."""

from __future__ import annotations

import numpy as np
import pytest
from scipy.spatial.transform import Rotation

from fusion.align.bursa import bursa
from fusion.align.space import fit_robustly
from fusion.align.track import pair

TIMES = np.arange(0.0, 8.0, 0.1)


def misfit(bodies, angles_deg):
    """Median distance left by the paper's method and by the exact one, in metres."""
    rotation, translation = Rotation.from_euler("yxz", angles_deg, degrees=True), np.array([2.3, 0.1, 2.2])
    reference, sensor = bodies.track(TIMES), bodies.track(TIMES, rotation, translation)
    left = np.linalg.norm(
        reference.positions - bursa(reference.positions, sensor.positions).in_reference(sensor.positions), axis=2
    )
    return float(np.median(left)), fit_robustly(pair(reference, sensor, 0.0)).residual_m


@pytest.mark.parametrize("yaw_deg", [90.0, -90.0])
def test_a_sensor_at_a_right_angle_to_either_side_is_found(bodies, yaw_deg):
    left_m, _ = misfit(bodies, [yaw_deg, 0.0, 0.0])
    assert left_m < 1e-4


def test_ten_degrees_off_it_leaves_millimetres_that_the_exact_method_does_not(bodies):
    bursa_m, exact_m = misfit(bodies, [100.0, 3.0, 0.0])
    assert 0.001 < bursa_m < 0.02
    assert exact_m < 1e-5


def test_joints_that_a_sensor_did_not_give_take_no_part(bodies):
    rotation = Rotation.from_euler("y", 90.0, degrees=True)
    reference, sensor = bodies.track(TIMES).positions, bodies.track(TIMES, rotation, (2.3, 0.0, 2.2)).positions.copy()
    sensor[::2, 4:12] = np.nan
    fit = bursa(reference, sensor)
    np.testing.assert_allclose(fit.in_reference(sensor[1]), reference[1], atol=1e-3)
