"""The alignment as it is learnt on the way."""

from __future__ import annotations

import numpy as np
import pytest
from scipy.spatial.transform import Rotation

from fusion.align.learner import EVERY_S, WINDOW_S, AlignmentLearner
from fusion.align.plausible import MIRROR
from fusion.align.track import BodyTrack
from fusion.geometry import rotation_angle_rad
from fusion.skeleton import SIDES_SWAPPED

TURN, PLACE = Rotation.from_euler("y", 1.5), np.array([-2.2, 0.1, 2.2])
ELSEWHERE = Rotation.from_euler("y", 1.0)


def live(learner, reference, sensor, until_s, from_s=1.0):
    """Feed growing tracks as a station would."""
    for now in np.arange(from_s, until_s, EVERY_S):
        windows = [
            BodyTrack(t.t_s[k], t.positions[k], t.state[k])
            for t in (reference, sensor)
            for k in [(t.t_s <= now) & (t.t_s > now - WINDOW_S)]
        ]
        learner.learn(*windows)


def angle_deg(learner, rotation):
    return np.degrees(rotation_angle_rad(learner.alignment.rotation_sensor_to_reference.T @ rotation.as_matrix()))


@pytest.fixture
def times():
    return np.arange(0.0, 40.0, 1 / 30)


def test_three_seconds_of_movement_are_enough_and_more_is_better(bodies, times):
    reference = bodies.track(times, noise_m=0.02, seed=1)
    sensor = bodies.track(times + 0.011, TURN, PLACE, 0.137, noise_m=0.02, seed=2)
    learner = AlignmentLearner()
    live(learner, reference, sensor, 3.0)
    assert learner.alignment is not None
    assert angle_deg(learner, TURN) < 3.0
    live(learner, reference, sensor, 35.0, 3.0)
    assert angle_deg(learner, TURN) < 0.5
    assert learner.alignment.clock_offset_s == pytest.approx(0.137, abs=0.015)
    assert learner.alignment.frames > 400


def test_a_sensor_that_was_moved_is_noticed_and_learnt_anew(bodies, times):
    reference = bodies.track(times, noise_m=0.02, seed=1)
    before = bodies.track(times, TURN, PLACE, noise_m=0.02, seed=2)
    after = bodies.track(times, ELSEWHERE, PLACE, noise_m=0.02, seed=2)
    moved = BodyTrack(times, np.where((times < 20.0)[:, None, None], before.positions, after.positions), before.state)
    learner = AlignmentLearner()
    live(learner, reference, moved, 20.0)
    assert angle_deg(learner, TURN) < 1.0
    seen_moved = False
    for until_s in np.arange(21.0, 30.0):
        live(learner, reference, moved, until_s, until_s - 1.0)
        seen_moved |= learner.moved
    assert seen_moved
    assert angle_deg(learner, ELSEWHERE) < 1.5


@pytest.mark.parametrize("spoil", [lambda p: p * MIRROR, lambda p: p[:, SIDES_SWAPPED]])
def test_a_sensor_that_is_mirrored_or_has_its_sides_exchanged_is_never_trusted(bodies, times, spoil):
    reference = bodies.track(times, noise_m=0.02, seed=1)
    right = bodies.track(times, TURN, PLACE, noise_m=0.02, seed=2)
    learner = AlignmentLearner()
    live(learner, reference, BodyTrack(times, spoil(right.positions), right.state), 10.0)
    assert learner.alignment is None
    assert learner.fault is not None


def test_standing_still_neither_drifts_nor_weighs_down_what_comes_later(bodies, times):
    """Errors that a pose brings do not average out while it is kept."""
    lean = np.random.default_rng(3).normal(0, 0.05, (1, 25, 3))
    moving = bodies.track(np.maximum(times - 20.0, 0.0), TURN, PLACE, noise_m=0.005, seed=2)
    reference = bodies.track(np.maximum(times - 20.0, 0.0), noise_m=0.005, seed=1)
    still = (times < 20.0)[:, None, None]
    sensor = BodyTrack(times, moving.positions + np.where(still, lean, 0.0), moving.state)
    reference = BodyTrack(times, reference.positions, reference.state)
    learner = AlignmentLearner()
    live(learner, reference, sensor, 20.0)
    assert abs(learner.alignment.clock_offset_s) < 0.05
    bent_deg = angle_deg(learner, TURN)
    assert bent_deg > 1.0
    live(learner, reference, sensor, 32.0, 20.0)
    assert angle_deg(learner, TURN) < 0.25 * bent_deg


def test_two_different_people_are_not_aligned(bodies, times):
    reference = bodies.track(times, noise_m=0.02, seed=1)
    stranger = bodies.track(times + 7.3, TURN, PLACE, noise_m=0.02, seed=2, walk_m=1.2)
    learner = AlignmentLearner()
    live(learner, reference, BodyTrack(times, stranger.positions, stranger.state), 8.0)
    assert learner.alignment is None
