"""What every method must keep, whatever its mathematics."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from fusion.estimation import METHODS
from fusion.estimation.adaptive import Adaptive
from fusion.estimation.average import Average
from fusion.estimation.esmf import Esmf
from fusion.estimation.estimator import Estimator
from fusion.estimation.kalman import Kalman
from fusion.estimation.set_membership import SetMembership
from fusion.messages import FusedFrame
from fusion.skeleton import JOINT_COUNT

from .scene import FRAME_S, WRIST, body_at, both, changed, sample_at

every_method = pytest.mark.parametrize("make", METHODS.values(), ids=METHODS.keys())
Make = Callable[[], Estimator]


def fed(make: Make, seconds: float, noise_m: float = 0.02) -> tuple[Estimator, float]:
    estimator, t_s = make(), 0.0
    for sample in both(seconds, noise_m):
        estimator.update(sample)
        t_s = sample.t_s
    return estimator, t_s


def same(first: FusedFrame, second: FusedFrame) -> bool:
    arrays = ("positions_in_room", "shape_m2", "bound_m", "state")
    equal = all(np.array_equal(getattr(first, a), getattr(second, a), equal_nan=True) for a in arrays)
    return equal and first.refusals == second.refusals


@every_method
def test_a_method_has_the_name_it_is_called_by(make: Make) -> None:
    assert METHODS[make().name] is make


@every_method
def test_before_the_first_sample_nothing_is_known(make: Make) -> None:
    frame = make().frame(1.0)
    assert np.isnan(frame.positions_in_room).all()
    assert np.isinf(frame.bound_m).all()
    assert (frame.state == 0).all()


@every_method
def test_a_moving_body_is_followed(make: Make) -> None:
    estimator, t_s = fed(make, 3.0)
    frame = estimator.frame(t_s + FRAME_S / 2)
    assert np.linalg.norm(frame.positions_in_room - body_at(t_s + FRAME_S / 2), axis=1).max() < 0.06
    assert (frame.state == 2).all()


@every_method
def test_a_frame_leaves_the_state_as_it_was(make: Make) -> None:
    estimator, t_s = fed(make, 0.5)
    before = estimator.frame(t_s)
    estimator.frame(t_s + 5.0)
    assert same(estimator.frame(t_s), before)


@every_method
def test_restoring_a_snapshot_is_exact(make: Make) -> None:
    estimator, t_s = fed(make, 1.0)
    snapshot, later = estimator.snapshot(), [sample_at(t_s + k * FRAME_S) for k in range(1, 20)]
    refused_first = [estimator.update(sample) for sample in later]
    first = estimator.frame(later[-1].t_s)
    estimator.restore(snapshot)
    refused_again = [estimator.update(sample) for sample in later]
    assert same(estimator.frame(later[-1].t_s), first)
    assert refused_again == refused_first


@every_method
def test_a_snapshot_of_something_else_is_refused(make: Make) -> None:
    with pytest.raises(TypeError):
        make().restore("yesterday")


@every_method
def test_a_joint_never_seen_stays_unknown_and_the_others_do_not_mind(make: Make) -> None:
    estimator = make()
    for sample in both(1.0):
        estimator.update(changed(sample, WRIST, np.nan, state=0))
    frame = estimator.frame(1.0)
    others = np.arange(JOINT_COUNT) != WRIST
    assert np.isnan(frame.positions_in_room[WRIST]).all()
    assert np.isinf(frame.bound_m[WRIST])
    assert frame.state[WRIST] == 0
    assert np.isfinite(frame.positions_in_room[others]).all()
    assert np.isfinite(frame.bound_m[others]).all()


@every_method
@settings(derandomize=True, max_examples=15, deadline=None)
@given(seed=st.integers(0, 2**32 - 1))
def test_garbage_in_never_makes_a_seen_joint_nan(make: Make, seed: int) -> None:
    rng = np.random.default_rng(seed)
    estimator, t_s = fed(make, 0.3)
    for k in range(60):
        t_s += rng.uniform(-0.02, 0.1)
        sample = sample_at(t_s, str(rng.choice(["front", "side"])))
        broken = rng.uniform(size=JOINT_COUNT) < 0.5
        by_m = rng.choice([np.nan, np.inf, -np.inf, 1e6, 10.0, 0.5, 0.0], (int(broken.sum()), 3))
        estimator.update(changed(sample, broken, by_m, state=int(rng.integers(0, 3))))
        frame = estimator.frame(t_s + 0.01 * (k % 7))
        assert np.isfinite(frame.positions_in_room).all()
        assert np.isfinite(frame.bound_m).all()
        assert np.isfinite(frame.shape_m2).all()


@every_method
def test_in_silence_the_point_stays_and_the_bound_grows(make: Make) -> None:
    estimator, t_s = fed(make, 2.0)
    near, late = estimator.frame(t_s + 0.1), estimator.frame(t_s + 3.0)
    # the default method's bones settle by millimetres as their ends grow less sure
    np.testing.assert_allclose(late.positions_in_room, near.positions_in_room, atol=0.005)
    assert (late.bound_m >= near.bound_m).all()
    assert (near.state == 1).all()
    assert (late.state == 0).all()


@every_method
def test_a_sample_that_comes_a_little_late_does_no_harm(make: Make) -> None:
    estimator, t_s = fed(make, 2.0, noise_m=0.0)
    before = estimator.frame(t_s).positions_in_room
    refused = estimator.update(sample_at(t_s - 0.03, "side"))
    after = estimator.frame(t_s).positions_in_room
    errors = [np.linalg.norm(positions - body_at(t_s), axis=1).max() for positions in (before, after)]
    moved_m = 0.02  # what the hand moves in that time: the averages hold what they are given, the filters carry it on
    assert errors[1] <= (moved_m if make in (Average, Adaptive) else errors[0] + moved_m / 4)
    assert refused == ()


@every_method
def test_a_sample_from_long_ago_is_ignored(make: Make) -> None:
    estimator, t_s = fed(make, 2.0)
    before = estimator.frame(t_s)
    assert estimator.update(changed(sample_at(t_s - 1.0), slice(None), 0.1)) == ()
    assert same(estimator.frame(t_s), before)


@every_method
def test_what_comes_back_after_an_occlusion_is_taken_within_three_frames(make: Make) -> None:
    estimator, t_s = fed(make, 2.0)
    for k in range(1, 4):
        estimator.update(sample_at(t_s + 1.5 + k * FRAME_S))
    at_s = t_s + 1.5 + 3 * FRAME_S
    frame = estimator.frame(at_s)
    assert np.linalg.norm(frame.positions_in_room - body_at(at_s), axis=1).max() < 0.06
    assert (frame.state == 2).all()


@pytest.mark.parametrize(("make", "joints"), [(SetMembership, 32), (Kalman, 8), (Kalman, 32), (Esmf, 8), (Esmf, 32)])
def test_a_body_may_have_any_number_of_joints(
    make: type[SetMembership] | type[Kalman] | type[Esmf], joints: int
) -> None:
    """The first 25 are as they are with 25, bone lengths included; what is beyond them has no bones."""
    usual, other = make(), make(joints)
    shared = min(joints, JOINT_COUNT)
    for sample in both(2.0):
        usual.update(sample)
        positions = np.resize(sample.positions_in_room, (joints, 3))
        other.update(replace(sample, positions_in_room=positions, state=np.resize(sample.state, joints)))
    expected, frame = usual.frame(2.0), other.frame(2.0)
    np.testing.assert_array_equal(frame.positions_in_room[:shared], expected.positions_in_room[:shared])
    np.testing.assert_array_equal(frame.bound_m[:shared], expected.bound_m[:shared])
    assert np.isfinite(frame.bound_m).all()


def test_a_body_may_be_seen_without_its_spine() -> None:
    """Nothing is hidden by a trunk that nobody knows, and no bone hangs on it."""
    estimator = SetMembership(8)
    for sample in both(2.0):
        estimator.update(replace(sample, positions_in_room=sample.positions_in_room[:8], state=sample.state[:8]))
    frame = estimator.frame(2.0)
    assert np.linalg.norm(frame.positions_in_room - body_at(2.0)[:8], axis=1).max() < 0.06
    assert np.isfinite(frame.bound_m).all()


@every_method
def test_a_sample_of_another_number_of_joints_is_refused_before_anything_is_read_of_it(make: Make) -> None:
    sample = sample_at(0.0)
    with pytest.raises(ValueError, match="joints"):
        make().update(replace(sample, positions_in_room=sample.positions_in_room[:-1]))
