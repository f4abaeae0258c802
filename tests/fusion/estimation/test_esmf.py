"""The paper's filter with its gain mended keeps every point that is in the prior and in the measurement."""

from __future__ import annotations

import numpy as np
from hypothesis import given, settings
from hypothesis import strategies as st

from fusion.compiled import Records
from fusion.estimation.esmf import JOINT, Esmf, cut, predict
from fusion.estimation.matrices import inverse, largest_eigenvalue
from fusion.estimation.motion_set import ACCELERATION_MAX
from fusion.skeleton import JOINT_COUNT

from .scene import FRAME_S, WRIST, both, changed, sample_at

SEEDS = st.integers(0, 2**32 - 1)


def some_joints(rng: np.random.Generator) -> Records:
    root = rng.normal(size=(JOINT_COUNT, 6, 6)) * rng.uniform(0.05, 1.0, (JOINT_COUNT, 1, 1))
    joints = np.zeros(JOINT_COUNT, JOINT)
    joints["shape"] = root @ root.swapaxes(1, 2) + 1e-4 * np.eye(6)
    joints["centre"] = rng.normal(size=(JOINT_COUNT, 6))
    return joints


def within(rng: np.random.Generator, joints: Records) -> np.ndarray:
    direction = rng.normal(size=(JOINT_COUNT, 6))
    direction *= np.minimum(rng.uniform(0, 2, (JOINT_COUNT, 1)), 1.0) / np.linalg.norm(direction, axis=1)[:, None]
    return joints["centre"] + np.einsum("jik,jk->ji", np.linalg.cholesky(joints["shape"]), direction)


def depth(joints: Records, points: np.ndarray) -> np.ndarray:
    away = points - joints["centre"]
    return np.einsum("ji,ji->j", away, np.linalg.solve(joints["shape"], away[..., None])[..., 0])


@settings(derandomize=True, max_examples=100, deadline=None)
@given(seed=SEEDS)
def test_the_cut_holds_every_point_of_prior_and_measurement(seed: int) -> None:
    rng = np.random.default_rng(seed)
    joints = some_joints(rng)
    points = within(rng, joints)
    measured_m2 = rng.uniform(0.01, 1.0, (JOINT_COUNT, 3))
    off = rng.normal(size=(JOINT_COUNT, 3))
    off *= rng.uniform(0, 1, (JOINT_COUNT, 1)) * np.sqrt(measured_m2) / np.linalg.norm(off, axis=1)[:, None]
    measured = points[:, :3] + off
    for joint, position, squares in zip(joints, measured.tolist(), measured_m2.tolist(), strict=True):
        assert cut(joint, tuple(position), tuple(squares))
    assert (depth(joints, points) <= 1 + 1e-6).all()
    np.testing.assert_array_equal(joints["shape"], joints["shape"].swapaxes(1, 2))


@settings(derandomize=True, max_examples=50, deadline=None)
@given(seed=SEEDS, dt=st.floats(0.001, 0.5))
def test_the_prediction_holds_whatever_a_limb_can_do(seed: int, dt: float) -> None:
    rng = np.random.default_rng(seed)
    joints = some_joints(rng)
    points = within(rng, joints)
    push = rng.normal(size=(JOINT_COUNT, 3))
    push *= ACCELERATION_MAX / np.linalg.norm(push, axis=1)[:, None]
    moved_m = points[:, :3] + points[:, 3:] * dt + push * dt**2 / 2
    for joint in joints:
        predict(joint, dt)
    assert (depth(joints, np.concatenate([moved_m, points[:, 3:] + push * dt], axis=1)) <= 1 + 1e-9).all()


@settings(derandomize=True, max_examples=50, deadline=None)
@given(seed=SEEDS)
def test_the_largest_eigenvalue_and_the_inverse_are_those_of_lapack(seed: int) -> None:
    rng = np.random.default_rng(seed)
    root = rng.normal(size=(3, 3)) * 10.0 ** rng.uniform(-2, 1, 3)
    matrix = root @ root.T + 1e-6 * np.eye(3)
    np.testing.assert_allclose(largest_eigenvalue(matrix), np.linalg.eigvalsh(matrix)[-1], rtol=1e-7)
    expected = np.linalg.inv(matrix)
    np.testing.assert_allclose(inverse(matrix), expected, atol=1e-6 * np.abs(expected).max())
    np.testing.assert_allclose(largest_eigenvalue(2.0 * np.eye(3)), 2.0)


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
