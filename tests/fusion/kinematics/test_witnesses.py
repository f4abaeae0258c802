"""Bounds learnt from what the sensors say of the arm: they follow disagreement, silence, the ruler, and they hold."""

from __future__ import annotations

from dataclasses import replace
from math import pi, sin

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from fusion.kinematics.angles import ARM_JOINTS, PerAngle, arm_points_in_trunk
from fusion.kinematics.witnesses import (
    ACCELERATION_RAD_S2,
    AGREED,
    ALONE,
    SMALL_RAD,
    USUAL_MISFITS,
    Witnesses,
)
from fusion.messages import AlignedSample, ArmLengths, Floats, FusedFrame, Refusal, TrunkFrame
from fusion.skeleton import JOINT_COUNT, Side, arm

LENGTHS = ArmLengths(0.28, 0.25, 0.08)
HERE = TrunkFrame(np.zeros(3), np.eye(3))
SIDE = Side.RIGHT
POSE = (0.8, 1.0, 0.3, 1.4)
HZ = 100
Pose = tuple[float, float, float, float]


def body(pose: Pose) -> Floats:
    positions = np.full((JOINT_COUNT, 3), np.nan)
    positions[list(arm(SIDE))] = arm_points_in_trunk(*pose, LENGTHS, SIDE, np.zeros(3))
    return positions


def told(t_s: float, pose: Pose = POSE, refusals: tuple[Refusal, ...] = ()) -> FusedFrame:
    unknown = np.full((JOINT_COUNT, 3, 3), np.nan), np.full(JOINT_COUNT, np.inf)
    return FusedFrame(t_s, body(pose), *unknown, np.full(JOINT_COUNT, 2, np.uint8), refusals)


def seen(sensor: str, t_s: float, pose: Pose = POSE, state: int = 2) -> AlignedSample:
    states = np.full(JOINT_COUNT, state, np.uint8)
    return AlignedSample(sensor, t_s, t_s, body(pose), states, np.zeros(3), np.eye(3))


def calm(sensors: str, pose: Pose = POSE) -> Witnesses:
    """Eight seconds after every sensor last saw the arm, twenty times just as it was told."""
    witnesses = Witnesses()
    for t_s in (*(k / 10 for k in range(20)), 10.0):
        heard(witnesses, told(t_s, pose), *(seen(name, t_s, pose) for name in sensors))
    return witnesses


def heard(witnesses: Witnesses, frame: FusedFrame, *samples: AlignedSample) -> PerAngle:
    return witnesses.hear(frame, HERE, SIDE, samples)


def test_two_sensors_that_see_what_is_told_leave_what_they_may_share() -> None:
    found = heard(calm("ab"), told(10.01), seen("a", 10.01), seen("b", 10.01))
    assert found == pytest.approx(AGREED, abs=1e-3)


def test_one_sensor_alone_may_hide_more() -> None:
    assert heard(calm("a"), told(10.01), seen("a", 10.01)) == pytest.approx(ALONE, abs=1e-3)


def test_nothing_is_known_before_a_sensor_was_heard() -> None:
    assert heard(Witnesses(), told(0.0)) == (pi, pi, pi)


def test_a_sensor_that_disagrees_widens_each_angle_by_as_much() -> None:
    plane, elevation, twist, elbow = POSE
    other = seen("b", 10.01, (plane, elevation + 0.1, twist + 0.2, elbow + 0.15))
    found = heard(calm("ab"), told(10.01), seen("a", 10.01), other)
    assert found.swing == pytest.approx(AGREED.swing + 0.1, abs=1e-3)
    assert found.elbow == pytest.approx(AGREED.elbow + 0.15, abs=1e-3)
    assert found.turn == pytest.approx(AGREED.turn + 0.2 * sin(elbow), abs=1e-3)


def test_a_disagreement_is_forgotten_within_seconds() -> None:
    witnesses = calm("ab")
    plane, elevation, twist, elbow = POSE
    first = heard(witnesses, told(10.01), seen("a", 10.01), seen("b", 10.01, (plane, elevation + 0.4, twist, elbow)))
    for k in range(1, 500):
        last = heard(witnesses, told(10.01 + k / HZ), seen("a", 10.01 + k / HZ), seen("b", 10.01 + k / HZ))
    assert first.swing > 0.5
    assert last.swing == pytest.approx(AGREED.swing, abs=0.01)


def test_a_moving_arm_is_held_against_what_was_told_when_it_was_seen() -> None:
    witnesses = Witnesses()
    for k in range(1000):
        t_s = k / HZ
        late = t_s - 0.137
        witnesses.hear(
            told(t_s, (0.8, 1.0, 0.3, 0.5 + t_s / 10)),
            HERE,
            SIDE,
            (seen("a", t_s, (0.8, 1.0, 0.3, 0.5 + t_s / 10)), seen("b", late, (0.8, 1.0, 0.3, 0.5 + late / 10))),
        )
    found = heard(witnesses, told(10.0, (0.8, 1.0, 0.3, 1.5)))
    assert found.elbow == pytest.approx(AGREED.elbow, abs=0.02)


def test_silence_opens_the_bounds_with_the_square_of_time_until_nothing_is_believed() -> None:
    witnesses = calm("ab")
    found = [heard(witnesses, told(10.0 + s)).swing for s in (0.0, 0.05, 0.1, 0.2)]
    assert found[1] - found[0] == pytest.approx(0.5 * ACCELERATION_RAD_S2 * 0.05**2, abs=1e-3)
    assert found[2] > 0.5
    assert found[3] == pi


@pytest.mark.parametrize("state", [0, 1])
def test_what_is_not_tracked_says_nothing(state: int) -> None:
    witnesses = calm("ab")
    guess = seen("b", 10.01, (2.0, 1.5, 1.0, 0.5), state)
    assert heard(witnesses, told(10.01), seen("a", 10.01), guess) == pytest.approx(AGREED, abs=1e-3)


def test_a_refused_wrist_leaves_its_sensor_a_witness_of_the_upper_arm_alone() -> None:
    refused = (Refusal("b", ARM_JOINTS[SIDE][2], "bone length changed"),)
    plane, elevation, twist, elbow = POSE
    wrong = seen("b", 10.01, (plane, elevation + 0.1, twist, elbow + 1.0))
    found = heard(calm("ab"), told(10.01, refusals=refused), seen("a", 10.01), wrong)
    assert found.swing == pytest.approx(AGREED.swing + 0.1, abs=1e-3)
    assert found.elbow == pytest.approx(AGREED.elbow, abs=1e-3)


def test_the_same_sample_counts_once() -> None:
    witnesses = calm("ab")
    plane, elevation, twist, elbow = POSE
    other = seen("b", 10.01, (plane, elevation + 0.3, twist, elbow))
    heard(witnesses, told(10.01), seen("a", 10.01), other)
    for k in range(1, 600):
        found = heard(witnesses, told(10.01 + k / HZ), seen("a", 10.01 + k / HZ), other)
    assert found.swing < ALONE.swing + 0.01


def scattered(scatter: float, seconds: float = 20.0) -> PerAngle:
    """After a sensor has seen every forearm longer or shorter by a share of it, the arm turned just as told."""
    witnesses, rng = Witnesses(), np.random.default_rng(1)
    for k in range(int(seconds * 30)):
        sample = stretched(seen("a", k / 30), 1.0 + scatter * rng.normal())
        found = heard(witnesses, told(k / 30), sample)
    return found


def stretched(sample: AlignedSample, by: float) -> AlignedSample:
    _, elbow, wrist = ARM_JOINTS[SIDE]
    positions = sample.positions_in_room.copy()
    positions[wrist] = positions[elbow] + by * (positions[wrist] - positions[elbow])
    return replace(sample, positions_in_room=positions)


def test_a_forearm_whose_length_scatters_widens_every_angle_though_no_direction_is_off() -> None:
    usual = 0.6745 * 0.08
    found = scattered(0.08)
    assert found.swing == pytest.approx(USUAL_MISFITS.swing * usual, rel=0.15)
    assert found.turn >= 0.85 * USUAL_MISFITS.turn * usual
    assert scattered(0.2) == (pi, pi, pi)


def test_a_few_samples_that_agree_say_little() -> None:
    assert scattered(0.0, 0.4) == (pi, pi, pi)
    assert scattered(0.0, 4.0).swing < SMALL_RAD


def test_a_forearm_that_is_too_long_now_widens_what_depends_on_it() -> None:
    witnesses = calm("ab")
    found = heard(witnesses, told(10.01), seen("a", 10.01), stretched(seen("b", 10.01), 1.2))
    assert found.elbow == pytest.approx(AGREED.elbow + 0.2, abs=1e-3)
    assert found.swing == pytest.approx(AGREED.swing, abs=1e-3)


def test_a_sensor_that_sees_every_forearm_too_short_is_a_witness_like_any_other() -> None:
    witnesses = Witnesses()
    for k in range(600):
        t_s = k / 30
        found = heard(witnesses, told(t_s), seen("a", t_s), stretched(seen("b", t_s), 0.8))
    assert found == pytest.approx(AGREED, abs=0.02)


@given(
    pose=st.tuples(st.floats(-3, 3), st.floats(0.05, 2.9), st.floats(-3, 3), st.floats(0.3, 2.8)),
    hidden=st.tuples(*[st.floats(-1.0, 1.0)] * 3),
    own=st.tuples(*[st.floats(-0.2, 0.2)] * 3),
)
def test_the_truth_is_inside_while_some_sensor_is_off_by_no_more_than_may_be_hidden(
    pose: Pose, hidden: tuple[float, float, float], own: tuple[float, float, float]
) -> None:
    """The guarantee: |told − true| <= |told − seen| + |seen − true|."""
    plane, elevation, twist, elbow = pose
    true = (elevation + hidden[0] * AGREED.swing, twist + hidden[2] * AGREED.turn, elbow + hidden[1] * AGREED.elbow)
    telling = (plane, elevation + own[0], twist + own[1], elbow + own[2])
    found = heard(calm("ab", pose), told(10.01, telling), seen("a", 10.01, pose), seen("b", 10.01, pose))
    assert pi > found.swing >= abs(telling[1] - true[0]) - 1e-3
    assert pi > found.turn >= abs(telling[2] - true[1]) * sin(telling[3]) - 1e-3
    assert pi > found.elbow >= abs(telling[3] - true[2]) - 1e-3


def test_bounds_are_never_below_what_is_hidden_nor_between_small_and_unknown() -> None:
    witnesses = calm("ab")
    for k in range(100):
        found = heard(witnesses, told(10.0 + k / HZ))
        assert all(bound == pi or AGREED[i] <= bound <= SMALL_RAD for i, bound in enumerate(found))
