"""What the sensors say of left and right while people walk, before and after mending."""

from __future__ import annotations

import numpy as np
import pytest

from fusion.align.opposed import Opposition, opposition, opposition_in
from fusion.recording.reader import read_recording

from .turning import as_a_kinect_names, watched

WALKS = [f"dual-kinect-study{study}-90deg" for study in ("07", "10", "12")]
OTHERS = [f"dual-kinect-study{study}-{angle}" for study in ("07", "10", "12") for angle in ("45deg", "parallel")]


def counted(folder) -> Opposition:
    streams = read_recording(folder).skeleton_streams
    return opposition(streams, next(stream.sensor for stream in streams if stream.primary))


def circling(body, names):
    """Somebody who walks in a circle before two sensors."""

    def path(t_s):
        heading = np.pi - 1.2 * t_s
        return heading, (0.5 * np.cos(heading), -0.5 * np.sin(heading))

    return [seen.frame for seen in watched(body, path, 12.0, names=names)]


def test_a_circle_before_sensors_that_take_backs_for_fronts_is_opposed_before_and_not_after(bodies):
    found = opposition_in(circling(bodies.BODY, as_a_kinect_names), "front")
    before, after, refused = found.shares
    assert found.pairs > 300
    assert before > 0.4
    assert after < 0.01
    assert refused < 0.02


def test_a_circle_before_sensors_that_name_rightly_is_left_alone(bodies):
    found = opposition_in(circling(bodies.BODY, lambda positions, _: positions), "front")
    assert (found.opposed_before, found.frames_mended, found.frames_refused) == (0, 0, 0)


def test_counts_add_up():
    one = Opposition(10, 4, 1, 2, 50, 5, 3)
    assert one + one == Opposition(20, 8, 2, 4, 100, 10, 6)
    assert one.shares == (0.4, 0.1, 0.2)


@pytest.mark.recordings
def test_walking_at_right_angles_is_hardly_ever_opposed_once_mended_and_seldom_refused(recordings):
    found = [counted(recordings / name) for name in WALKS]
    before, after, refused = sum(found[1:], found[0]).shares
    assert before > 0.15
    assert after < 0.01
    assert refused < 0.05
    assert all(one.shares[1] < 0.01 and one.shares[2] < 0.05 for one in found)


@pytest.mark.recordings
@pytest.mark.parametrize("name", OTHERS)
def test_other_angles_are_no_worse(recordings, name):
    _, after, refused = counted(recordings / name).shares
    assert after < 0.01
    assert refused < 0.05


@pytest.mark.recordings
def test_nothing_is_mended_where_people_sit_and_exercise(recordings):
    for folder in sorted(recordings.glob("dual-kinect-truth-*")):
        found = counted(folder)
        assert (found.frames_mended, found.frames_refused) == (0, 0)
