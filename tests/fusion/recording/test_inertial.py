"""Inertial streams and true orientations: read, refused with their line, kept by both forms of a recording."""

import json
from pathlib import Path

import numpy as np
import pytest
from numpy.testing import assert_allclose

from fusion.errors import RecordingError
from fusion.recording.reader import ImuStream, OrientationTruth, Recording, read_recording
from fusion.recording.writer import write_recording

HEADER = "t_s,gx_rad_s,gy_rad_s,gz_rad_s,ax_m_s2,ay_m_s2,az_m_s2\n"
GOOD = "0.00,1,2,3,4,5,6\n0.01,1,2,3,4,5,6\n"


def folder(tmp_path: Path, text: str, *sites: str) -> Path:
    (tmp_path / "imu.csv").write_text(text)
    streams = [{"file": "imu.csv", "kind": "imu", "site": site} for site in sites or ("hand-left",)]
    whole = {"format": "mirrorlimb-recording/1", "name": "n", "streams": streams}
    (tmp_path / "recording.json").write_text(json.dumps(whole))
    return tmp_path


def test_an_imu_stream_is_read_and_what_it_lacks_is_none(tmp_path: Path) -> None:
    (stream,) = read_recording(folder(tmp_path, HEADER + GOOD)).imu_streams
    assert stream.site == "hand-left"
    assert_allclose(stream.t_s, [0, 0.01])
    assert_allclose(stream.gyro_rad_s, [[1, 2, 3]] * 2)
    assert_allclose(stream.accel_m_s2, [[4, 5, 6]] * 2)
    assert stream.magnet_ut is None
    assert stream.orientation is None


@pytest.mark.parametrize(
    ("text", "says"),
    [
        (HEADER + GOOD + "0.02,1,2,nan,4,5,6\n", "line 4: gx_rad_s,gy_rad_s,gz_rad_s is not finite"),
        (HEADER + GOOD + "0.02,1,2,3,4,5,\n", "line 4: ax_m_s2,ay_m_s2,az_m_s2 is not finite"),
        (HEADER + GOOD + "0.01,1,2,3,4,5,6\n", "line 4: t_s is '0.01'"),
        (HEADER + GOOD + "nan,1,2,3,4,5,6\n", "line 4: t_s is 'nan'"),
        (HEADER.replace("gz_rad_s", "gz"), "line 1: the column gz_rad_s is missing"),
        ("mx_uT," + HEADER + "7," + GOOD, "line 1: the column my_uT, mz_uT is missing"),
    ],
)
def test_what_cannot_be_used_is_named_with_its_line(tmp_path: Path, text: str, says: str) -> None:
    with pytest.raises(RecordingError, match=says):
        read_recording(folder(tmp_path, text))


@pytest.mark.parametrize("sites", [("hand-left", "hand-left"), ("",)])
def test_every_imu_stream_has_a_site_of_its_own(tmp_path: Path, sites: tuple[str, ...]) -> None:
    with pytest.raises(RecordingError, match="site"):
        read_recording(folder(tmp_path, HEADER + GOOD, *sites))


@pytest.mark.parametrize("form", ["copy", "copy.mcap"])
def test_both_forms_keep_inertial_streams(tmp_path: Path, form: str) -> None:
    rng = np.random.default_rng(1)
    t_s = np.arange(700) / 100
    vectors = rng.normal(size=(5, 700, 3))
    quaternion = rng.normal(size=(700, 4))
    bare = ImuStream("hand-left", t_s, vectors[0], vectors[1])
    full = ImuStream("upper back", t_s, vectors[2], vectors[3], vectors[4], quaternion)
    known = np.where(rng.random((700, 1)) < 0.3, np.nan, quaternion)
    truth = OrientationTruth(t_s, known, rng.random(700) < 0.5)
    source = Recording("n", "", None, (), None, (), tmp_path, imu_streams=(bare, full), orientation_truth=truth)
    write_recording(source, tmp_path / form)
    read = read_recording(tmp_path / form)
    assert [stream.site for stream in read.imu_streams] == ["hand-left", "upper back"]
    for one, other in zip(source.imu_streams, read.imu_streams, strict=True):
        for name in ("t_s", "gyro_rad_s", "accel_m_s2", "magnet_ut", "orientation"):
            a, b = getattr(one, name), getattr(other, name)
            assert (a is None) == (b is None)
            if a is not None:
                assert_allclose(a, b, atol=6e-7)
    assert read.orientation_truth is not None
    assert_allclose(read.orientation_truth.orientation, truth.orientation, atol=6e-7)
    assert (read.orientation_truth.moving == truth.moving).all()


@pytest.mark.recordings
def test_the_real_ones_are_read(recordings: Path) -> None:
    assert len(read_recording(recordings / "imu-both-arms").imu_streams) == 7
    broad = read_recording(recordings / "imu-broad-02")
    assert broad.imu_streams[0].magnet_ut is not None
    assert broad.orientation_truth is not None
    assert broad.orientation_truth.moving.sum() > 1e4
