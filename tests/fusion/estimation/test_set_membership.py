"""The default method: what it believes, what it refuses, and what its set holds."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from fusion.estimation import motion_set
from fusion.estimation.evidence import BELIEVED_HALF_WIDTH_M
from fusion.estimation.set_membership import SetMembership, SetState
from fusion.messages import AlignedSample, Refusal
from fusion.skeleton import JOINT_COUNT, TrackingState

from .scene import ELBOW, FRAME_S, HAND, SHOULDER, WRIST, body_at, both, changed, extents, sample_at

DOUBT = "in doubt, another sensor is sure"
BONE = "bone length changed"


def run(
    samples: list[AlignedSample], estimator: SetMembership | None = None
) -> tuple[SetMembership, list[tuple[Refusal, ...]]]:
    estimator = estimator or SetMembership()
    return estimator, [estimator.update(sample) for sample in samples]


def reasons(refused: list[tuple[Refusal, ...]], joint: int) -> set[str]:
    return {refusal.reason for sample in refused for refusal in sample if refusal.joint == joint}


def error_m(estimator: SetMembership, t_s: float, joint: int) -> float:
    return float(np.linalg.norm(estimator.frame(t_s).positions_in_room[joint] - body_at(t_s)[joint]))


@settings(derandomize=True, max_examples=25, deadline=None)
@given(seed=st.integers(0, 2**32 - 1))
def test_the_set_holds_the_truth_for_every_error_within_table_1(seed: int) -> None:
    """Errors may stand at the very edge of the box, change at once or not at all, and be shared by both sensors."""
    rng = np.random.default_rng(seed)
    estimator, off = SetMembership(), np.zeros((JOINT_COUNT, 3))
    least = np.full(3, min(BELIEVED_HALF_WIDTH_M))  # in the room's axes, so the narrowest side counts
    for k in range(90):
        if rng.uniform() < 0.3:
            off = rng.choice([-1.0, 0.0, 1.0], off.shape) * least * rng.uniform(size=(JOINT_COUNT, 1))
        t_s = k * FRAME_S / 2
        sample = sample_at(t_s, "front" if k % 2 else "side")
        gone = rng.uniform(size=JOINT_COUNT) < 0.2
        estimator.update(changed(changed(sample, slice(None), off), gone, state=TrackingState.LOST))
        state = estimator.snapshot()
        assert isinstance(state, SetState)
        low, high = extents(state.known.joints)
        seen = np.isfinite(state.known.joints["seen_s"])
        true = body_at(t_s)
        assert ((low <= true + 1e-9) & (true <= high + 1e-9))[seen].all()


def test_the_point_is_in_the_set_and_the_bound_reaches_no_further_than_its_corner() -> None:
    estimator, _ = run(list(both(2.0)))
    for ahead_s in (0.0, 0.05, 0.3, 2.0):
        t_s = 2.0 + ahead_s
        state = estimator.snapshot()
        assert isinstance(state, SetState)
        joints = state.known.joints.copy()
        for joint in joints:
            motion_set.move(joint, t_s - state.t_s)
        low, high = extents(joints)
        frame = estimator.frame(t_s)
        assert (low <= frame.positions_in_room).all()
        assert (frame.positions_in_room <= high).all()
        corner = np.maximum(high - frame.positions_in_room, frame.positions_in_room - low)
        assert (frame.bound_m <= np.linalg.norm(corner, axis=1) + 1e-9).all()


def test_a_mean_that_has_left_the_set_is_put_back_into_it() -> None:
    estimator, _ = run(list(both(2.0)))
    state = estimator.snapshot()
    assert isinstance(state, SetState)
    low, high = extents(state.known.joints)
    for end, beyond in ((high, high + 0.5), (low, low - 0.5)):
        joints = state.known.joints.copy()
        joints["position"] = beyond
        estimator.restore(replace(state, known=state.known._replace(joints=joints)))
        np.testing.assert_array_equal(estimator.frame(state.t_s).positions_in_room, end)


def test_shapes_are_symmetric_and_positive_definite() -> None:
    estimator, _ = run(list(both(2.0)))
    for t_s in (2.0, 2.2, 9.0):
        shape = estimator.frame(t_s).shape_m2
        np.testing.assert_array_equal(shape, shape.swapaxes(1, 2))
        assert (np.linalg.eigvalsh(shape) > 0).all()


def test_the_order_of_two_sensors_at_one_instant_does_not_matter_within_the_bound() -> None:
    rng = np.random.default_rng(3)
    start = list(both(1.5))
    pair = [sample_at(1.52, sensor, 0.05, rng) for sensor in ("front", "side")]
    one, _ = run([*start, *pair])
    other, _ = run([*start, *pair[::-1]])
    a, b = one.frame(1.53), other.frame(1.53)
    apart = np.linalg.norm(a.positions_in_room - b.positions_in_room, axis=1)
    assert (apart <= np.minimum(a.bound_m, b.bound_m)).all()
    assert apart.max() < 0.03


def test_a_wrist_that_wanders_flickering_is_refused_while_the_other_sensor_is_sure() -> None:
    samples = []
    for k, sample in enumerate(both(4.0)):
        away = 0.4 * np.clip(sample.t_s - 2.0, 0.0, 1.0)
        wanders = sample.sensor == "side" and sample.t_s >= 2.0
        samples.append(changed(sample, WRIST, away, state=1 + (k // 2) % 2) if wanders else sample)
    estimator, refused = run(samples)
    assert DOUBT in reasons(refused, WRIST)
    assert error_m(estimator, samples[-1].t_s, WRIST) < 0.04


def test_a_wrist_that_is_tracked_on_a_bone_grown_longer_is_refused() -> None:
    samples = []
    for sample in both(4.0):
        body = body_at(sample.t_s)
        along = (body[WRIST] - body[ELBOW]) / np.linalg.norm(body[WRIST] - body[ELBOW])
        wanders = sample.sensor == "side" and sample.t_s >= 2.0
        far = 0.3 * np.clip(sample.t_s - 2.0, 0.0, 1.0)
        samples.append(changed(sample, [WRIST, HAND], far * along) if wanders else sample)
    estimator, refused = run(samples)
    assert BONE in reasons(refused, WRIST)
    assert BONE in reasons(refused, HAND)
    assert not reasons(refused, SHOULDER)
    assert error_m(estimator, samples[-1].t_s, WRIST) < 0.05


def test_a_single_wild_measurement_is_refused_and_changes_nothing() -> None:
    before, _ = run(list(both(2.0)))
    point = before.frame(2.01).positions_in_room[WRIST]
    after, refused = run([changed(sample_at(2.0), WRIST, (0.0, 0.0, 1.0))], before)
    assert reasons(refused, WRIST)
    np.testing.assert_allclose(after.frame(2.01).positions_in_room[WRIST], point, atol=0.01)


def test_refusals_stand_in_the_frame_until_the_sensor_says_something_else() -> None:
    estimator, _ = run(list(both(2.0)))
    estimator.update(changed(sample_at(2.0), WRIST, (0.0, 0.0, 1.0)))
    assert {refusal.joint for refusal in estimator.frame(2.01).refusals} == {WRIST}
    assert estimator.frame(2.5).refusals == ()
    estimator.update(sample_at(2.033))
    assert estimator.frame(2.04).refusals == ()


def test_sensors_that_insist_are_taken_after_half_a_second() -> None:
    """The whole body was somewhere else all the time: the set was wrong, not everybody else."""
    estimator, _ = run(list(both(2.0)))
    moved = [changed(sample_at(2.0 + k * FRAME_S), slice(None), (1.0, 0.0, 0.0)) for k in range(25)]
    _, refused = run(moved, estimator)
    assert refused[0]
    assert not refused[-1]
    frame = estimator.frame(moved[-1].t_s)
    assert np.linalg.norm(frame.positions_in_room - moved[-1].positions_in_room, axis=1).max() < 0.05


def test_the_bound_holds_errors_of_table_1_that_change_slowly() -> None:
    """Bounded as in [Du2016 Table 1], with a frame-to-frame correlation of 0.9; the ball learns how wide it must be."""
    rng, estimator = np.random.default_rng(11), SetMembership()
    std_m, most_m = np.array([0.0456, 0.0387, 0.0541]), np.array(BELIEVED_HALF_WIDTH_M)[[1, 2, 0]]
    error, inside = {name: rng.normal(size=(JOINT_COUNT, 3)) for name in ("front", "side")}, []
    for sample in both(12.0, noise_m=0.0):
        own = error[sample.sensor] = 0.9 * error[sample.sensor] + np.sqrt(0.19) * rng.normal(size=(JOINT_COUNT, 3))
        off_m = np.clip(own * std_m, -most_m, most_m) @ sample.rotation_sensor_to_room.T
        estimator.update(changed(sample, slice(None), off_m))
        if sample.t_s > 2.0:
            frame = estimator.frame(sample.t_s)
            off = np.linalg.norm(frame.positions_in_room - body_at(sample.t_s), axis=1)
            inside.append(off <= frame.bound_m)
    assert np.mean(inside) > 0.999


def test_a_lone_sensor_leaves_a_wider_bound_than_two() -> None:
    two, _ = run(list(both(4.0)))
    one, _ = run(list(both(4.0)))
    for k in range(15):
        t_s = 4.0 + k * FRAME_S
        run([sample_at(t_s), sample_at(t_s + FRAME_S / 2, "side")], two)
        run([sample_at(t_s)], one)
    assert (one.frame(4.5).bound_m > two.frame(4.5).bound_m).all()


def test_an_inferred_joint_leaves_a_wider_bound_than_a_tracked_one() -> None:
    estimator, _ = run([changed(sample, WRIST, state=TrackingState.INFERRED) for sample in both(2.0)])
    bound_m = estimator.frame(2.0).bound_m
    assert bound_m[WRIST] > 2 * bound_m[ELBOW]


@pytest.mark.parametrize("later_s", [0.3, 1.0])
def test_coming_back_makes_no_step_that_a_limb_could_not_make(later_s: float) -> None:
    """After an occlusion the arm is told where it is seen within three frames, and never past it."""
    estimator, _ = run(list(both(2.0, noise_m=0.0)))
    arm = [SHOULDER, ELBOW, WRIST, HAND]
    held = estimator.frame(2.4).positions_in_room[WRIST]
    seen = body_at(2.4 + later_s)
    away_m = np.linalg.norm(seen[WRIST] - held)
    assert away_m > 0.1
    for k in range(6):
        t_s = 2.4 + k * FRAME_S
        sample = sample_at(t_s)
        estimator.update(changed(sample, arm, seen[arm] - sample.positions_in_room[arm]))
        point = estimator.frame(t_s).positions_in_room[WRIST]
        assert np.linalg.norm(point - seen[WRIST]) <= away_m + 1e-9
        assert (point - seen[WRIST]) @ (seen[WRIST] - held) / away_m <= 0.03
        assert k < 2 or np.linalg.norm(point - seen[WRIST]) < 0.03
