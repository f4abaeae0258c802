"""Whole recordings through the pipeline."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest
from scipy.spatial.transform import Rotation

from fusion.errors import InputError, RecordingError
from fusion.offline import fuse_recording
from fusion.recording.recording import Recording, SkeletonStream
from fusion.skeleton import INDEX, Side

TURN, PLACE, OFFSET_S = Rotation.from_euler("y", 1.5), (-2.2, 0.1, 2.2), 0.137
TIMES = np.arange(0.0, 8.0, 1 / 30)
HAND = INDEX["HandRight"]


@pytest.fixture
def recording(bodies):
    first = bodies.samples("one", bodies.track(TIMES, noise_m=0.01, seed=1))
    second = bodies.samples("two", bodies.track(TIMES + 0.011, TURN, PLACE, OFFSET_S, noise_m=0.01, seed=2))
    streams = tuple(
        SkeletonStream(name, name == "one", "sensor", tuple(samples))
        for name, samples in (("one", first), ("two", second))
    )
    return Recording("made", "", Side.RIGHT, streams, None, (), Path())


def hand_errors(bodies, fused, moved_s=0.0):
    true = np.array([bodies.body_at(t - moved_s)[HAND] for t in fused.t_s])
    return np.linalg.norm(fused.positions[:, HAND] - true, axis=1)


def test_the_grid_is_steady_from_the_references_first_to_its_last_frame(recording):
    fused = fuse_recording(recording, "kalman")
    assert fused.reference == "one"
    assert fused.t_s[0] == TIMES[0]
    assert TIMES[-1] - fused.t_s[-1] < 1 / 30
    np.testing.assert_allclose(np.diff(fused.t_s), 1 / 30)
    assert np.isfinite(fused.positions).all()


@pytest.mark.parametrize("causal", [False, True])
def test_unknown_mounting_and_clock_do_not_show_in_the_body(bodies, recording, causal):
    fused = fuse_recording(recording, "kalman", causal=causal)
    assert np.median(hand_errors(bodies, fused)[90:]) < 0.02
    two = next(sensor for sensor in fused.sensors if sensor.sensor == "two")
    assert two.alignment is not None
    assert two.alignment.clock_offset_s == pytest.approx(OFFSET_S, abs=0.02)
    assert two.frames == len(TIMES)


@pytest.mark.parametrize("causal", [False, True])
def test_a_recording_gives_the_same_ticks_twice(recording, causal):
    first, second = (fuse_recording(recording, "set-membership", causal=causal) for _ in range(2))
    for name in ("t_s", "positions", "bound_m", "state"):
        np.testing.assert_array_equal(getattr(first, name), getattr(second, name))
    assert [repr(told) for told in first.healthy] == [repr(told) for told in second.healthy]
    assert [repr(told) for told in first.target] == [repr(told) for told in second.target]
    assert any(target is not None and target.valid for target in first.target)
    assert [sensor.refusals for sensor in first.sensors] == [sensor.refusals for sensor in second.sensors]


def blind(recording, from_s, to_s):
    """The recording without the first sensor's frames between two times."""
    one, two = recording.skeleton_streams
    left = tuple(sample for sample in one.samples if not from_s < sample.t_s < to_s)
    return replace(recording, skeleton_streams=(replace(one, samples=left), two))


def test_live_a_clock_that_is_off_costs_nothing_and_late_frames_their_lateness(bodies, recording):
    """While the first sensor sees nothing, the body is told from the second one's latest frame."""
    gap = slice(int(5.3 * 30), int(6.3 * 30))
    recording = blind(recording, 5.0, 6.5)
    by_stamps = fuse_recording(recording, "kalman", causal=True)
    assert np.median(hand_errors(bodies, by_stamps)[gap]) < 0.02
    one, two = recording.skeleton_streams
    late = replace(two, samples=tuple(replace(s, t_received_s=s.t_s - OFFSET_S + 0.2) for s in two.samples))
    came = fuse_recording(replace(recording, skeleton_streams=(one, late), arrivals_known=True), "kalman", causal=True)
    told = hand_errors(bodies, came)[gap]
    assert 0.03 < np.median(told) < 0.3
    assert np.median(hand_errors(bodies, came, moved_s=0.2)[gap]) < np.median(told)


def test_the_other_sensor_as_reference_gives_its_frame_and_clock(bodies, recording):
    fused = fuse_recording(recording, "kalman", reference="two")
    in_two = bodies.seen(TURN, np.array(PLACE), np.array([bodies.body_at(t - OFFSET_S) for t in fused.t_s]))
    assert np.median(np.linalg.norm(fused.positions - in_two, axis=2)) < 0.02


def test_one_sensor_alone_is_told_in_the_references_frame(bodies, recording):
    fused = fuse_recording(recording, "kalman", only_sensor="two")
    assert np.median(hand_errors(bodies, fused)) < 0.02
    assert next(sensor for sensor in fused.sensors if sensor.sensor == "one").refusals == {}


def test_a_joint_not_seen_at_first_is_held_at_its_first_position(recording):
    def blind(sample):
        state = sample.state.copy()
        state[HAND] = 0
        return replace(sample, state=state) if sample.t_s < 2.0 else sample

    streams = tuple(replace(s, samples=tuple(map(blind, s.samples))) for s in recording.skeleton_streams)
    fused = fuse_recording(replace(recording, skeleton_streams=streams), "kalman")
    early = fused.t_s < 1.9
    assert (fused.state[early, HAND] == 0).all()
    assert (fused.positions[early, HAND] == fused.positions[0, HAND]).all()
    assert np.isinf(fused.bound_m[early, HAND]).all()
    assert (fused.state[fused.t_s > 2.2, HAND] == 2).all()


def test_a_sender_in_millimetres_is_left_out_and_named(bodies, recording):
    one, two = recording.skeleton_streams
    wrong = replace(
        two, samples=tuple(replace(s, positions_in_sensor=s.positions_in_sensor * 1e3) for s in two.samples)
    )
    fused = fuse_recording(replace(recording, skeleton_streams=(one, wrong)), "kalman")
    assert any("millimetres" in warning for sensor in fused.sensors for warning in sensor.warnings)
    assert np.median(hand_errors(bodies, fused)) < 0.03


def test_clocks_that_share_no_span_are_no_obstacle(bodies, recording):
    one, two = recording.skeleton_streams
    moved = replace(two, samples=tuple(replace(s, t_s=s.t_s + 1.7e9) for s in two.samples))
    for causal in (False, True):
        fused = fuse_recording(replace(recording, skeleton_streams=(one, moved)), "kalman", causal=causal)
        assert np.median(hand_errors(bodies, fused)[90:]) < 0.02


def test_what_cannot_be_fused_is_refused_with_the_names_that_could(recording):
    with pytest.raises(InputError, match="one, two"):
        fuse_recording(recording, "kalman", reference="three")
    with pytest.raises(InputError, match="kalman"):
        fuse_recording(recording, "magic")
    with pytest.raises(RecordingError):
        fuse_recording(replace(recording, skeleton_streams=()), "kalman")


def test_progress_ends_at_one(recording):
    told = []
    fuse_recording(recording, "average", progress=told.append)
    assert told == sorted(told)
    assert told[-1] == 1.0


def test_when_every_sensor_is_in_millimetres_the_reason_is_named(recording):
    streams = tuple(
        replace(
            stream,
            samples=tuple(replace(one, positions_in_sensor=one.positions_in_sensor * 1000) for one in stream.samples),
        )
        for stream in recording.skeleton_streams
    )
    with pytest.raises(RecordingError, match="no sensor can be used"):
        fuse_recording(replace(recording, skeleton_streams=streams), "kalman")
