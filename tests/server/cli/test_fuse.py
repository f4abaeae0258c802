"""`mirrorlimb fuse`: three files, and sentences for what cannot be used; most of it on real recordings."""

from __future__ import annotations

import csv
import json
from dataclasses import replace

import numpy as np
import pytest
import typer
from typer.testing import CliRunner

from fusion.errors import InputError
from fusion.recording.writer import write_recording
from fusion.virtual_patient.trial import virtual_recording
from fusion.virtual_patient.worn import ON_SKIN
from server.cli.fuse import fuse


@pytest.fixture(scope="module")
def command():
    app = typer.Typer()
    app.command()(fuse)
    return lambda *words: CliRunner().invoke(app, [str(word) for word in words])


@pytest.fixture(scope="module")
def written(command, recordings, tmp_path_factory):
    out = tmp_path_factory.mktemp("fused") / "new" / "folder"
    result = command(recordings / "dual-kinect-truth-m09-s04", "--out", out, "--method", "kalman")
    assert result.exit_code == 0, result.output
    return out, result.output


def rows(path):
    with path.open() as file:
        return list(csv.DictReader(file))


@pytest.mark.recordings
def test_fused_csv_has_every_joint_at_every_instant_of_a_30_hz_grid(written):
    table = rows(written[0] / "fused.csv")
    assert list(table[0]) == ["t_s", "joint", "x_m", "y_m", "z_m", "bound_m", "state"]
    times = sorted({float(row["t_s"]) for row in table})
    np.testing.assert_allclose(np.diff(times), 1 / 30, atol=2e-4)
    assert len(table) == len(times) * len({row["joint"] for row in table})
    assert {row["state"] for row in table} <= {"0", "1", "2"}
    assert all(np.isfinite(float(row[axis])) for row in table for axis in ("x_m", "y_m", "z_m"))


@pytest.mark.recordings
def test_angles_csv_gives_the_healthy_arm_and_its_mirror_image(written):
    table = rows(written[0] / "angles.csv")
    assert list(table[0])[:10] == [
        "t_s", "side", "plane_of_elevation_rad", "elevation_rad", "axial_rotation_rad", "elbow_flexion_rad",
        "alpha_rad", "beta_rad", "gamma_rad", "valid",
    ]  # fmt: skip
    valid = [row for row in table if row["valid"] == "1"]
    healthy = {row["t_s"]: row for row in valid if row["side"] == "right"}
    mirrored = [row for row in valid if row["side"] == "left"]
    assert len(mirrored) > 100
    for row in mirrored:
        for angle in ("elevation_rad", "elbow_flexion_rad", "alpha_rad", "beta_rad"):
            assert float(row[angle]) == pytest.approx(float(healthy[row["t_s"]][angle]), abs=1e-4)
        assert 0 < float(row["swing_bound_rad"]) <= np.pi + 1e-5


@pytest.mark.recordings
def test_report_json_says_where_the_sensors_stand(written):
    report = json.loads((written[0] / "report.json").read_text())
    second = report["sensors"]["kinect-2"]
    rotation = np.array(second["rotation_sensor_to_reference"])
    np.testing.assert_allclose(rotation @ rotation.T, np.eye(3), atol=1e-9)
    assert np.linalg.det(rotation) > 0
    assert second["clock_offset_s"] == pytest.approx(0.137, abs=0.04)
    assert second["residual_m"] < 0.05
    assert second["frames"] > 300
    assert report["sensors"]["kinect-1"]["is_reference"]
    assert {"align_s", "fuse_s", "times_real_time"} <= set(report["timings"])
    assert "mirrorlimb" in report["versions"]


@pytest.mark.recordings
def test_the_terminal_says_what_was_found(written):
    assert "clock offset" in written[1]
    assert "kinect-1" in written[1]


def test_the_terminal_says_what_other_sensors_were_joined_and_why_others_were_not(command, tmp_path):
    worn = virtual_recording(1, 4.0, worn=ON_SKIN)
    strange = replace(worn.imu_streams[0], site="left-sock")
    write_recording(replace(worn, imu_streams=(strange, *worn.imu_streams[1:])), tmp_path / "worn")
    said = command(tmp_path / "worn", "--out", tmp_path / "out").output
    assert "joined with upper-arm-right, forearm-right, hand-right" in said
    assert "left-sock: not used. no bone is known" in said


@pytest.mark.recordings
def test_a_folder_that_cannot_be_written_is_named(command, recordings, tmp_path):
    (tmp_path / "file").write_text("")
    result = command(
        recordings / "single-kinect-ges01-wavehand", "--out", tmp_path / "file" / "sub", "--method", "average"
    )
    assert isinstance(result.exception, InputError)
    assert "file" in str(result.exception)


@pytest.mark.recordings
def test_one_sensor_alone_is_fused_too(command, recordings, tmp_path):
    result = command(recordings / "single-kinect-ges01-wavehand", "--out", tmp_path, "--method", "average", "--causal")
    assert result.exit_code == 0, result.output
    assert len(rows(tmp_path / "fused.csv")) > 25 * 100


def test_a_recording_that_is_not_there_is_named(command, tmp_path):
    result = command(tmp_path / "nowhere", "--out", tmp_path)
    assert isinstance(result.exception, InputError)
    assert "nowhere" in str(result.exception)
