"""What the measures of a covered sensor say of methods whose answer is known."""

from dataclasses import replace

import numpy as np
import pytest

from fusion.estimation import METHODS
from fusion.estimation.average import Average
from fusion.experiments.measures.covering import covering
from fusion.experiments.measures.scene import scene_of, seen_alone, told
from fusion.experiments.measures.standing import runs_of, standing_stretches
from fusion.experiments.measures.steadiness import bone_std_m, jitter_m
from fusion.offline import fuse_recording
from fusion.skeleton import Side, arm
from fusion.virtual_patient.sensor import NO_NOISE
from fusion.virtual_patient.trial import virtual_recording

LIFTED_M = 0.08
UP, AHEAD = np.eye(3)[1:]
ARM = list(arm(Side.RIGHT)[:3])


@pytest.fixture(scope="module")
def recording():
    return virtual_recording(4, 8.0, noise=NO_NOISE)


@pytest.fixture(scope="module")
def two_opinions(recording):
    """The second sensor puts the whole right arm 0.08 m higher."""

    def lifted(sample):
        positions = sample.positions_in_sensor.copy()
        positions[ARM, 1] += LIFTED_M
        return replace(sample, positions_in_sensor=positions)

    first, second = recording.skeleton_streams
    return replace(
        recording, skeleton_streams=(first, replace(second, samples=tuple(lifted(s) for s in second.samples)))
    )


class Deaf(Average):
    """Hears the first sensor only."""

    name = "deaf"

    def update(self, sample):
        return super().update(sample) if sample.sensor == "virtual-1" else ()


def test_without_noise_a_covered_sensor_moves_nothing_and_the_other_is_followed(recording):
    for found in covering(scene_of(recording), "set-membership", moments=4):
        assert np.median(found.moved_m) < 0.003
        assert found.follows == pytest.approx(1.0, abs=0.1)
        assert not found.coasted.any()
        assert len(found.moments_s) == 4


def test_of_two_opinions_the_average_moves_half_way_however_they_are_aligned(two_opinions):
    scene = scene_of(two_opinions)
    apart = seen_alone(scene, "virtual-1")[0][:, ARM] - seen_alone(scene, "virtual-2")[0][:, ARM]
    half_m = np.nanmedian(np.linalg.norm(apart, axis=2)) / 2
    for found in covering(scene, "average", moments=4):
        assert np.median(found.moved_m) == pytest.approx(half_m, rel=0.15)
        assert np.median(found.half_apart_m) < 0.2 * half_m  # a constant difference is no news


def test_who_hears_one_sensor_only_is_found_out(recording, monkeypatch):
    monkeypatch.setitem(METHODS, "deaf", Deaf)
    first_covered, second_covered = covering(scene_of(recording), "deaf", moments=3)
    assert first_covered.follows < 0.1
    assert first_covered.coasted.mean() > 0.9
    assert second_covered.follows == pytest.approx(1.0, abs=0.1)


def test_equal_seeds_give_equal_moments_whatever_the_method(recording):
    scene = scene_of(recording)
    one, other = (covering(scene, method, moments=3, seed=9) for method in ("average", "kalman"))
    assert [found.moments_s.tolist() for found in one] == [found.moments_s.tolist() for found in other]


def test_a_scene_is_fused_as_the_command_fuses_it(recording):
    scene, fused = scene_of(recording), fuse_recording(recording, "kalman")
    assert np.array_equal(scene.t_s, fused.t_s)
    known = fused.t_s > fused.t_s[0] + 0.5
    assert np.allclose(told(scene, "kalman")[0].positions[known], fused.positions[known], equal_nan=True)


def test_somebody_who_walks_does_not_stand(recording):
    def walked(sample):
        t_s = sample.t_received_s  # the true time, the same for both sensors
        return replace(sample, positions_in_sensor=sample.positions_in_sensor + 0.5 * t_s * UP)

    walking = tuple(
        replace(stream, samples=tuple(walked(sample) for sample in stream.samples))
        for stream in recording.skeleton_streams
    )
    assert standing_stretches(scene_of(recording))
    assert standing_stretches(scene_of(replace(recording, skeleton_streams=walking))) == ()


def test_runs_are_the_stretches_of_true():
    assert runs_of(np.array([True, True, False, True])) == (slice(0, 2), slice(3, 4))
    assert runs_of(np.zeros(3, dtype=bool)) == ()


def test_rigid_bones_do_not_vary_and_slow_movement_is_no_jitter():
    t_s = np.arange(300) / 30
    slow = np.stack([np.sin(2 * np.pi * t_s), np.zeros(300), np.zeros(300)], axis=1)
    chain = np.stack([slow, slow + 0.3 * UP, slow + 0.3 * UP + 0.25 * AHEAD], axis=1)
    assert bone_std_m(chain) == pytest.approx(0.0, abs=1e-12)
    assert jitter_m(chain, (slice(30, 270),)) < 0.01
    fast = 0.01 * np.sin(2 * np.pi * 9 * t_s)[:, None, None]
    assert jitter_m(chain + fast * UP, (slice(30, 270),)) == pytest.approx(0.01 / np.sqrt(2), rel=0.1)
