"""Alignment of real recordings, mounting and clocks unknown, against the best that one rigid fit can do."""

from __future__ import annotations

from functools import cache

import numpy as np
import pytest

from fusion.align.track import BodyTrack
from fusion.align.whole import align_streams
from fusion.geometry import nearest_rotation, rotation_angle_rad
from fusion.recording.reader import read_recording
from fusion.skeleton import INDEX

pytestmark = pytest.mark.recordings

TRUE_OFFSET_S = 0.137
LONG_STUDIES = [
    f"dual-kinect-study{person}-{angle}" for person in ("07", "10", "12") for angle in ("parallel", "45deg", "90deg")
]
TRUTHS = [
    f"dual-kinect-truth-{take}"
    for take in ("m07-s02", "m07-s04", "m08-s04", "m09-s02", "m09-s04", "m10-s02", "m10-s04")
]


@pytest.fixture(scope="session")
def aligned(recordings):
    """A recording with its streams aligned; each is read and aligned once."""

    @cache
    def make(name):
        recording = read_recording(recordings / name)
        reference = next(stream.sensor for stream in recording.skeleton_streams if stream.primary)
        return recording, align_streams(recording.skeleton_streams, reference)

    return make


def other_sensor(recording):
    return next(stream for stream in recording.skeleton_streams if not stream.primary)


def kabsch(ours, theirs):
    """The plain best rigid fit: ours = R theirs + T."""
    a, b = ours.mean(axis=0), theirs.mean(axis=0)
    rotation = nearest_rotation((ours - a).T @ (theirs - b))
    return rotation, a - rotation @ b


def truth_at(recording, t_s):
    """True joints (N, 25, 3) at instants on the reference's clock; NaN where there is no truth."""
    truth = recording.truth
    found = np.full((len(t_s), len(INDEX), 3), np.nan)
    for k, joint in enumerate(truth.joints):
        for axis in range(3):
            found[:, INDEX[joint], axis] = np.interp(t_s, truth.t_s, truth.positions[:, k, axis], np.nan, np.nan)
    return found


@pytest.mark.parametrize("name", TRUTHS)
def test_mounting_and_clock_agree_with_the_truth(aligned, name):
    recording, found = aligned(name)
    stream = other_sensor(recording)
    alignment, track = found.alignments[stream.sensor], BodyTrack.of(stream.samples)
    true = truth_at(recording, track.t_s - TRUE_OFFSET_S)
    # Wandering joints say they are tracked; the best fit is the fit to those that are where they say.
    rotation, translation, used = np.eye(3), np.zeros(3), (track.state == 2) & np.isfinite(true).all(axis=2)
    for cut_m in (np.inf, 0.3, 0.15, 0.1):
        near = np.linalg.norm(true - (track.positions @ rotation.T + translation), axis=2) < cut_m
        keep = used & near if np.isfinite(cut_m) else used
        rotation, translation = kabsch(true[keep], track.positions[keep])
    body = np.median(track.positions[used], axis=0)
    apart = np.linalg.norm(alignment.in_reference(body) - (rotation @ body + translation))
    turned = rotation_angle_rad(alignment.rotation_sensor_to_reference.T @ rotation)
    assert np.degrees(turned) < 0.5
    assert apart < 0.010
    assert alignment.clock_offset_s == pytest.approx(TRUE_OFFSET_S, abs=0.015)


@pytest.mark.parametrize("name", LONG_STUDIES)
def test_joints_are_no_further_apart_than_one_best_rigid_fit_leaves_them(aligned, name):
    recording, found = aligned(name)
    stream = other_sensor(recording)
    alignment = found.alignments[stream.sensor]
    reference = next(BodyTrack.of(s.samples) for s in recording.skeleton_streams if s.primary)
    sensor, _ = BodyTrack.of(stream.samples).at(reference.t_s + alignment.clock_offset_s)
    both = np.isfinite(sensor + reference.positions).all(axis=2)
    ours, theirs = reference.positions[both], sensor[both]
    rotation, translation = kabsch(ours, theirs)
    best = np.median(np.linalg.norm(ours - (theirs @ rotation.T + translation), axis=1))
    left = np.median(np.linalg.norm(ours - alignment.in_reference(theirs), axis=1))
    assert left <= 1.1 * best
    assert both.any(axis=1).mean() > 0.8


@pytest.mark.parametrize("name", [*LONG_STUDIES, "dual-kinect-study01-obstacle"])
def test_no_real_sensor_is_suspected(aligned, name):
    assert aligned(name)[1].faults == {}


def test_two_people_are_told_apart_by_how_they_move(aligned):
    recording, found = aligned("dual-kinect-study22-two-people-45deg")
    alignment = found.alignments[other_sensor(recording).sensor]
    assert alignment.residual_m < 0.04
    assert abs(alignment.clock_offset_s) < 0.1
