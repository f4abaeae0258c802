"""The one estimator on a virtual patient: what each sensor is worth, and what its silence does."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass

import numpy as np
import pytest

from fusion.align.alignment import SensorAlignment, reference_alignment
from fusion.estimation import METHODS
from fusion.evaluation.scores import truth_at
from fusion.joined.estimator import Joined
from fusion.joined.evidence import Evidence
from fusion.joined.feed import samples_of
from fusion.messages import AlignedSample, FusedFrame, PositionSample, SegmentSample
from fusion.recording.recording import Recording
from fusion.skeleton import INDEX, Side, arm
from fusion.virtual_patient.trial import sensors_for

SHOULDER, ELBOW, WRIST, _ = arm(Side.RIGHT)
ARM = [SHOULDER, ELBOW, WRIST]
GRID_S = np.arange(8.0, 19.0, 0.05)
COVERED_S = (12.0, 15.0)
Sample = SegmentSample | PositionSample


@dataclass(frozen=True)
class Scene:
    """Camera samples in the room, the other sensors' samples, and the truth."""

    cameras: list[AlignedSample]
    others: list[Sample]
    truth: np.ndarray  # (T, 25, 3) at GRID_S


@pytest.fixture(scope="module")
def scene(everything: Recording) -> Scene:
    first, second = (sensor.pose for sensor in sensors_for(Side.RIGHT, 3, apart_rad=1.5))
    rotation = first.rotation_sensor_to_world.T @ second.rotation_sensor_to_world
    mounted = SensorAlignment(rotation, first.to_sensor(second.position_in_world), 0.0, 0.0, 0, 0.0, 0.0)
    cameras = [
        alignment.apply(sample, sample.t_s)
        for stream, alignment in zip(everything.skeleton_streams, (reference_alignment(), mounted), strict=True)
        for sample in stream.samples
    ]
    others = [sample for _, samples in samples_of(everything).used for sample in samples]
    return Scene(sorted(cameras, key=lambda sample: sample.t_s), others, truth_at(everything.truth, GRID_S))


def a_joined(samples: Sequence[Sample]) -> Joined:
    return Joined(METHODS["set-membership"], Evidence(samples))


def told(
    estimator: Joined, scene: Scene, seen: Callable[[AlignedSample], bool] = lambda sample: True
) -> list[FusedFrame]:
    """The body at GRID_S."""
    frames, cameras = [], [sample for sample in scene.cameras if seen(sample)]
    for t_s in GRID_S.tolist():
        while cameras and cameras[0].t_s <= t_s:
            estimator.update(cameras.pop(0))
        frames.append(estimator.frame(t_s))
    return frames


def uncovered(sample: AlignedSample) -> bool:
    return not COVERED_S[0] <= sample.t_s < COVERED_S[1]


def errors_mm(frames: list[FusedFrame], scene: Scene, joints: list[int]) -> np.ndarray:
    off = np.array([frame.positions_in_room for frame in frames]) - scene.truth
    return 1e3 * np.linalg.norm(off[:, joints], axis=2)


def rms(values: np.ndarray) -> float:
    return float(np.sqrt(np.mean(values**2)))


def test_the_inertial_chain_makes_the_arm_much_better_than_cameras_alone(scene: Scene) -> None:
    alone, together = (told(a_joined(samples), scene) for samples in ([], scene.others))
    assert rms(errors_mm(together, scene, ARM)) < 0.75 * rms(errors_mm(alone, scene, ARM))


def test_with_both_cameras_covered_the_arm_goes_on_and_its_bound_holds(scene: Scene) -> None:
    frames = told(a_joined(scene.others), scene, uncovered)
    inside = (COVERED_S[0] + 0.5 < GRID_S) & (COVERED_S[1] > GRID_S)
    hidden = [frame for frame, covered in zip(frames, inside, strict=True) if covered]
    off_mm = errors_mm(frames, scene, ARM)[inside]
    bound_mm = 1e3 * np.array([frame.bound_m[ARM] for frame in hidden])
    assert (off_mm <= bound_mm).all()
    assert bound_mm.max() < 900
    assert all((frame.state[ARM] > 0).all() for frame in hidden)
    relative = np.array([f.positions_in_room[WRIST] - f.positions_in_room[SHOULDER] for f in hidden])
    true = scene.truth[inside][:, WRIST] - scene.truth[inside][:, SHOULDER]
    assert rms(1e3 * np.linalg.norm(relative - true, axis=1)) < 60


def test_without_the_tag_the_pelvis_is_held_and_its_bound_grows(scene: Scene) -> None:
    inertial = [sample for sample in scene.others if isinstance(sample, SegmentSample)]
    pelvis = INDEX["SpineBase"]
    at = int(np.searchsorted(GRID_S, COVERED_S[1])) - 1
    with_tag = told(a_joined(scene.others), scene, uncovered)[at].bound_m[pelvis]
    without = told(a_joined(inertial), scene, uncovered)[at].bound_m[pelvis]
    assert with_tag < 0.7 < 3.0 < without


def test_the_order_in_which_other_sensors_samples_come_in_does_not_matter(scene: Scene) -> None:
    shuffled = [scene.others[k] for k in np.random.default_rng(1).permutation(len(scene.others))]
    for one, other in zip(told(a_joined(scene.others), scene), told(a_joined(shuffled), scene), strict=True):
        np.testing.assert_array_equal(one.positions_in_room, other.positions_in_room)
        np.testing.assert_array_equal(one.bound_m, other.bound_m)


def test_nothing_of_the_future_is_used(scene: Scene) -> None:
    end_s = float(GRID_S[100])
    past = [sample for sample in scene.others if sample.t_s <= end_s]
    whole, cut = told(a_joined(scene.others), scene)[100], told(a_joined(past), scene)[100]
    np.testing.assert_array_equal(whole.positions_in_room, cut.positions_in_room)


def test_going_back_to_a_snapshot_tells_the_same_again(scene: Scene) -> None:
    estimator, half = a_joined(scene.others), len(scene.cameras) // 2
    for sample in scene.cameras[:half]:
        estimator.update(sample)
    t_s = scene.cameras[half].t_s
    before, known = estimator.frame(t_s), estimator.snapshot()
    for sample in scene.cameras[half : half + 60]:
        estimator.update(sample)
    estimator.restore(known)
    again = estimator.frame(t_s)
    np.testing.assert_array_equal(before.positions_in_room, again.positions_in_room)
    np.testing.assert_array_equal(before.bound_m, again.bound_m)
    with pytest.raises(TypeError, match="JoinedState"):
        estimator.restore(None)


def test_a_sensor_at_an_unheard_of_site_is_left_alone(scene: Scene) -> None:
    strange = [SegmentSample("left-sock", sample.t_s, np.eye(3)) for sample in scene.cameras]
    plain, odd = told(a_joined([]), scene)[-1], told(a_joined(strange), scene)[-1]
    np.testing.assert_array_equal(plain.positions_in_room, odd.positions_in_room)
