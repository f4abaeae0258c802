"""Yao's weights: by tracking state, and by how the person faces each lens."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest
from scipy.spatial.transform import Rotation

from fusion.estimation.adaptive import LEAST_WEIGHT, Adaptive
from fusion.messages import AlignedSample
from fusion.skeleton import INDEX, JOINT_COUNT

from .scene import WRIST, changed, sample_at

PAIRED = [INDEX[name + side] for name in ("Shoulder", "Elbow", "Hip") for side in ("Left", "Right")]


def facing_sample(sensor: str, angle_deg: float, away_m: float = 0.0) -> AlignedSample:
    """A person 2.5 m away who faces the sensor at the origin, seen by a lens turned by an angle about y."""
    sample = changed(sample_at(0.0), WRIST, away_m)
    positions = sample.positions_in_room.copy()
    for left, right in zip(PAIRED[::2], PAIRED[1::2], strict=True):
        positions[left], positions[right] = (-0.2, 1.0, 2.5), (0.2, 1.0, 2.5)
    turned = Rotation.from_euler("y", angle_deg, degrees=True).as_matrix()
    return replace(sample, sensor=sensor, positions_in_room=positions, rotation_sensor_to_room=turned)


def fused_wrist(*samples: AlignedSample) -> float:
    """How far the wrist is along x from where `sample_at` has it."""
    adaptive = Adaptive()
    for sample in samples:
        adaptive.update(sample)
    return float((adaptive.frame(0.0).positions_in_room - sample_at(0.0).positions_in_room)[WRIST, 0])


@pytest.mark.parametrize("angle_deg", [10.0, 30.0, 45.0, 60.0, 80.0])
def test_two_sensors_at_a_right_angle_share_linearly(angle_deg: float) -> None:
    first, second = facing_sample("a", angle_deg), facing_sample("b", angle_deg - 90.0, 0.09)
    assert fused_wrist(first, second) == pytest.approx(0.09 * angle_deg / 90.0)


@pytest.mark.parametrize("behind_deg", [0.0, 180.0])
def test_a_sensor_in_front_or_behind_outweighs_one_at_the_side(behind_deg: float) -> None:
    at = fused_wrist(facing_sample("a", behind_deg), facing_sample("b", 90.0, 0.105))
    assert at == pytest.approx(0.105 * LEAST_WEIGHT / (1 + LEAST_WEIGHT))


def test_the_only_sensor_counts_fully_even_from_the_side() -> None:
    assert fused_wrist(facing_sample("a", 90.0, 0.1)) == pytest.approx(0.1)


def test_three_sensors_are_weighed_like_two() -> None:
    at = fused_wrist(facing_sample("a", 0.0), facing_sample("b", 45.0, 0.1), facing_sample("c", -45.0, 0.1))
    assert at == pytest.approx(0.05)


def test_an_inferred_joint_counts_half() -> None:
    first, second = facing_sample("a", 0.0), facing_sample("b", 0.0, 0.09)
    assert fused_wrist(first, changed(second, WRIST, 0.0, 1)) == pytest.approx(0.03)


def test_without_a_tracked_pair_all_lenses_count_alike() -> None:
    every = np.arange(JOINT_COUNT)
    first, second = (
        changed(sample, every, 0.0, 1) for sample in (facing_sample("a", 0.0), facing_sample("b", 90.0, 0.1))
    )
    assert fused_wrist(first, second) == pytest.approx(0.05)
