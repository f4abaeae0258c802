"""No NaN in, none out; whatever is fed, no state is spoilt; what has the wrong shape is refused before it is read."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from fusion.estimation import METHODS
from fusion.estimation.estimator import Estimator
from fusion.estimation.kalman import Kalman
from fusion.messages import AlignedSample
from fusion.rewind import RewindingEstimator
from fusion.skeleton import JOINT_COUNT, TrackingState

from .rig import a_scene

SEEDS = st.integers(0, 2**32 - 1)
WILD = np.array([np.nan, np.inf, -np.inf, 1e300, -1e300, 1e155, 1e30, 1e6, 5e-324, -5e-324, 0.0, -0.0])
every_method = pytest.mark.parametrize("make", METHODS.values(), ids=METHODS.keys())
Make = Callable[[], Estimator]


def spoilt(rng: np.random.Generator, sample: AlignedSample) -> AlignedSample:
    """Wild numbers in some places of the positions; states that say tracked all the same, or are none."""
    positions, state = sample.positions_in_room.copy(), sample.state.copy()
    where = rng.uniform(size=positions.shape) < rng.choice([0.02, 0.3, 1.0])
    positions[where] = rng.choice(WILD, int(where.sum()))
    hit = rng.uniform(size=len(state)) < 0.3
    state[hit] = rng.choice([0, 1, 2, 2, 2, 255], int(hit.sum()))
    return replace(sample, positions_in_room=positions, state=state)


def mounted_wildly(rng: np.random.Generator, sample: AlignedSample) -> AlignedSample:
    """As from an alignment that went wrong."""
    lens, rotation = sample.lens_in_room.copy(), sample.rotation_sensor_to_room.copy()
    lens[rng.integers(3)], rotation[tuple(rng.integers(3, size=2))] = rng.choice(WILD, 2)
    return replace(sample, lens_in_room=lens, rotation_sensor_to_room=rotation)


def assert_sound(estimator: Estimator, t_s: float) -> np.ndarray:
    """(J,) which joints are known: of those only numbers are told, and symmetric, positive sets; of the others none."""
    frame = estimator.frame(t_s)
    known = np.isfinite(frame.positions_in_room).all(axis=1)
    assert (np.isfinite(frame.positions_in_room).any(axis=1) == known).all()
    assert not np.isnan(frame.bound_m).any()
    assert (frame.bound_m >= 0).all()
    assert np.isinf(frame.bound_m[~known]).all()
    assert (frame.state[~known] == TrackingState.LOST).all()
    shape = frame.shape_m2[known]
    assert (shape == shape.swapaxes(1, 2)).all()
    assert (np.linalg.eigvalsh(shape) > 0).all()
    return known


@every_method
@settings(max_examples=12)
@given(seed=SEEDS, wild_mounting=st.booleans())
def test_what_is_told_stays_sound_and_what_was_known_stays_known(make: Make, seed: int, wild_mounting: bool) -> None:
    rng = np.random.default_rng(seed)
    scene = a_scene(rng, 2, "anywhere", together=True, length_s=0.6)
    estimator, ever = make(), np.zeros(JOINT_COUNT, bool)
    for word in scene.words:
        sample = spoilt(rng, word.sample) if rng.uniform() < 0.5 else word.sample
        estimator.update(mounted_wildly(rng, sample) if wild_mounting and rng.uniform() < 0.3 else sample)
        known = assert_sound(estimator, word.sample.t_s + rng.choice([0.0, 0.2, 1e6]))
        assert known[ever].all()
        ever |= known


@every_method
@settings(max_examples=6)
@given(seed=SEEDS)
def test_after_two_seconds_of_good_samples_nothing_wild_is_left(make: Make, seed: int) -> None:
    rng = np.random.default_rng(seed)
    scene = a_scene(rng, 2, "anywhere", together=True, length_s=1.0)
    estimator = make()
    for word in scene.words:
        estimator.update(spoilt(rng, word.sample))
    rest, tracked = scene.words[-1].sample, np.full(JOINT_COUNT, 2, np.uint8)
    still = replace(rest, positions_in_room=scene.motion.positions[-1], state=tracked)
    for k in range(60):
        estimator.update(replace(still, t_s=rest.t_s + (k + 1) / 30))
    frame = estimator.frame(rest.t_s + 2.0)
    assert np.linalg.norm(frame.positions_in_room - still.positions_in_room, axis=1).max() < 1.0
    assert frame.bound_m.max() < 3.0


@every_method
@pytest.mark.parametrize("t_s", [np.nan, np.inf, -np.inf])
def test_a_sample_of_no_instant_changes_nothing(make: Make, t_s: float) -> None:
    scene = a_scene(np.random.default_rng(1), 2, "anywhere", together=True, length_s=0.5)
    estimator = make()
    for word in scene.words:
        estimator.update(word.sample)
    now_s = scene.words[-1].sample.t_s
    before = estimator.frame(now_s)
    assert estimator.update(replace(scene.words[-1].sample, t_s=t_s)) == ()
    np.testing.assert_array_equal(estimator.frame(now_s).positions_in_room, before.positions_in_room)
    np.testing.assert_array_equal(estimator.frame(now_s).bound_m, before.bound_m)


SHAPES = {
    "positions_in_room": [(24, 3), (25, 2), (75,), (0, 3), (26, 3)],
    "state": [(24,), (25, 1), (0,)],
    "lens_in_room": [(2,), (0,), (3, 1), (4,)],
    "rotation_sensor_to_room": [(2, 2), (3,), (9,), (3, 4), (0, 0)],
}


@every_method
@pytest.mark.parametrize(("field", "shape"), [(field, shape) for field in SHAPES for shape in SHAPES[field]])
def test_an_array_of_the_wrong_shape_is_refused_before_anything_is_read_of_it(
    make: Make, field: str, shape: tuple[int, ...]
) -> None:
    good = a_scene(np.random.default_rng(1), 1, "anywhere", together=True, length_s=0.5).words[0].sample
    with pytest.raises(ValueError, match=str(shape[0])):
        make().update(replace(good, **{field: np.zeros(shape)}))


def test_a_sample_of_no_instant_is_not_kept_for_rewinding() -> None:
    scene = a_scene(np.random.default_rng(1), 2, "anywhere", together=True, length_s=0.5)
    plain, disturbed = RewindingEstimator(Kalman), RewindingEstimator(Kalman)
    for word in scene.words:
        plain.take(word.sample)
        disturbed.take(replace(word.sample, t_s=np.nan))
        disturbed.take(word.sample)
    now_s = scene.words[-1].sample.t_s
    np.testing.assert_array_equal(plain.frame(now_s).positions_in_room, disturbed.frame(now_s).positions_in_room)
