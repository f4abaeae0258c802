"""The paper's filter with its gain mended keeps every point that is in the prior and in the measurement."""

from __future__ import annotations

import numpy as np
from hypothesis import given, settings
from hypothesis import strategies as st

from fusion.estimation.esmf import Esmf, EsmfState, cut, predict
from fusion.estimation.motion_set import ACCELERATION_MAX
from fusion.skeleton import JOINT_COUNT

from .scene import FRAME_S, WRIST, both, changed, sample_at

SEEDS = st.integers(0, 2**32 - 1)
EVERY = np.ones(JOINT_COUNT, bool)


def some_state(rng: np.random.Generator) -> EsmfState:
    root = rng.normal(size=(JOINT_COUNT, 6, 6)) * rng.uniform(0.05, 1.0, (JOINT_COUNT, 1, 1))
    shape = root @ root.swapaxes(1, 2) + 1e-4 * np.eye(6)
    never, none = np.zeros(JOINT_COUNT), np.full(JOINT_COUNT, np.inf)
    return EsmfState(0.0, rng.normal(size=(JOINT_COUNT, 6)), shape, never, none, ())


def within(rng: np.random.Generator, state: EsmfState) -> np.ndarray:
    direction = rng.normal(size=(JOINT_COUNT, 6))
    direction *= np.minimum(rng.uniform(0, 2, (JOINT_COUNT, 1)), 1.0) / np.linalg.norm(direction, axis=1)[:, None]
    return state.centre + np.einsum("jik,jk->ji", np.linalg.cholesky(state.shape), direction)


def depth(state: EsmfState, points: np.ndarray) -> np.ndarray:
    away = points - state.centre
    return np.einsum("ji,ji->j", away, np.linalg.solve(state.shape, away[..., None])[..., 0])


@settings(derandomize=True, max_examples=100, deadline=None)
@given(seed=SEEDS)
def test_the_cut_holds_every_point_of_prior_and_measurement(seed: int) -> None:
    rng = np.random.default_rng(seed)
    state = some_state(rng)
    points = within(rng, state)
    measured_m2 = rng.uniform(0.01, 1.0, (JOINT_COUNT, 3))
    off = rng.normal(size=(JOINT_COUNT, 3))
    off *= rng.uniform(0, 1, (JOINT_COUNT, 1)) * np.sqrt(measured_m2) / np.linalg.norm(off, axis=1)[:, None]
    after, met = cut(state, points[:, :3] + off, measured_m2, EVERY)
    assert met.all()
    assert (depth(after, points) <= 1 + 1e-6).all()


@settings(derandomize=True, max_examples=50, deadline=None)
@given(seed=SEEDS, dt=st.floats(0.001, 0.5))
def test_the_prediction_holds_whatever_a_limb_can_do(seed: int, dt: float) -> None:
    rng = np.random.default_rng(seed)
    state = some_state(rng)
    points = within(rng, state)
    push = rng.normal(size=(JOINT_COUNT, 3))
    push *= ACCELERATION_MAX / np.linalg.norm(push, axis=1)[:, None]
    moved_m = points[:, :3] + points[:, 3:] * dt + push * dt**2 / 2
    after = predict(state, dt)
    assert (depth(after, np.concatenate([moved_m, points[:, 3:] + push * dt], axis=1)) <= 1 + 1e-9).all()


def test_the_truth_stays_inside_while_errors_keep_their_box() -> None:
    esmf = Esmf()
    for sample in both(5.0, noise_m=0.08):
        esmf.update(sample)
        frame = esmf.frame(sample.t_s)
        off_m = np.linalg.norm(frame.positions_in_room - sample_at(sample.t_s).positions_in_room, axis=1)
        assert (off_m <= frame.bound_m).all()
    assert frame.bound_m.max() < 1.2


def test_what_does_not_meet_the_set_is_dropped_and_after_half_a_second_believed() -> None:
    esmf = Esmf()
    for sample in both(2.0):
        esmf.update(sample)
    far = np.array([4.0, 0.0, 0.0])
    (refused,) = esmf.update(changed(sample_at(2.0), WRIST, far))
    assert (refused.joint, refused.reason) == (WRIST, "does not meet the set")
    for k in range(1, 17):
        again = changed(sample_at(2.0 + k * FRAME_S), WRIST, 20 * far)
        esmf.update(again)
    np.testing.assert_allclose(
        esmf.frame(again.t_s).positions_in_room[WRIST], again.positions_in_room[WRIST], atol=0.05
    )


def test_a_silent_joint_is_halted_and_its_bound_still_holds_the_set() -> None:
    esmf = Esmf()
    for sample in both(2.0):
        esmf.update(sample)
    early, late = esmf.frame(sample.t_s + 0.1), esmf.frame(sample.t_s + 0.4)
    np.testing.assert_allclose(early.positions_in_room, late.positions_in_room, atol=1e-9)
    assert (late.bound_m > early.bound_m).all()
