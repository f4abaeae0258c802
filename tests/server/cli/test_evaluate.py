"""`mirrorlimb evaluate` on the terminal, as JSON and as Markdown, and what it says when it cannot."""

from __future__ import annotations

import json
from pathlib import Path

import numpy as np
import pytest

from fusion.evaluation.angle_scores import HOLD_FROM_RAD, SLOW_FROM_RAD
from fusion.messages import SkeletonSample
from fusion.recording.recording import Recording, SkeletonStream, TruthStream
from fusion.recording.writer import write_recording
from fusion.skeleton import JOINT_COUNT, JOINTS, Side
from fusion.virtual_patient.sensor import NO_NOISE
from fusion.virtual_patient.trial import virtual_recording
from server.cli import main as entry
from server.config import GateConfig


def written(path: Path, truth: bool = True) -> Path:
    """Four seconds of a person who stands 5 cm beside the truth."""
    where = virtual_recording(1, 0.02, noise=NO_NOISE).truth.positions[0]
    seen = where + np.array([0.05, 0.0, 0.0])
    state = np.full(JOINT_COUNT, 2, np.uint8)
    samples = tuple(SkeletonSample("k-1", "1", k / 30, k / 30, seen, state) for k in range(121))
    times_s = np.arange(0, 4.5, 0.05)
    stream = TruthStream(times_s, JOINTS, np.broadcast_to(where, (len(times_s), JOINT_COUNT, 3)), "k-1")
    streams = (SkeletonStream("k-1", True, "sensor", samples),)
    recording = Recording(path.name, "", Side.LEFT, streams, stream if truth else None, (), path)
    write_recording(recording, path)
    return path


def run(monkeypatch: pytest.MonkeyPatch, *arguments: object) -> int:
    """The installed command, in this process; its exit code."""
    monkeypatch.setattr("sys.argv", ["mirrorlimb", "evaluate", *map(str, arguments)])
    with pytest.raises(SystemExit) as ended:
        entry.main()
    code = ended.value.code
    return code if isinstance(code, int) else 0


def test_one_recording_shows_every_joint_and_the_arm(tmp_path, monkeypatch, capsys) -> None:
    assert run(monkeypatch, written(tmp_path / "one"), "--method", "kalman") == 0
    said = capsys.readouterr().out
    for name in (*JOINTS, "kalman", "k-1 alone", "50.0", "100.00%", "Alignment learnt on the way"):
        assert name in said


def test_json_to_standard_output_is_nothing_but_json(tmp_path, monkeypatch, capsys) -> None:
    assert run(monkeypatch, written(tmp_path / "one"), "--method", "average", "--json") == 0
    said = json.loads(capsys.readouterr().out)
    (recording,) = said["recordings"]
    assert recording["healthy_side"] == "left"
    assert [(r["name"], r["causal"]) for r in recording["runs"]] == [
        ("average", False),
        ("average", True),
        ("k-1 alone", False),
    ]
    first = recording["runs"][0]
    assert first["joints"]["WristLeft"]["rms_mm"] == pytest.approx(50.0, abs=0.1)
    assert first["healthy_arm"]["inside_share"] == 1.0
    assert first["angles"]["swing"]["clear"]["instants"] == 61
    assert first["angles"]["swing"]["planted"] == {"instants": 0, "engaged": None, "full_speed": None}


def test_several_recordings_are_pooled_and_written_as_a_page(tmp_path, monkeypatch, capsys) -> None:
    one, two = written(tmp_path / "one"), written(tmp_path / "two")
    report = tmp_path / "results.md"
    assert run(monkeypatch, one, two, "--method", "average", "--markdown", report) == 0
    said = capsys.readouterr().out
    assert "2 recordings together" in said
    assert "WristLeft" not in said
    page = report.read_text()
    assert "## one" in page
    assert "## two" in page
    assert str(tmp_path) not in page
    assert run(monkeypatch, one, two, "--method", "average", "--json") == 0
    pooled = json.loads(capsys.readouterr().out)["pooled"]
    assert pooled[0]["healthy_arm"]["instants"] == 2 * 3 * 61


def test_several_methods_may_follow_one_option(tmp_path, monkeypatch, capsys) -> None:
    assert run(monkeypatch, written(tmp_path / "one"), "--method", "average", "kalman", "--json") == 0
    (recording,) = json.loads(capsys.readouterr().out)["recordings"]
    assert {r["method"] for r in recording["runs"] if not r["only_sensor"]} == {"average", "kalman"}


@pytest.mark.parametrize(
    ("arguments", "expected"),
    [
        (["--method", "magic"], "no method is called 'magic'"),
        (["--markdown", "/nowhere/results.md"], "cannot write /nowhere/results.md"),
    ],
)
def test_what_cannot_be_done_is_said_in_a_sentence(arguments, expected, tmp_path, monkeypatch, capsys) -> None:
    assert run(monkeypatch, written(tmp_path / "one"), *arguments) == 2
    said = capsys.readouterr().err
    assert expected in said
    assert "Traceback" not in said


def test_no_truth_ends_with_exit_code_2_and_what_was_expected(tmp_path, monkeypatch, capsys) -> None:
    assert run(monkeypatch, written(tmp_path / "blind", truth=False)) == 2
    said = capsys.readouterr().err
    assert "'blind' has no truth" in said
    assert "Expected" in said


def test_a_missing_recording_ends_with_exit_code_2(tmp_path, monkeypatch, capsys) -> None:
    assert run(monkeypatch, tmp_path / "nothing") == 2
    assert "does not exist" in capsys.readouterr().err


@pytest.mark.recordings
def test_orientations_are_judged_where_their_truth_is_known(recordings, monkeypatch, capsys) -> None:
    assert run(monkeypatch, recordings / "imu-broad-36") == 0
    said = capsys.readouterr().out
    assert "with magnetometer" in said
    assert "inclination" in said
    assert run(monkeypatch, recordings / "imu-broad-02", "--json") == 0
    said = json.loads(capsys.readouterr().out)
    assert said["recordings"] == []
    (judged,) = said["orientations"]
    assert 0 < judged["ways"]["with magnetometer"]["total_rad"] < np.radians(1.3)


def test_true_orientations_need_the_sensor_that_they_are_of(tmp_path, monkeypatch, capsys) -> None:
    (tmp_path / "truth.csv").write_text("t_s,qw,qx,qy,qz,moving\n0,1,0,0,0,1\n")
    streams = [{"file": "truth.csv", "kind": "truth-orientation"}]
    (tmp_path / "recording.json").write_text(json.dumps({"format": "mirrorlimb-recording/1", "streams": streams}))
    assert run(monkeypatch, tmp_path) == 2
    assert "0 imu streams" in capsys.readouterr().err


def test_angles_are_judged_by_the_thresholds_of_the_station_s_gate() -> None:
    gate = GateConfig()
    assert (gate.slow_from_rad, gate.hold_from_rad) == (SLOW_FROM_RAD, HOLD_FROM_RAD)
