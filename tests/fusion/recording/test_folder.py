"""Reading the interchange form: what is there, and what a broken one says."""

import gzip
import json
from collections.abc import Callable
from pathlib import Path

import numpy as np
import pytest

from fusion.errors import RecordingError
from fusion.recording.reader import read_recording
from fusion.skeleton import INDEX, JOINT_COUNT, Side

SKELETON = "t_s,body,joint,x_m,y_m,z_m,state\n"
TRUTH = "t_s,joint,x_m,y_m,z_m\n"
Make = Callable[..., Path]


@pytest.fixture
def make(tmp_path: Path) -> Make:
    """Writes a recording of one sensor and, if given, truth."""

    def write(skeleton: str, truth: str | None = None, **manifest: object) -> Path:
        (tmp_path / "k.csv").write_text(skeleton)
        streams: list[dict[str, object]] = [{"file": "k.csv", "kind": "skeleton", "sensor": "k", "primary": True}]
        if truth is not None:
            (tmp_path / "truth.csv").write_text(truth)
            streams.append({"file": "truth.csv", "kind": "truth"})
        whole = {"format": "mirrorlimb-recording/1", "name": "n", "streams": streams} | manifest
        (tmp_path / "recording.json").write_text(json.dumps(whole))
        return tmp_path

    return write


def test_rows_of_one_instant_and_body_are_one_sample_whatever_their_order(make: Make) -> None:
    folder = make(SKELETON + "0.2,7,Head,1,2,3,2\n0.1,7,Neck,4,5,6,1\n0.1,7,Head,7,8,9,2\n0.1,8,Head,0,0,1,2\n")
    samples = read_recording(folder).skeleton_streams[0].samples
    assert [(s.t_s, s.body, int((s.state > 0).sum())) for s in samples] == [(0.1, "7", 2), (0.1, "8", 1), (0.2, "7", 1)]
    np.testing.assert_array_equal(samples[0].positions_in_sensor[INDEX["Head"]], [7, 8, 9])
    assert np.isnan(samples[0].positions_in_sensor[INDEX["HandLeft"]]).all()
    assert samples[0].state.shape == (JOINT_COUNT,)


@pytest.mark.parametrize("numbers", ["1,2,3", ",,", "nan,nan,nan"])
def test_positions_of_lost_joints_mean_nothing(make: Make, numbers: str) -> None:
    (sample,) = read_recording(make(SKELETON + f"0,1,Head,{numbers},0\n")).skeleton_streams[0].samples
    assert np.isnan(sample.positions_in_sensor).all()
    assert not sample.state.any()


def test_columns_may_come_in_any_order_and_unknown_ones_are_left_alone(make: Make) -> None:
    folder = make("note,state,z_m,y_m,x_m,joint,body,t_s\nhi,2,3,2,1,Head,0,0.5\n")
    (sample,) = read_recording(folder).skeleton_streams[0].samples
    np.testing.assert_array_equal(sample.positions_in_sensor[INDEX["Head"]], [1, 2, 3])


def test_truth_has_a_column_per_joint_and_nan_where_there_is_none(make: Make) -> None:
    recording = read_recording(make(SKELETON, TRUTH + "0,Head,1,2,3\n0.01,Neck,4,5,6\n", healthy_side="left"))
    assert recording.truth is not None
    assert recording.truth.joints == ("Neck", "Head")
    np.testing.assert_array_equal(np.isnan(recording.truth.positions[..., 0]), [[True, False], [False, True]])
    assert recording.healthy_side is Side.LEFT


@pytest.mark.parametrize(
    ("row", "says"),
    [
        ("0,1,Head,1,2\n", "line 3: 5 fields"),
        ("0,1,Tail,1,2,3,2\n", "line 3: joint 'Tail' is unknown"),
        ("0,1,Head,1,two,3,2\n", "line 3: y_m is 'two'"),
        ("0,1,Head,1,inf,3,2\n", "line 3: the position is not finite"),
        ("0,1,Head,1,2,,2\n", "line 3: the position is not finite"),
        ("soon,1,Head,1,2,3,2\n", "line 3: t_s is 'soon'"),
        ("nan,1,Head,1,2,3,2\n", "line 3: t_s is 'nan'"),
        ("0,1,Head,1,2,3,3\n", "line 3: state '3' is unknown"),
        ('0,1,"Head,1,2,3,2\n', "line 3: joint '\"Head' is unknown"),
        ("9,1,Neck,1,2,3,2\n", "line 3: this joint is there twice"),
    ],
)
def test_a_broken_line_is_named(make: Make, row: str, says: str) -> None:
    folder = make(SKELETON + "9,1,Neck,1,2,3,2\n" + row + "10,1,Neck,1,2,3,2\n")
    with pytest.raises(RecordingError) as caught:
        read_recording(folder)
    assert f"k.csv, {says}" in str(caught.value)
    assert caught.value.expected
    assert caught.value.remedy


@pytest.mark.parametrize(
    ("manifest", "says"),
    [
        ({"format": "other/2"}, "format is 'other/2'"),
        ({"streams": []}, "lists no streams"),
        ({"streams": [{"file": "k.csv", "kind": "smell"}]}, "kind 'smell' is unknown"),
        ({"streams": [{"file": "../k.csv", "kind": "skeleton"}]}, "file '../k.csv'"),
        ({"streams": [{"file": "gone.csv", "kind": "skeleton"}]}, "gone.csv is missing"),
        ({"streams": [{"file": "k.csv", "kind": "skeleton", "sensor": "a"}] * 2}, "name the same sensor"),
        ({"streams": [{"kind": "skeleton"}]}, "`file`"),
        ({"healthy_side": "both"}, "healthy_side"),
    ],
)
def test_a_broken_manifest_is_named(make: Make, manifest: dict[str, object], says: str) -> None:
    with pytest.raises(RecordingError) as caught:
        read_recording(make(SKELETON, **manifest))
    assert says in str(caught.value)


def test_a_missing_column_is_named(make: Make) -> None:
    with pytest.raises(RecordingError, match="line 1: the column body, state is missing"):
        read_recording(make("t_s,joint,x_m,y_m,z_m\n"))


@pytest.mark.parametrize("content", [b"not gzip", gzip.compress(SKELETON.encode() * 50)[:-20], gzip.compress(b"\xff")])
def test_a_broken_gzip_is_named(make: Make, tmp_path: Path, content: bytes) -> None:
    folder = make(SKELETON, streams=[{"file": "k.csv.gz", "kind": "skeleton"}])
    (tmp_path / "k.csv.gz").write_bytes(content)
    with pytest.raises(RecordingError, match=r"k\.csv\.gz"):
        read_recording(folder)


def test_a_recording_that_is_not_there_is_named(tmp_path: Path) -> None:
    with pytest.raises(RecordingError, match="nothing-here does not exist"):
        read_recording(tmp_path / "nothing-here")


@pytest.mark.recordings
def test_every_real_recording_can_be_read(recordings: Path) -> None:
    for folder in sorted(path.parent for path in recordings.glob("*/recording.json")):
        recording = read_recording(folder)
        streams = recording.skeleton_streams
        assert streams or recording.imu_streams or recording.range_streams
        assert [stream.primary for stream in streams].count(True) == bool(streams)
        assert all(len(stream.samples) > 100 for stream in streams)
