"""Constants are chosen without whom they are judged by, and a plateau is left alone."""

import subprocess

import numpy as np
import pytest

from fusion.evaluation.scores import Errors
from fusion.experiments.measures.changed_constants import Change, Watched, told_with
from fusion.experiments.measures.known_scene import known_scene
from fusion.experiments.measures.leaving_out import by_patient, preferred, without


def off_by(*mm):
    return Errors(np.array(mm) / 1000, np.full(len(mm), 0.2), np.zeros(len(mm), bool))


def test_recordings_are_joined_by_whose_they_are():
    found = by_patient(("a", "b", "a"), (off_by(10), off_by(20), off_by(30, 40)))
    np.testing.assert_allclose(found["a"].distance_m, (0.01, 0.03, 0.04))
    np.testing.assert_allclose(without(found, "a").distance_m, (0.02,))


def test_what_is_best_for_the_one_left_out_has_no_say():
    tried = {
        1.0: {"a": off_by(30), "b": off_by(30), "c": off_by(30)},
        2.0: {"a": off_by(1), "b": off_by(31), "c": off_by(31)},
        3.0: {"a": off_by(90), "b": off_by(20), "c": off_by(20)},
    }
    assert preferred(1.0, tried, "a") == 3.0
    assert preferred(1.0, tried, "b") == 2.0


def test_a_value_that_is_better_by_a_hair_is_not_preferred():
    tried = {1.0: {"a": off_by(30), "b": off_by(30.0)}, 2.0: {"a": off_by(30), "b": off_by(29.8)}}
    assert preferred(1.0, tried, "a") == 1.0


@pytest.fixture(scope="module")
def watched():
    scene = known_scene(1, 3.0).scene
    samples = [scene.alignments[sample.sensor].apply(sample, t_s) for t_s, sample in scene.due]
    return Watched.of(samples[:30], scene.t_s[:12])


def test_a_changed_constant_changes_what_is_told(watched, monkeypatch):
    monkeypatch.setenv("NUMBA_DISABLE_JIT", "1")  # the same code, without compiling it
    (usual,) = told_with((), [watched])
    (changed,) = told_with((Change("ball", "LEAST_M", 0.12),), [watched])
    np.testing.assert_array_equal(changed.positions, usual.positions)
    known = np.isfinite(usual.bound_m)
    assert known.any()
    assert (changed.bound_m[known] <= usual.bound_m[known] + 0.1 + 1e-9).all()
    assert changed.bound_m[known].max() > usual.bound_m[known].max()


def test_a_constant_that_is_not_there_is_no_silent_nothing(watched, monkeypatch):
    monkeypatch.setenv("NUMBA_DISABLE_JIT", "1")
    with pytest.raises(subprocess.CalledProcessError):
        told_with((Change("ball", "LEAST", 0.12),), [watched])
