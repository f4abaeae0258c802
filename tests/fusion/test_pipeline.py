"""The pipeline as the station drives it: samples in as they come, one frame out per tick."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest
from scipy.spatial.transform import Rotation

from fusion.align.plausible import MIRROR
from fusion.errors import InputError
from fusion.pipeline import Pipeline, PipelineSettings
from fusion.skeleton import INDEX, SIDES_SWAPPED, Side

TURN, PLACE = Rotation.from_euler("y", 1.5), (-2.2, 0.1, 2.2)
ASIDE = np.array([1.0, 0.0, 0.7])
HAND = INDEX["HandRight"]


def settings(**wanted):
    return PipelineSettings(Side.RIGHT, **{"method": "kalman", **wanted})


def live(pipeline, samples, until_s, from_s=0.0, rate_hz=30.0):
    """Drive a pipeline by hand; every frame it gave. Samples are (arrival, sample)."""
    waiting = sorted(samples, key=lambda item: item[0])
    waiting = [item for item in waiting if item[0] > from_s]
    frames = []
    for now in np.arange(from_s, until_s, 1 / rate_hz):
        while waiting and waiting[0][0] <= now:
            pipeline.take(waiting.pop(0)[1])
        frames.append(pipeline.step(float(now)))
    return frames


@pytest.fixture
def room(bodies):
    """Two sensors without clocks of their own; the second one's frames arrive 137 ms late."""

    def make(until_s=8.0, delay_s=0.137, seen=lambda t_s: True, second=lambda samples: samples):
        times = np.array([t for t in np.arange(0.0, until_s, 1 / 30) if seen(t)])
        first = bodies.samples("left", bodies.track(times, noise_m=0.01, seed=1))
        other = bodies.samples("right", bodies.track(times + 0.013, TURN, PLACE, noise_m=0.01, seed=2))
        late = [replace(s, t_s=s.t_s + delay_s, t_received_s=s.t_s + delay_s) for s in other]
        return [(s.t_received_s, s) for s in [*first, *second(late)]]

    return make


def quality(frame, sensor):
    return next(q for q in frame.sensors if q.sensor == sensor)


def test_two_unknown_sensors_are_aligned_and_fused_while_they_come(bodies, room):
    frames = live(Pipeline(settings()), room(), 8.0)
    last = frames[-1]
    assert quality(last, "left").is_reference
    assert quality(last, "right").aligned
    assert quality(last, "right").clock_offset_s == pytest.approx(0.137, abs=0.03)
    assert quality(last, "right").latency_s == pytest.approx(0.137, abs=0.03)
    assert quality(last, "left").latency_s == 0.0
    assert quality(last, "right").frames_per_s == pytest.approx(30.0, abs=1.0)
    errors = [np.linalg.norm(f.fused.positions_in_room[HAND] - bodies.body_at(f.t_s)[HAND]) for f in frames[150:]]
    assert np.median(errors) < 0.03
    assert {sample.sensor for sample in last.samples} == {"left", "right"}
    assert last.healthy is not None
    assert last.healthy.valid
    assert last.target is not None
    assert last.target.side is Side.LEFT


def test_a_faster_sensor_is_the_present(bodies, room):
    """The reference lags by 137 ms: the body is told where the faster sensor sees it, not where the reference does."""
    slow = [(t, s) for t, s in room(8.0, delay_s=-0.137) if t > 0]
    frames = live(Pipeline(settings(reference="left")), slow, 8.0)
    errors = [
        np.linalg.norm(f.fused.positions_in_room[HAND] - bodies.body_at(f.t_s + 0.137)[HAND]) for f in frames[180:]
    ]
    assert np.median(errors) < 0.03


def test_one_sensor_is_enough(room):
    alone = [item for item in room(4.0) if item[1].sensor == "left"]
    last = live(Pipeline(settings()), alone, 4.0)[-1]
    assert last.fused is not None
    assert quality(last, "left").aligned
    assert last.healthy is not None


def test_one_silent_sensor_is_told_and_the_other_goes_on(room):
    samples = [item for item in room(9.0) if item[1].sensor == "left" or item[0] < 6.0]
    last = live(Pipeline(settings()), samples, 9.0)[-1]
    assert last.fused is not None
    assert any("silent" in warning for warning in quality(last, "right").warnings)
    assert quality(last, "left").warnings == ()


def test_nothing_is_told_of_a_body_that_nobody_sees_and_its_return_is_no_jump(bodies, room):
    pipeline = Pipeline(settings())
    samples = room(14.0, seen=lambda t: not 6.0 < t < 10.0)
    frames = live(pipeline, samples, 14.0)
    in_hole = [f for f in frames if 7.0 < f.t_s < 10.0]
    assert all(f.fused is None and f.healthy is None and f.target is None for f in in_hole)
    back = [f for f in frames if 10.3 < f.t_s < 13.9]
    errors = [np.linalg.norm(f.fused.positions_in_room[HAND] - bodies.body_at(f.t_s)[HAND]) for f in back]
    assert max(errors) < 0.25
    assert np.median(errors) < 0.03


def test_a_mirrored_sender_is_refused_with_a_reason(room):
    spoilt = room(
        8.0, second=lambda late: [replace(s, positions_in_sensor=s.positions_in_sensor * MIRROR) for s in late]
    )
    last = live(Pipeline(settings(reference="left")), spoilt, 8.0)[-1]
    assert not quality(last, "right").aligned
    assert any("mirror" in warning for warning in quality(last, "right").warnings)
    assert {sample.sensor for sample in last.samples} == {"left"}


def test_millimetres_are_refused_and_the_other_sensor_becomes_the_reference(room):
    def spoil(samples):
        return [
            (t, replace(s, positions_in_sensor=s.positions_in_sensor * 1000.0) if s.sensor == "left" else s)
            for t, s in samples
        ]

    last = live(Pipeline(settings()), spoil(room(6.0)), 6.0)[-1]
    assert quality(last, "right").is_reference
    assert any("millimetres" in warning for warning in quality(last, "left").warnings)
    assert last.fused is not None


def test_a_moment_of_exchanged_sides_does_not_move_the_hand(bodies, room):
    def swap(samples):
        return [
            (t, replace(s, positions_in_sensor=s.positions_in_sensor[SIDES_SWAPPED]) if 5.0 < t < 5.4 else s)
            for t, s in samples
        ]

    alone = [item for item in room(7.0) if item[1].sensor == "left"]
    pipeline = Pipeline(settings())
    frames = live(pipeline, swap(alone), 7.0)
    errors = [np.linalg.norm(f.fused.positions_in_room[HAND] - bodies.body_at(f.t_s)[HAND]) for f in frames[90:]]
    assert max(errors) < 0.15
    assert any("exchanged" in reason for reason in pipeline.refusals()["left"])


def test_a_bystander_is_not_fused_until_a_person_chooses_them(bodies):
    times = np.arange(0.0, 6.0, 1 / 30)
    patient = bodies.samples("left", bodies.track(times), body="1")
    bystander = [
        replace(s, body="2", positions_in_sensor=s.positions_in_sensor + ASIDE)
        for s in bodies.samples("left", bodies.track(times))
    ]
    samples = [(s.t_s, s) for s in [*patient, *bystander]]
    pipeline = Pipeline(settings())
    before = live(pipeline, samples, 3.0)[-1]
    assert np.linalg.norm(before.fused.positions_in_room[0] - bodies.body_at(3.0)[0]) < 0.05
    pipeline.follow("left", "2")
    after = live(pipeline, samples, 5.0, from_s=3.0)[-1]
    assert np.linalg.norm(after.fused.positions_in_room[0] - bodies.body_at(5.0)[0] - ASIDE) < 0.05
    assert pipeline.refusals()["left"]["another person: seen beside the patient"] > 100


def test_two_bodies_of_one_frame_are_one_frame(bodies):
    times = np.arange(0.0, 3.0, 1 / 30)
    one, other = (bodies.samples("left", bodies.track(times), body=body) for body in "12")
    later = [(s.t_s + 0.005, replace(s, t_s=s.t_s + 0.005)) for s in other]
    last = live(Pipeline(settings()), [*((s.t_s, s) for s in one), *later], 3.0)[-1]
    assert quality(last, "left").frames_per_s == pytest.approx(30.0, abs=1.0)


def test_a_sender_with_a_clock_of_its_own_needs_no_help(bodies, room):
    own = [(t, replace(s, t_s=s.t_s + 5000.0) if s.sensor == "right" else s) for t, s in room(7.0)]
    last = live(Pipeline(settings()), own, 7.0)[-1]
    assert quality(last, "right").aligned
    assert quality(last, "right").clock_offset_s == pytest.approx(5000.137, abs=0.03)


def test_an_unknown_method_names_the_known_ones():
    with pytest.raises(InputError, match="kalman"):
        Pipeline(settings(method="magic"))


def test_nothing_seen_is_nothing_told():
    frame = Pipeline(settings()).step(1.0)
    assert frame.fused is None
    assert frame.sensors == ()
    assert np.isnan(frame.newest_received_s)
