"""A sensor that sits anyhow on its segment is learnt from what cameras see of the bones."""

from __future__ import annotations

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from scipy.spatial.transform import Rotation

from fusion.joined import attitude
from fusion.joined.attitude import Attitude

SEEDS = st.integers(0, 2**32 - 1)
STEP_S = 0.1


def turns(rng: np.random.Generator, count: int) -> Rotation:
    """Sensor to earth, as somebody reaches about: slow waves about three axes."""
    t_s = STEP_S * np.arange(count)[:, None]
    return Rotation.from_rotvec(np.sin(t_s * rng.uniform(0.3, 1.5, 3) + rng.uniform(0, 6, 3))) * Rotation.random(
        rng=rng
    )


def earth_to_room(rng: np.random.Generator) -> Rotation:
    """Upright within a camera's tilt, at any heading."""
    upright = Rotation.from_matrix([[1.0, 0.0, 0.0], [0.0, 0.0, 1.0], [0.0, -1.0, 0.0]])
    return Rotation.from_rotvec(rng.normal(0, 0.05, 3)) * upright * Rotation.from_rotvec([0, 0, rng.uniform(-3, 3)])


def learnt(rng: np.random.Generator, noise_m: float, count: int = 300) -> tuple[Attitude, Rotation, np.ndarray]:
    """What is learnt of two bones, the true R, and the true bones in the sensor."""
    truth, bones = earth_to_room(rng), rng.normal(0, 0.2, (2, 3))
    known = attitude.unknown(2)
    for k, turn in enumerate(turns(rng, count)):
        seen = (truth * turn).apply(bones) + rng.normal(0, noise_m, bones.shape)
        known = attitude.learn(known, k * STEP_S, turn.as_matrix(), seen, np.ones(2, bool))
    return known, truth, bones


@settings(max_examples=15)
@given(seed=SEEDS)
def test_without_noise_the_vectors_are_those_of_poses_never_seen_too(seed: int) -> None:
    rng = np.random.default_rng(seed)
    known, truth, bones = learnt(rng, 0.0)
    pose = Rotation.random(rng=rng)
    found = attitude.vectors_in_room(known, pose.as_matrix())
    np.testing.assert_allclose(found, (truth * pose).apply(bones), atol=0.02)


@settings(max_examples=15)
@given(seed=SEEDS)
def test_with_a_cameras_noise_the_vector_is_within_its_tolerance_in_any_pose(seed: int) -> None:
    rng = np.random.default_rng(seed)
    known, truth, bones = learnt(rng, 0.04)
    pose = Rotation.random(rng=rng)
    away = attitude.vectors_in_room(known, pose.as_matrix()) - (truth * pose).apply(bones)
    tolerances = attitude.tolerances_m(known, pose.as_matrix(), known.t_s)
    assert (np.linalg.norm(away, axis=1) <= tolerances).all()
    assert (tolerances < 0.15).all()


def test_a_silence_of_the_cameras_widens_the_tolerance_and_forgets_nothing() -> None:
    known, *_ = learnt(np.random.default_rng(3), 0.04)
    soon, late = (attitude.tolerances_m(known, np.eye(3), known.t_s + silent_s) for silent_s in (1.0, 60.0))
    assert (late > soon).all()
    after = attitude.learn(known, known.t_s + 60.0, np.eye(3), np.zeros((2, 3)), np.array([True, False]))
    assert after.sums.count[1] > 0.9 * known.sums.count[1]


def test_a_heading_that_drifts_is_followed() -> None:
    rng = np.random.default_rng(5)
    truth, bones = earth_to_room(rng), np.array([[0.0, 0.3, 0.0]])
    known = attitude.unknown(1)
    for k, turn in enumerate(turns(rng, 2400)):
        drifted = Rotation.from_rotvec([0.0, 0.0, 1e-3 * k * STEP_S]) * turn
        seen = (truth * turn).apply(bones) + rng.normal(0, 0.03, (1, 3))
        known = attitude.learn(known, k * STEP_S, drifted.as_matrix(), seen, np.ones(1, bool))
    now = attitude.vectors_in_room(known, drifted.as_matrix())
    assert np.linalg.norm(now - (truth * turn).apply(bones)) < 0.03  # 0.24 rad of drift would be 7 cm


def test_a_bone_that_was_hardly_seen_is_not_known() -> None:
    known, *_ = learnt(np.random.default_rng(1), 0.0, count=20)
    assert not known.known


def test_an_arm_that_rests_teaches_its_pose_and_leaves_others_open() -> None:
    rng = np.random.default_rng(2)
    truth, bones, rest = earth_to_room(rng), np.array([[0.0, 0.3, 0.0]]), Rotation.random(rng=rng)
    known = attitude.unknown(1)
    for k in range(300):
        seen = (truth * rest).apply(bones) + rng.normal(0, 0.03, (1, 3))
        known = attitude.learn(known, k * STEP_S, rest.as_matrix(), seen, np.ones(1, bool))
    raised = rest * Rotation.from_rotvec([1.5, 0.0, 0.0])
    there, elsewhere = (attitude.tolerances_m(known, pose.as_matrix(), known.t_s)[0] for pose in (rest, raised))
    assert there == pytest.approx(0.05, abs=0.02)
    assert elsewhere > 3 * there
