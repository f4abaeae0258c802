"""Range streams: read, refused with their line, and the same again from either form."""

from __future__ import annotations

import json

import numpy as np
import pytest

from fusion.errors import RecordingError
from fusion.recording.reader import read_recording
from fusion.recording.writer import write_recording

ANCHORS = {"A0": [0.0, 0.0, 1.0], "A1": [3.0, 0.0, 1.0]}


@pytest.fixture
def make(tmp_path):
    """Writes a recording with one range stream."""

    def write(lines, up="z", **stream):
        (tmp_path / "r.csv").write_text("t_s,anchor,tag,range_m\n" + lines)
        entry = {"file": "r.csv", "kind": "range", "anchors": ANCHORS, "tags": ["T0", "T1"]} | stream
        manifest = {"format": "mirrorlimb-recording/1", "name": "n", "up": up, "streams": [entry]}
        (tmp_path / "recording.json").write_text(json.dumps(manifest))
        return tmp_path

    return write


LINES = "0.2,A1,T0,2.5\n0.1,A0,T1,1.25\n0.1,A1,T1,3\n"


def test_ranges_are_sorted_by_time_and_name_anchor_and_tag(make):
    (stream,) = read_recording(make(LINES)).range_streams
    np.testing.assert_array_equal(stream.t_s, [0.1, 0.1, 0.2])
    np.testing.assert_array_equal(stream.anchor, [0, 1, 1])
    np.testing.assert_array_equal(stream.tag, [1, 1, 0])
    np.testing.assert_array_equal(stream.range_m, [1.25, 3, 2.5])
    np.testing.assert_array_equal(stream.anchor_positions, list(ANCHORS.values()))


@pytest.mark.parametrize("name", ["log.mcap", "folder"])
def test_either_form_gives_the_ranges_back(make, tmp_path, name):
    recording = read_recording(make(LINES))
    write_recording(recording, tmp_path / name)
    (before,), (after,) = recording.range_streams, read_recording(tmp_path / name).range_streams
    assert (after.anchors, after.tags) == (before.anchors, before.tags)
    for field in ("anchor_positions", "t_s", "anchor", "tag", "range_m"):
        np.testing.assert_array_equal(getattr(after, field), getattr(before, field))


@pytest.mark.parametrize(
    ("line", "says"),
    [
        ("0.3,A9,T0,1\n", "line 5: anchor 'A9' is unknown"),
        ("0.3,A0,T9,1\n", "line 5: tag 'T9' is unknown"),
        ("0.3,A0,T0,-1\n", "line 5: range_m is '-1'"),
        ("0.3,A0,T0,\n", "line 5: range_m is ''"),
        ("nan,A0,T0,1\n", "line 5: t_s is 'nan'"),
    ],
)
def test_a_broken_line_is_named(make, line, says):
    with pytest.raises(RecordingError, match=r"r\.csv") as caught:
        read_recording(make(LINES + line))
    assert says in str(caught.value)


def test_a_range_stream_names_its_anchors_and_stands_upright(make):
    with pytest.raises(RecordingError, match="names no anchors"):
        read_recording(make(LINES, anchors={}))
    with pytest.raises(RecordingError, match="up is 'y'"):
        read_recording(make(LINES, up="y"))
