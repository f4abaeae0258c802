"""One instant: whatever keeps its bound holds the truth, whichever sensors are there; what does not is told."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
from hypothesis import given
from hypothesis import strategies as st

from fusion.joined.boxes import Distance, Offset, Place
from fusion.joined.joining import cut, held_m, joined
from fusion.messages import FusedFrame
from fusion.skeleton import BONE_INDICES, INDEX, JOINT_COUNT, Side, TrackingState, arm

SEEDS = st.integers(0, 2**32 - 1)
SHOULDER, ELBOW, WRIST, _ = arm(Side.RIGHT)
PELVIS = INDEX["SpineBase"]
CHAIN = ((PELVIS, INDEX["SpineShoulder"]), (INDEX["SpineShoulder"], SHOULDER), (SHOULDER, ELBOW), (ELBOW, WRIST))


def in_ball(rng: np.random.Generator, radius_m: float) -> np.ndarray:
    step = rng.normal(size=3)
    return rng.uniform(0, radius_m) * step / np.linalg.norm(step)


def a_body(rng: np.random.Generator) -> np.ndarray:
    positions = np.zeros((JOINT_COUNT, 3))
    for parent, child in BONE_INDICES:
        positions[child] = positions[parent] + in_ball(rng, 0.45)
    return positions


def told_of(rng: np.random.Generator, body: np.ndarray, bound_m: np.ndarray) -> FusedFrame:
    """What cameras tell, each joint off by less than its bound."""
    positions = body + np.array([in_ball(rng, radius_m) for radius_m in bound_m])
    state = np.full(JOINT_COUNT, TrackingState.TRACKED, np.uint8)
    return FusedFrame(1.0, positions, bound_m[:, None, None] ** 2 * np.eye(3), bound_m, state)


def evidence_of(rng: np.random.Generator, body: np.ndarray) -> tuple[list[Offset], list[Place], list[Distance]]:
    offsets = [Offset(a, b, body[b] - body[a] + in_ball(rng, 0.06), 0.06) for a, b in CHAIN]
    places = [Place(PELVIS, body[PELVIS] + in_ball(rng, 0.2), 0.2)]
    lengths = np.linalg.norm(body[BONE_INDICES[:, 1]] - body[BONE_INDICES[:, 0]], axis=1)
    distances = [
        Distance(a, b, max(length - 0.04, 0.0), length + 0.04)
        for (a, b), length in zip(BONE_INDICES.tolist(), lengths.tolist(), strict=True)
    ]
    return offsets, places, distances


@given(
    seed=SEEDS, inertial=st.booleans(), tag=st.booleans(), anatomy=st.booleans(), blind=st.sampled_from([0.0, 0.5, 1.0])
)
def test_whichever_sensors_are_there_the_truth_is_in_the_sets(
    seed: int, inertial: bool, tag: bool, anatomy: bool, blind: float
) -> None:
    rng = np.random.default_rng(seed)
    body = a_body(rng)
    bound_m = np.where(rng.uniform(size=JOINT_COUNT) < blind, 50.0, rng.uniform(0.05, 0.3, JOINT_COUNT))
    told = told_of(rng, body, bound_m)
    offsets, places, distances = evidence_of(rng, body)
    present = offsets if inertial else [], places if tag else [], distances if anatomy else []
    sets = cut(told, *present)
    assert sets.unused == ()
    assert not sets.doubted.any()
    assert ((sets.boxes.low - 1e-9 <= body) & (body <= sets.boxes.high + 1e-9)).all()
    frame = joined(told, *present)
    off_m = np.linalg.norm(frame.positions_in_room - body, axis=1)
    assert (off_m <= held_m(told, sets, frame.positions_in_room) + 1e-9).all()


@given(seed=SEEDS)
def test_losing_any_of_them_widens_the_sets_and_nothing_else(seed: int) -> None:
    rng = np.random.default_rng(seed)
    body = a_body(rng)
    told = told_of(rng, body, rng.uniform(0.05, 0.3, JOINT_COUNT))
    everything = evidence_of(rng, body)
    whole = cut(told, *everything).boxes
    for missing in range(3):
        rest = [() if k == missing else part for k, part in enumerate(everything)]
        less = cut(told, *rest).boxes
        assert (whole.low >= less.low - 1e-9).all()
        assert (whole.high <= less.high + 1e-9).all()


@given(seed=SEEDS)
def test_with_cameras_alone_the_point_is_theirs_and_the_set_no_wider(seed: int) -> None:
    rng = np.random.default_rng(seed)
    body = a_body(rng)
    told = told_of(rng, body, rng.uniform(0.05, 0.3, JOINT_COUNT))
    frame = joined(told, (), (), ())
    np.testing.assert_allclose(frame.positions_in_room, told.positions_in_room, atol=1e-9)
    assert (frame.bound_m <= told.bound_m + 1e-9).all()
    np.testing.assert_array_equal(frame.state, told.state)


def test_a_wrist_that_cameras_see_where_the_chain_cannot_be_is_left_out_and_told() -> None:
    rng = np.random.default_rng(4)
    body = a_body(rng)
    told = told_of(rng, body, np.full(JOINT_COUNT, 0.1))
    positions = told.positions_in_room.copy()
    positions[WRIST] += (0.0, 0.8, 0.0)
    bound_m = np.where(np.arange(JOINT_COUNT) == WRIST, 0.12, told.bound_m)
    frame = joined(replace(told, positions_in_room=positions, bound_m=bound_m), *evidence_of(rng, body))
    assert [(refusal.sensor, refusal.joint) for refusal in frame.refusals] == [("cameras", WRIST)]
    assert np.linalg.norm(frame.positions_in_room[WRIST] - body[WRIST]) < 0.15


def test_a_tag_far_from_the_pelvis_that_cameras_see_is_refused() -> None:
    rng = np.random.default_rng(4)
    body = a_body(rng)
    told = told_of(rng, body, np.full(JOINT_COUNT, 0.1))
    far = Place(PELVIS, body[PELVIS] + 2.0, 0.3)
    frame = joined(told, (), [far], ())
    assert [(refusal.sensor, refusal.joint) for refusal in frame.refusals] == [("tag", PELVIS)]
    np.testing.assert_allclose(frame.positions_in_room, told.positions_in_room, atol=1e-9)


def test_a_joint_never_seen_stays_unknown_and_disturbs_nobody() -> None:
    rng = np.random.default_rng(4)
    body = a_body(rng)
    told = told_of(rng, body, np.full(JOINT_COUNT, 0.1))
    positions, bound_m, shape_m2, state = (
        told.positions_in_room.copy(),
        told.bound_m.copy(),
        told.shape_m2.copy(),
        told.state.copy(),
    )
    positions[ELBOW], bound_m[ELBOW], shape_m2[ELBOW], state[ELBOW] = np.nan, np.inf, np.nan, 0
    never = replace(told, positions_in_room=positions, bound_m=bound_m, shape_m2=shape_m2, state=state)
    frame = joined(never, *evidence_of(rng, body))
    assert np.isnan(frame.positions_in_room[ELBOW]).all()
    assert np.isinf(frame.bound_m[ELBOW])
    assert frame.state[ELBOW] == TrackingState.LOST
    others = np.arange(JOINT_COUNT) != ELBOW
    assert np.isfinite(frame.positions_in_room[others]).all()
    assert np.isfinite(frame.shape_m2[others]).all()
