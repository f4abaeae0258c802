"""`mirrorlimb locate` on the real ranges: positions with their bounds, sentences for what cannot be used."""

from __future__ import annotations

import csv
from pathlib import Path

import numpy as np
import pytest
import typer
from scipy.spatial.transform import Rotation
from typer.testing import CliRunner

from fusion.errors import InputError
from fusion.recording.reader import ImuStream, RangeStream, Recording, TruthStream, read_recording
from fusion.recording.writer import write_recording
from server.cli.locate import locate


@pytest.fixture(scope="module")
def command():
    app = typer.Typer()
    app.command()(locate)
    return lambda *words: CliRunner().invoke(app, [str(word) for word in words])


@pytest.fixture(scope="module")
def real(command, recordings, tmp_path_factory):
    """Rows of one tag against the truth: errors (m), bounds, times, by the options given."""
    truth = read_recording(recordings / "uwb-fast").truth

    def run(*options, tag="T0"):
        out = tmp_path_factory.mktemp("located")
        result = command(recordings / "uwb-fast", "--out", out, "--height", 0.965, *options)
        assert result.exit_code == 0, result.output
        with (out / "position.csv").open() as file:
            rows = list(csv.DictReader(file))
        assert list(rows[0]) == ["t_s", "tag", "x_m", "y_m", "z_m", "bound_m", "anchors_used"]
        rows = [row for row in rows if row["tag"] == tag]
        t_s = np.array([float(row["t_s"]) for row in rows])
        at = [np.interp(t_s, truth.t_s, truth.positions[:, truth.joints.index(tag), axis]) for axis in range(3)]
        off = np.array([[float(row[axis]) for axis in ("x_m", "y_m", "z_m")] for row in rows]) - np.array(at).T
        return t_s, off, np.array([float(row["bound_m"]) for row in rows]), result.output

    return run


@pytest.mark.recordings
@pytest.mark.parametrize(
    ("options", "rms_m"),
    [
        (("--anchors", "A0,A2,A5"), 0.06),
        ((), 0.045),
        (("--tags", "T0", "--anchors", "A0,A2,A5"), 0.086),
        (("--tags", "T0"), 0.055),
        (("--calibrate-from", 75), 0.045),
    ],
    ids=["three anchors", "eight anchors", "a lone tag, three", "a lone tag, eight", "other seconds to learn from"],
)
def test_after_30_s_of_truth_the_rest_is_located_and_the_bound_holds(real, options, rms_m):
    t_s, off, bound_m, output = real("--calibrate", 30, *options)
    rest = t_s > 30
    assert np.sqrt(np.mean(np.sum(off[rest, :2] ** 2, axis=1))) <= rms_m
    assert np.mean(np.linalg.norm(off, axis=1) <= bound_m) >= 0.99
    assert "outside the seconds learnt from" in output


@pytest.mark.recordings
def test_biases_learnt_without_truth_bring_most_of_what_truth_brings(real):
    raw, own = (real(*options)[1] for options in (("--tags", "T0"), ("--tags", "T0", "--self-calibrate", 30)))
    rms_raw, rms_own = (np.sqrt(np.mean(np.sum(off[:, :2] ** 2, axis=1))) for off in (raw, own))
    assert rms_own < 0.5 * rms_raw


# ---------------------------------------------------------------- with an inertial sensor, simulated

ANCHORS = np.array([[-3.0, -2.5, 1.2], [3.0, -2.5, 1.3], [3.0, 2.5, 1.2], [-3.0, 2.5, 1.1]])


def walk(t_s):
    """Somebody stands for four seconds, then walks a figure of eight, (T, 3) m, with the bob and sway of steps."""
    since = np.maximum(np.asarray(t_s) - 4.0, 0.0)
    phase = 0.35 * (since - 2.0 * (1 - np.exp(-since / 2.0)))
    steps = 2 * np.pi * 0.9 * since
    begun = 1 - np.exp(-((since / 2.0) ** 3))
    sway, bob = 0.02 * begun * np.sin(steps), 0.02 * begun * np.cos(2 * steps)
    return np.stack([1.8 * np.sin(phase), 1.2 * np.sin(2 * phase) + sway, 1.0 + bob], axis=-1)


def belt(rng, site, seconds=40.0):
    """A recording of a tag and an inertial sensor on a belt: now and then one anchor alone is in sight."""
    t_s, dt = np.arange(0, seconds, 0.01), 1e-3
    places = [walk(t_s + step) for step in (-dt, 0.0, dt)]
    ahead = walk(t_s + 0.8) - walk(t_s)
    yaw = np.unwrap(np.arctan2(ahead[:, 1] + 1e-6, ahead[:, 0] + 1e-6))
    yaw[t_s < 4] = yaw[t_s >= 4][0]
    turned = Rotation.from_rotvec(yaw[:, None] * [0.0, 0.0, 1.0]) * Rotation.from_euler("xyz", [0.3, -1.2, 0.8])
    gyro = (turned[:-1].inv() * turned[1:]).as_rotvec() / 0.01
    force = (places[0] - 2 * places[1] + places[2]) / dt**2 + [0.0, 0.0, 9.81]
    accel = turned.inv().apply(force)
    imu = ImuStream(
        site,
        t_s[:-1],
        gyro + rng.normal(0, 0.0018, gyro.shape) + rng.normal(0, 0.0025, 3),
        (accel + rng.normal(0, 0.055, accel.shape) + rng.normal(0, 0.025, 3))[:-1],
    )
    at = t_s[::2]
    range_m = np.linalg.norm(walk(at)[:, None] - ANCHORS, axis=-1) + rng.normal(0, 0.05, (len(at), 4))
    blocked = (at[:, None] % 8 < 1.5) & (np.arange(4) != at[:, None] // 8 % 4) & (at[:, None] > 10)
    range_m += np.where(blocked, rng.normal(0.4, 0.1, range_m.shape), 0.0)
    numbers = np.tile(np.arange(4), len(at))
    ranges = RangeStream(("A", "B", "C", "D"), ANCHORS, ("T",), np.repeat(at, 4), numbers, 0 * numbers, range_m.ravel())
    truth = TruthStream(at, ("T",), walk(at)[:, None])
    return Recording("belt", "", None, (), truth, (), Path(), range_streams=(ranges,), imu_streams=(imu,))


@pytest.mark.parametrize("site", ["waist", "T"])
def test_a_sensor_beside_the_tag_lessens_the_error_and_one_elsewhere_is_left_alone(command, tmp_path, site):
    def rms_m(name, source):
        write_recording(source, tmp_path / name)
        result = command(tmp_path / name, "--out", tmp_path / f"{name}-out", "--height", 1.0, "--calibrate", 9)
        assert result.exit_code == 0, result.output
        rows = list(csv.DictReader((tmp_path / f"{name}-out" / "position.csv").read_text().splitlines()))
        found = np.array([[float(row[key]) for key in ("t_s", "x_m", "y_m")] for row in rows])
        found = found[found[:, 0] > 10]
        return np.sqrt(np.mean(np.sum((found[:, 1:] - walk(found[:, 0])[:, :2]) ** 2, axis=1))), result.output

    alone, said_alone = rms_m("alone", belt(np.random.default_rng(1), "forearm-left"))
    helped, said_helped = rms_m("helped", belt(np.random.default_rng(1), site))
    assert helped < 0.7 * alone
    assert "sensor beside T" in said_helped
    assert "sensor beside" not in said_alone


# ---------------------------------------------------------------- what cannot be used


@pytest.mark.recordings
@pytest.mark.parametrize(
    ("options", "says"),
    [
        (("--anchors", "A0,A2,B7", "--height", 1), "no anchor is called 'B7'"),
        (("--tags", "T0,T7", "--height", 1), "no tag is called 'T7'"),
        (("--calibrate", 300, "--height", 1), "it has 135 s"),
        (("--anchors", "A0,A2", "--height", 1), "2 anchors are too few"),
        ((), "the anchors lie in one plane"),
        (("--height", 1, "--calibrate", 5, "--self-calibrate", 5), "exclude each other"),
    ],
)
def test_what_cannot_be_used_is_said_in_words(command, recordings, tmp_path, options, says):
    result = command(recordings / "uwb-fast", "--out", tmp_path, *options)
    assert isinstance(result.exception, InputError)
    assert says in str(result.exception)
    assert result.exception.remedy


@pytest.mark.recordings
def test_a_recording_without_ranges_is_refused(command, recordings, tmp_path):
    result = command(recordings / "imu-broad-02", "--out", tmp_path)
    assert isinstance(result.exception, InputError)
    assert "has no ranges" in str(result.exception)
