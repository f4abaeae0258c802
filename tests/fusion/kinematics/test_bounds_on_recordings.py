"""On real motion with truth: the angles' errors stay inside their bounds, and the bounds let the arm be driven."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest

from fusion.messages import Floats
from fusion.offline import FusedRecording, fuse_recording
from fusion.recording.reader import read_recording
from fusion.recording.recording import TruthStream
from fusion.skeleton import JOINTS, arm

HOLD_FROM_RAD = 0.7
LEARNT_AFTER_S = 3.0

pytestmark = pytest.mark.recordings


def directions(points: Floats) -> Floats:
    """(T, 2, 3) of upper arm and forearm from (T, 3, 3) shoulder, elbow, wrist."""
    vectors = np.diff(points, axis=1)
    return np.asarray(vectors / np.linalg.norm(vectors, axis=2, keepdims=True))


def angle(a: Floats, b: Floats) -> Floats:
    return np.asarray(np.arccos(np.clip((a * b).sum(axis=-1), -1, 1)))


def true_points(fused: FusedRecording, truth: TruthStream) -> Floats:
    def at(joint: int) -> list[Floats]:
        places = truth.positions[:, truth.joints.index(JOINTS[joint])]
        return [np.interp(fused.t_s, truth.t_s, column) for column in places.T]

    return np.array([at(joint) for joint in arm(fused.healthy_side)[:3]]).transpose(2, 0, 1)


@pytest.mark.parametrize("name", ["m07-s04", "m08-s04", "m10-s04"])
def test_errors_are_inside_bounds_that_let_the_arm_be_driven(recordings: Path, name: str) -> None:
    recording = read_recording(recordings / f"dual-kinect-truth-{name}")
    fused = fuse_recording(recording, "set-membership")
    assert recording.truth is not None
    known = fused.t_s > fused.t_s[0] + LEARNT_AFTER_S
    joints = list(arm(fused.healthy_side)[:3])
    seen, true = directions(fused.positions[known][:, joints]), directions(true_points(fused, recording.truth)[known])
    angles = [one for one, is_known in zip(fused.healthy, known, strict=True) if is_known and one is not None]
    assert len(angles) == known.sum()
    swing_bound = np.array([one.swing_bound_rad for one in angles])
    elbow_bound = np.array([one.elbow_bound_rad for one in angles])
    assert (angle(seen[:, 0], true[:, 0]) <= swing_bound).mean() > 0.97
    flexion_error = np.abs(angle(seen[:, 0], seen[:, 1]) - angle(true[:, 0], true[:, 1]))
    assert (flexion_error <= elbow_bound).mean() > 0.97
    assert (swing_bound < HOLD_FROM_RAD).mean() > 0.9
    assert (elbow_bound < HOLD_FROM_RAD).mean() > 0.8
