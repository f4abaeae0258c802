"""The told body keeps its bones, and a joint nobody sees is bounded by one that somebody does."""

from __future__ import annotations

import numpy as np

from fusion.estimation import bones, build
from fusion.estimation.set_membership import SetMembership, SetState
from fusion.skeleton import JOINT_COUNT, TrackingState

from .scene import ELBOW, FRAME_S, HAND, SHOULDER, WRIST, body_at, both, changed, sample_at


def shaken(seconds: float, seed: int = 5) -> SetMembership:
    """A minute's worth of lengths is not needed to see bones: each sensor errs by 4 cm, slowly, for itself."""
    rng, estimator, off = np.random.default_rng(seed), SetMembership(), {"front": 0.0, "side": 0.0}
    for sample in both(seconds, noise_m=0.0):
        off[sample.sensor] = 0.9 * off[sample.sensor] + 0.017 * rng.normal(size=(JOINT_COUNT, 3))
        estimator.update(changed(sample, slice(None), off[sample.sensor]))
    return estimator


def lengths_told(seconds: float) -> tuple[np.ndarray, np.ndarray]:
    """The forearm as told and as the filters alone would have it, while both sensors go on."""
    estimator, rng, told, free = shaken(6.0), np.random.default_rng(6), [], []
    for k in range(round(seconds / FRAME_S)):
        t_s = 6.0 + k * FRAME_S
        estimator.update(changed(sample_at(t_s), slice(None), 0.04 * rng.normal(size=(JOINT_COUNT, 3))))
        state = estimator.snapshot()
        assert isinstance(state, SetState)
        for positions, lengths in (
            (estimator.frame(t_s).positions_in_room, told),
            (state.known.joints["position"], free),
        ):
            lengths.append(np.linalg.norm(positions[WRIST] - positions[ELBOW]))
    return np.array(told), np.array(free)


def test_a_forearm_breathes_less_than_half_as_much_as_the_filters_would_have_it() -> None:
    told, free = lengths_told(4.0)
    assert told.std() < free.std() / 2
    assert abs(told.mean() - 0.25) < 0.025  # noise lengthens a distance L by about its variance over L


def test_keeping_the_bones_moves_the_less_sure_end_by_more() -> None:
    state = shaken(4.0).snapshot()
    assert isinstance(state, SetState)
    known = state.known
    joints, positions = known.joints.copy(), known.joints["position"].copy()
    joints["pp"][WRIST] = 100 * joints["pp"][ELBOW]
    before = positions.copy()
    positions[WRIST] += (0.1, 0.0, 0.0)
    build.keep(known.bones[0], joints, positions)
    assert np.linalg.norm(positions[ELBOW] - before[ELBOW]) < np.linalg.norm(positions[WRIST] - before[WRIST]) / 3


def test_a_lost_wrist_is_no_further_than_its_arm_is_long() -> None:
    estimator = SetMembership()
    for sample in both(3.0):
        estimator.update(sample)
    for sample in both(3.0):
        late = changed(sample_at(3.0 + sample.t_s, sample.sensor), [WRIST, HAND], 0.0, TrackingState.LOST)
        estimator.update(late)
    frame = estimator.frame(6.0)
    assert frame.state[WRIST] == TrackingState.LOST
    apart_m = np.linalg.norm(frame.positions_in_room[WRIST] - frame.positions_in_room[ELBOW])
    assert frame.bound_m[WRIST] < frame.bound_m[ELBOW] + apart_m + 0.25 + 0.1
    assert frame.bound_m[ELBOW] < 0.3
    assert frame.bound_m[HAND] > 5  # no firm bone leads to it
    shape = frame.shape_m2[WRIST]
    np.testing.assert_allclose(shape, frame.bound_m[WRIST] ** 2 * np.eye(3))


def test_what_keeps_its_length_hangs_together_from_the_spine() -> None:
    known = bones.unknown(JOINT_COUNT)
    known = known[known["firm"]]
    children = [int(bone["child"]) for bone in known]
    assert {SHOULDER, ELBOW, WRIST} <= set(children)
    for k, bone in enumerate(known):
        assert int(bone["parent"]) not in children[k:]


def test_a_body_first_seen_wrongly_is_told_rightly_within_seconds() -> None:
    estimator = SetMembership()
    for number, sample in enumerate(both(5.0)):
        estimator.update(changed(sample, ELBOW, [0.0, 0.3, 0.3]) if number < 6 else sample)
    told = estimator.frame(5.0).positions_in_room
    assert np.linalg.norm(told - body_at(5.0), axis=1).max() < 0.04
