"""`mirrorlimb arm`: the file it writes, and what it says of recordings that it cannot use."""

import csv
import json
from collections.abc import Callable
from pathlib import Path

import numpy as np
import pytest
from numpy.testing import assert_allclose
from typer.testing import CliRunner

from fusion.errors import InputError, RecordingError
from fusion.inertial.simulation import SimulatedArm, simulate_arm
from fusion.messages import SkeletonSample
from fusion.recording.reader import ImuStream, Recording, SkeletonStream
from fusion.recording.writer import write_recording
from fusion.skeleton import JOINT_COUNT, Side
from fusion.skeleton import arm as arm_joints
from server.cli.main import app

Run = Callable[..., Path]


@pytest.fixture(scope="module")
def truth() -> SimulatedArm:
    return simulate_arm(seed=2, duration_s=16.0)


def recording(truth: SimulatedArm, side: str, cameras: tuple[SkeletonStream, ...] = ()) -> Recording:
    imus = tuple(ImuStream(f"{i.site}-{side}", i.t_s, i.gyro_rad_s, i.accel_m_s2) for i in truth.sensors)
    return Recording("simulated", "", None, cameras, None, (), Path(), imu_streams=imus)


@pytest.fixture
def run(tmp_path: Path) -> Run:
    """Writes a recording and runs the command on it."""

    def command(source: Recording, *options: str, form: str = "recording") -> Path:
        write_recording(source, tmp_path / form)
        words = ["arm", str(tmp_path / form), "--out", str(tmp_path / "out"), *options]
        result = CliRunner().invoke(app, words, catch_exceptions=True)
        if result.exception:
            raise result.exception
        return tmp_path / "out" / "arm.csv"

    return command


def points(path: Path, joint: str) -> np.ndarray:
    rows = csv.DictReader(path.read_text().splitlines())
    return np.array([[float(r[c]) for c in ("x_m", "y_m", "z_m")] for r in rows if r["joint"] == joint])


@pytest.mark.parametrize("form", ["folder", "log.mcap"])
def test_the_arm_is_written_joint_by_joint_near_the_truth(run: Run, truth: SimulatedArm, form: str) -> None:
    path = run(
        recording(truth, "left"),
        "--upper-arm",
        "0.3",
        "--forearm",
        "0.26",
        "--hand",
        "0.08",
        "--pose",
        "0.5",
        "3.5",
        form=form,
    )
    assert path.read_text().splitlines()[0] == "t_s,side,joint,x_m,y_m,z_m"
    assert {row["side"] for row in csv.DictReader(path.read_text().splitlines())} == {"left"}
    found = [points(path, joint) for joint in ("shoulder", "elbow", "wrist", "hand")]
    assert_allclose(np.stack(found, axis=1), truth.positions, atol=0.05)
    assert not found[0].any()
    for one, other, length_m in zip(found, found[1:], (0.3, 0.26, 0.08), strict=False):
        assert_allclose(np.linalg.norm(one - other, axis=1), length_m, atol=1e-9)


def test_lengths_come_from_the_recordings_camera_where_nobody_gives_them(run: Run, truth: SimulatedArm) -> None:
    positions = np.full((JOINT_COUNT, 3), np.nan)
    positions[list(arm_joints(Side.RIGHT))] = [[0, 0, 2], [0, -0.33, 2], [0, -0.6, 2], [0, -0.67, 2]]
    state = np.where(np.isnan(positions[:, 0]), 0, 2).astype(np.uint8)
    samples = tuple(SkeletonSample("k", "1", t / 30, t / 30, positions, state) for t in range(20))
    path = run(recording(truth, "right", (SkeletonStream("k", True, "sensor", samples),)), "--hand", "0.1")
    wrist = points(path, "wrist")
    assert_allclose(np.linalg.norm(points(path, "elbow"), axis=1), 0.33, atol=1e-9)
    assert_allclose(np.linalg.norm(points(path, "hand") - wrist, axis=1), 0.1, atol=1e-9)


def test_both_arms_are_followed_where_both_are_worn(run: Run, truth: SimulatedArm) -> None:
    both = recording(truth, "left").imu_streams + recording(truth, "right").imu_streams
    path = run(Recording("both", "", None, (), None, (), Path(), imu_streams=both))
    assert {row["side"] for row in csv.DictReader(path.read_text().splitlines())} == {"left", "right"}


@pytest.mark.parametrize(
    ("options", "says"),
    [
        (("--forearm", "26"), "a segment of 26 m"),
        (("--hand", "0"), "a segment of 0 m"),
        (("--pose", "40", "41"), "no pose from 40 to 41 s"),
        (("--pose", "10", "14"), "never still"),
    ],
)
def test_options_that_cannot_be_are_refused(run: Run, truth: SimulatedArm, options: tuple[str], says: str) -> None:
    with pytest.raises(InputError, match=says):
        run(recording(truth, "left"), *options)


def test_a_missing_sensor_is_named(run: Run, truth: SimulatedArm) -> None:
    whole = recording(truth, "left").imu_streams
    with pytest.raises(InputError, match="no imu stream has the site forearm-left"):
        run(Recording("n", "", None, (), None, (), Path(), imu_streams=(whole[0], whole[2])))


def test_numbers_that_are_none_are_named_with_their_line(tmp_path: Path) -> None:
    header = "t_s,gx_rad_s,gy_rad_s,gz_rad_s,ax_m_s2,ay_m_s2,az_m_s2\n"
    (tmp_path / "imu.csv").write_text(header + "0,0,0,0,0,0,9.81\n0.01,0,0,NaN,0,0,9.81\n")
    streams = [{"file": "imu.csv", "kind": "imu", "site": "forearm-left"}]
    manifest = {"format": "mirrorlimb-recording/1", "streams": streams}
    (tmp_path / "recording.json").write_text(json.dumps(manifest))
    result = CliRunner().invoke(app, ["arm", str(tmp_path), "--out", str(tmp_path / "out")])
    assert isinstance(result.exception, RecordingError)
    assert "imu.csv, line 3" in str(result.exception)
