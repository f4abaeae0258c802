"""Angles against truth: inside their bounds, and bounds that leave the robot engaged."""

from __future__ import annotations

from functools import cache
from pathlib import Path

import pytest

from fusion.evaluation.angle_scores import ROWS, AngleScore
from fusion.evaluation.runs import Way, evaluate_recording, pooled_angles
from fusion.recording.reader import read_recording
from fusion.virtual_patient.sensor import DEMO, TABLE1, NoiseLevel
from fusion.virtual_patient.trial import virtual_recording

OURS = Way("set-membership", "set-membership")
FIVE_CM = NoiseLevel((0.0, 0.0, 0.0), (0.03, 0.03, 0.03), 0.9, 0.0, (0.05, 0.05, 0.05))
"""Every joint for itself, slowly changing, never more than 5 cm off on an axis."""


@cache
def real(folder: Path) -> dict[str, AngleScore]:
    """The seven recordings with truth together."""
    paths = sorted(folder.glob("dual-kinect-truth-*"))
    return pooled_angles([evaluate_recording(read_recording(path), [OURS]) for path in paths])[OURS]


@pytest.mark.recordings
@pytest.mark.parametrize("angle", ROWS)
def test_the_truth_is_inside_and_the_robot_engaged_outside_planted_trouble(recordings: Path, angle: str) -> None:
    found = real(recordings)[angle]
    assert found.inside_share >= 0.995
    assert found.clear.engaged >= 0.95


@pytest.mark.recordings
def test_most_of_the_time_the_arm_is_driven_in_planted_trouble_too(recordings: Path) -> None:
    assert real(recordings)["swing and elbow"].planted.engaged > 0.9


@pytest.mark.parametrize("noise", [DEMO, FIVE_CM, TABLE1], ids=["demo", "five-cm", "table-1"])
@pytest.mark.parametrize("seed", [5])
def test_noise_that_keeps_its_bounds_never_leaves_the_angles(noise: NoiseLevel, seed: int) -> None:
    found = pooled_angles([evaluate_recording(virtual_recording(seed, 10.0, noise=noise), [OURS])])[OURS]
    assert {angle: score.inside_share for angle, score in found.items()} == dict.fromkeys(ROWS, 1.0)


def test_a_good_pair_of_sensors_never_holds_the_robot() -> None:
    found = pooled_angles([evaluate_recording(virtual_recording(3, 10.0, noise=DEMO), [OURS])])[OURS]
    assert found["all asked for"].clear.engaged > 0.99
