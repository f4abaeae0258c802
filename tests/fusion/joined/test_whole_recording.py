"""`fuse` uses what a recording has besides skeletons, and says what it could not use."""

from __future__ import annotations

import json
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest

from fusion.evaluation.scores import truth_at
from fusion.offline import FusedRecording, fuse_recording
from fusion.recording.recording import Recording
from fusion.skeleton import Side, arm
from server.cli.fused_files import make_folder, write_fused

COVERED_S = (12.0, 16.0)
ARM = list(arm(Side.RIGHT)[:3])


@pytest.fixture(scope="module")
def covered(everything: Recording) -> Recording:
    """Both cameras see nothing for four seconds; one inertial sensor has a name that nobody knows."""
    streams = tuple(
        replace(stream, samples=tuple(s for s in stream.samples if not COVERED_S[0] <= s.t_s < COVERED_S[1]))
        for stream in everything.skeleton_streams
    )
    strange = replace(everything.imu_streams[3], site="left-sock")
    return replace(everything, skeleton_streams=streams, imu_streams=(*everything.imu_streams[:3], strange))


@pytest.fixture(scope="module")
def fused(covered: Recording) -> FusedRecording:
    return fuse_recording(covered, "set-membership")


def hidden(found: FusedRecording) -> np.ndarray:
    return (found.t_s > COVERED_S[0] + 1.0) & (found.t_s < COVERED_S[1])


def rms_m(found: FusedRecording, recording: Recording) -> float:
    off = found.positions - truth_at(recording.truth, found.t_s)
    return float(np.sqrt(np.mean(np.sum(off[hidden(found)][:, ARM] ** 2, axis=-1))))


def test_what_is_used_and_what_is_not_is_written_with_the_reason(fused: FusedRecording, tmp_path: Path) -> None:
    make_folder(tmp_path / "out")
    write_fused(fused, tmp_path / "out")
    told = json.loads((tmp_path / "out" / "report.json").read_text("utf-8"))["other_sensors"]
    assert told["used"] == ["upper-back", "upper-arm-right", "forearm-right", "waist"]
    assert "no bone is known" in told["unusable"]["left-sock"]


def test_while_both_cameras_are_covered_arm_and_angles_go_on(fused: FusedRecording, covered: Recording) -> None:
    cameras = fuse_recording(replace(covered, imu_streams=(), range_streams=()), "set-membership")
    assert rms_m(fused, covered) < 0.7 * rms_m(cameras, covered)
    inside = np.flatnonzero(hidden(fused))
    assert (fused.state[inside][:, ARM] > 0).all()
    assert all(fused.healthy[k] is not None and fused.healthy[k].valid for k in inside)
    assert all(cameras.healthy[k] is None for k in inside)


def test_other_methods_and_a_sensor_alone_know_cameras_only(covered: Recording) -> None:
    assert fuse_recording(covered, "kalman").others.used == ()
    assert fuse_recording(covered, "set-membership", only_sensor="virtual-2").others.used == ()
