"""Clock offsets, from how joints move and from when frames arrive."""

from __future__ import annotations

import numpy as np
import pytest
from scipy.spatial.transform import Rotation

from fusion.align.space_time import fit_space_time
from fusion.align.timeline import MINIMUM_WINDOW_S, ReceiveClock, offset_candidates
from fusion.align.track import BodyTrack
from fusion.geometry import rotation_angle_rad

TURN, PLACE = Rotation.from_euler("y", -1.55), np.array([2.2, 0.0, 2.3])


def times(until_s, phase_s=0.0):
    return np.arange(phase_s, until_s, 1 / 30)


@pytest.mark.parametrize("offset_s", [0.0, 0.137, -0.21, 3.3, 1.7e9])
def test_speeds_find_an_offset_of_any_size(bodies, offset_s):
    sensor = bodies.track(times(14.0, 0.011), TURN, PLACE, offset_s, noise_m=0.005)
    best = offset_candidates(bodies.track(times(14.0)), sensor)[0]
    assert best.offset_s == pytest.approx(offset_s, abs=0.02)
    assert best.correlation > 0.5


def test_a_hole_in_both_recordings_does_no_harm(bodies):
    room = times(30.0)
    room = room[(room < 9.0) | (room > 21.0)]
    sensor = bodies.track(room + 0.013, TURN, PLACE, -0.4, noise_m=0.005)
    found = fit_space_time(bodies.track(room, noise_m=0.005, seed=5), sensor)
    assert found is not None
    assert found.clock_offset_s == pytest.approx(-0.4, abs=0.01)


def test_offset_and_mounting_are_found_together(bodies):
    reference = bodies.track(times(14.0), noise_m=0.02, seed=1)
    sensor = bodies.track(times(14.0, 0.017), TURN, PLACE, 0.137, noise_m=0.02, seed=2)
    found = fit_space_time(reference, sensor)
    assert found is not None
    assert found.clock_offset_s == pytest.approx(0.137, abs=0.01)
    assert np.degrees(rotation_angle_rad(found.rotation_sensor_to_reference.T @ TURN.as_matrix())) < 0.2
    assert np.linalg.norm(found.in_reference(TURN.inv().apply([0, 0, 2.4] - PLACE)) - [0, 0, 2.4]) < 0.003


def test_somebody_who_keeps_still_is_aligned_in_space_with_the_clocks_as_they_are(bodies):
    still = np.repeat(bodies.body_at(0.0)[None], 200, axis=0)
    state = np.full(still.shape[:2], 2, dtype=np.uint8)
    t_s = times(200 / 30)[:200]
    found = fit_space_time(BodyTrack(t_s, still, state), BodyTrack(t_s, bodies.seen(TURN, PLACE, still), state))
    assert found is not None
    assert abs(found.clock_offset_s) < 0.1
    assert found.residual_m < 1e-6


def test_no_common_time_is_said(bodies):
    assert fit_space_time(bodies.track(times(0.3)), bodies.track(times(0.3))) is None


def test_the_receive_clock_takes_the_least_delay_for_none():
    clock = ReceiveClock()
    delays = [0.030, 0.012, 0.050, 0.010, 0.022]
    told = [clock.on_receive_clock(t, t + 1000.0 + delay) for t, delay in enumerate(delays)]
    assert told[3] == pytest.approx(3 + 1000.010)
    assert told[4] == pytest.approx(4 + 1000.010)
    assert clock.difference_s == pytest.approx(1000.010)
    assert clock.delay_s > 0.0


def test_the_receive_clock_follows_a_clock_that_was_set():
    clock = ReceiveClock()
    clock.on_receive_clock(0.0, 100.0)
    for t_s in np.arange(1.0, 3 * MINIMUM_WINDOW_S):
        last = clock.on_receive_clock(t_s, t_s + 105.0)
    assert last == pytest.approx(t_s + 105.0)


def test_a_sender_without_a_clock_keeps_its_receive_time():
    clock = ReceiveClock()
    assert [clock.on_receive_clock(t, t) for t in (5.0, 5.03, 5.07)] == [5.0, 5.03, 5.07]
    assert clock.delay_s == 0.0
