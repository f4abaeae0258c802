"""Segment lengths are learnt from well-seen frames and survive wandering joints."""

from __future__ import annotations

import numpy as np
import pytest

from fusion.kinematics.angles import arm_points_in_trunk
from fusion.kinematics.lengths import ENOUGH, MEMORY, LengthLearner
from fusion.messages import ArmLengths, FusedFrame
from fusion.skeleton import JOINT_COUNT, Side, arm

TRUE = ArmLengths(0.30, 0.26, 0.09)


def frame(t_s: float, lengths: ArmLengths = TRUE, state: int = 2) -> FusedFrame:
    positions = np.full((JOINT_COUNT, 3), np.nan)
    positions[list(arm(Side.LEFT))] = arm_points_in_trunk(t_s, 1.0, 0.2, 1.0, lengths, Side.LEFT, np.zeros(3))
    states = np.full(JOINT_COUNT, state, dtype=np.uint8)
    return FusedFrame(t_s, positions, np.tile(np.eye(3), (JOINT_COUNT, 1, 1)), np.ones(JOINT_COUNT), states)


def learnt(frames: list[FusedFrame]) -> ArmLengths | None:
    learner = LengthLearner()
    for one in frames:
        learner.update(one, Side.LEFT)
    return learner.lengths


def test_nothing_is_known_before_a_second_has_been_seen() -> None:
    assert learnt([frame(0.1 * k) for k in range(ENOUGH - 1)]) is None


def test_a_hundred_frames_in_one_instant_do_not_count_as_a_second() -> None:
    assert learnt([frame(0.0001 * k) for k in range(100)]) is None


def test_frames_that_are_not_seen_teach_nothing() -> None:
    assert learnt([frame(0.11 * k, state=1) for k in range(100)]) is None


def test_a_third_of_wandering_frames_does_not_change_the_lengths() -> None:
    wrong = ArmLengths(0.6, 0.1, 0.2)
    found = learnt([frame(0.11 * k, wrong if k % 3 == 0 else TRUE) for k in range(60)])
    assert found is not None
    assert found.upper_arm_m == pytest.approx(0.30)
    assert found.forearm_m == pytest.approx(0.26)
    assert found.hand_m == pytest.approx(0.09)


def test_an_arm_that_has_left_is_forgotten() -> None:
    other = ArmLengths(0.25, 0.22, 0.07)
    found = learnt([frame(0.11 * k, TRUE if k < 300 else other) for k in range(620)])
    assert found is not None
    assert found.upper_arm_m == pytest.approx(0.25)


def test_a_sensor_without_hands_gets_a_usual_hand() -> None:
    frames = [frame(0.11 * k) for k in range(20)]
    for one in frames:
        one.positions_in_room[arm(Side.LEFT)[3]] = np.nan
    found = learnt(frames)
    assert found is not None
    assert found.hand_m == pytest.approx(0.08)


def test_the_medians_are_those_of_the_last_half_minute() -> None:
    rng = np.random.default_rng(2)
    lengths_m = rng.uniform(0.2, 0.3, size=500)
    found = learnt([frame(0.11 * k, ArmLengths(0.3, m, 0.09)) for k, m in enumerate(lengths_m)])
    assert found is not None
    assert found.forearm_m == pytest.approx(np.median(lengths_m[-MEMORY:]))
