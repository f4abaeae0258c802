"""One arm from tick to tick: what is known when, and what ends with the body."""

from __future__ import annotations

from math import pi

import numpy as np

from fusion.kinematics.follower import ArmFollower, Followed
from fusion.messages import AlignedSample, FusedFrame
from fusion.skeleton import JOINT_COUNT, Side
from fusion.virtual_patient.sensor import NO_NOISE
from fusion.virtual_patient.trial import virtual_recording

STANDING = virtual_recording(1, 0.02, noise=NO_NOISE).truth.positions[0]
TRACKED = np.full(JOINT_COUNT, 2, np.uint8)
SETS = np.tile(0.13**2 * np.eye(3), (JOINT_COUNT, 1, 1)), np.full(JOINT_COUNT, 0.13)


def told(t_s: float) -> FusedFrame:
    return FusedFrame(t_s, STANDING, *SETS, TRACKED)


def seen(sensor: str, t_s: float) -> AlignedSample:
    return AlignedSample(sensor, t_s, t_s, STANDING, TRACKED, np.zeros(3), np.eye(3))


def after(seconds: float, sensors: str = "ab") -> tuple[ArmFollower, Followed]:
    follower = ArmFollower(Side.LEFT)
    for k in range(int(seconds * 100) + 1):
        found = follower.follow(told(k / 100), tuple(seen(sensor, k / 100) for sensor in sensors))
    return follower, found


def test_a_trunk_is_told_at_once_and_angles_once_the_lengths_are_known() -> None:
    _, first = after(0.0)
    assert first.trunk is not None
    assert (first.lengths, first.healthy, first.target) == (None, None, None)
    _, later = after(1.5)
    assert later.lengths is not None
    assert later.healthy is not None
    assert later.target is not None
    assert later.target.side is Side.RIGHT


def test_witnesses_make_bounds_that_the_sets_alone_would_not() -> None:
    _, with_sensors = after(5.0)
    _, without = after(5.0, sensors="")
    assert with_sensors.healthy is not None
    assert without.healthy is not None
    assert with_sensors.healthy.swing_bound_rad < 0.35
    assert without.healthy.swing_bound_rad > 1.0


def test_without_a_body_nothing_is_told_but_what_was_learnt_stays() -> None:
    follower, before = after(2.0)
    gone = follower.follow(None, ())
    assert (gone.trunk, gone.healthy, gone.target) == (None, None, None)
    assert gone.lengths == before.lengths
    back = follower.follow(told(3.0), (seen("a", 3.0), seen("b", 3.0)))
    assert back.target is not None
    assert back.target.twist_rad_s == 0.0


def test_an_arm_that_is_lost_is_not_followed() -> None:
    follower, _ = after(2.0)
    lost = follower.follow(FusedFrame(2.01, STANDING, *SETS, np.zeros(JOINT_COUNT, np.uint8)), ())
    assert lost.healthy is not None
    assert not lost.healthy.valid
    assert lost.healthy.swing_bound_rad == pi
    assert lost.target is not None
    assert not lost.target.valid
