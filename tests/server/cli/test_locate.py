"""`mirrorlimb locate` on the real ranges: positions as the contract has them, sentences for what cannot be used."""

from __future__ import annotations

import csv

import numpy as np
import pytest
import typer
from typer.testing import CliRunner

from fusion.errors import InputError
from fusion.recording.reader import read_recording
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
    raw, own = (real(*options)[1] for options in ((), ("--self-calibrate", 30)))
    rms_raw, rms_own = (np.sqrt(np.mean(np.sum(off[:, :2] ** 2, axis=1))) for off in (raw, own))
    assert rms_own < 0.5 * rms_raw


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
