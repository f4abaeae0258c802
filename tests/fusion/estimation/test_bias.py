"""Sensors that say different things of a joint neither pull the point to and fro nor move it as they come and go."""

from __future__ import annotations

from dataclasses import replace
from itertools import pairwise

import numpy as np
from hypothesis import given, settings
from hypothesis import strategies as st

from fusion.compiled import record
from fusion.estimation import bias, biased_filter
from fusion.estimation.set_membership import SetMembership
from fusion.messages import AlignedSample
from fusion.skeleton import TrackingState

from .scene import FRAME_S, WRIST, changed, sample_at

APART_M = np.array([0.07, -0.03, 0.05])
WORD = record(bias.FIELDS)
JOINT = record(biased_filter.FIELDS)


def standing(t_s: float, sensor: str, apart_m: np.ndarray = APART_M, sway_m: float = 0.0) -> AlignedSample:
    """The body of the first instant, each sensor seeing the wrist elsewhere."""
    sample = changed(sample_at(0.0, sensor), WRIST, apart_m if sensor == "side" else -apart_m)
    sample = changed(sample, slice(None), (sway_m, 0.0, 0.0))
    return replace(sample, t_s=t_s, t_received_s=t_s)


def watched(seconds: float, sensors: tuple[str, ...] = ("front", "side")) -> SetMembership:
    estimator = SetMembership()
    for k in range(round(seconds / FRAME_S)):
        for n, sensor in enumerate(sensors):
            estimator.update(standing((k + 0.5 * n) * FRAME_S, sensor))
    return estimator


def wrist(estimator: SetMembership, t_s: float) -> np.ndarray:
    return estimator.frame(t_s).positions_in_room[WRIST]


def test_covering_a_sensor_leaves_the_point_where_it_was() -> None:
    estimator = watched(10.0)
    before = wrist(estimator, 10.0)
    for k in range(30):
        estimator.update(standing(10.0 + k * FRAME_S, "front"))
    assert np.linalg.norm(wrist(estimator, 11.0) - before) < 0.02 < np.linalg.norm(APART_M)


def test_who_is_left_is_followed_all_the_same() -> None:
    """Standing still by hearing nobody would be no merit."""
    estimator = watched(10.0)
    before = wrist(estimator, 10.0)
    for k in range(30):
        estimator.update(standing(10.0 + k * FRAME_S, "front", sway_m=0.2 * k / 30))
    went_m = wrist(estimator, 10.0 + 29 * FRAME_S)[0] - before[0]
    assert 0.16 < went_m < 0.22


def test_a_made_up_wrist_moves_nothing_when_the_sensor_that_sees_it_is_covered() -> None:
    """What one sensor infers half a metre off is followed from where the other one had it."""
    estimator, far = SetMembership(), np.array([0.0, 0.5, 0.0])

    def made_up(t_s: float) -> AlignedSample:
        return changed(standing(t_s, "side", 0 * far), WRIST, far, state=TrackingState.INFERRED)

    for k in range(300):
        estimator.update(standing(k * FRAME_S, "front", 0 * far))
        estimator.update(made_up((k + 0.5) * FRAME_S))
    before = wrist(estimator, 10.0)
    for k in range(30):
        estimator.update(made_up(10.0 + k * FRAME_S))
    assert np.linalg.norm(wrist(estimator, 11.0) - before) < 0.05
    assert np.linalg.norm(before - standing(0.0, "front", 0 * far).positions_in_room[WRIST]) < 0.01


def test_the_point_is_not_pulled_to_and_fro() -> None:
    estimator = watched(10.0)
    points = []
    for k in range(30):
        for n, sensor in enumerate(("front", "side")):
            t_s = 10.0 + (k + 0.5 * n) * FRAME_S
            estimator.update(standing(t_s, sensor))
            points.append(wrist(estimator, t_s))
    assert max(np.linalg.norm(b - a) for a, b in pairwise(points)) < 0.005


def test_the_mean_of_the_sensors_stays_where_it_is() -> None:
    np.testing.assert_allclose(wrist(watched(20.0), 20.0), sample_at(0.0).positions_in_room[WRIST], atol=0.01)


def test_a_sensor_alone_has_no_bias() -> None:
    estimator = watched(5.0, ("side",))
    np.testing.assert_allclose(wrist(estimator, 5.0), sample_at(0.0).positions_in_room[WRIST] + APART_M, atol=1e-3)


@settings(derandomize=True, max_examples=20, deadline=None)
@given(seed=st.integers(0, 2**32 - 1), sensors=st.integers(1, 4))
def test_covariances_stay_symmetric_and_positive(seed: int, sensors: int) -> None:
    """Whatever comes in whatever order: words in doubt and out of it, for the bias alone, anew after a while."""
    rng = np.random.default_rng(seed)
    joint, words, bias_m2 = np.zeros(1, JOINT)[0], np.zeros(sensors, WORD), np.zeros((sensors, sensors))
    for k in range(sensors):
        bias.strange(words[k], bias_m2, k)
    joint["seen_s"], t_s = -np.inf, 0.0
    biased_filter.start(joint, words, bias_m2, 0, (0.0, 0.0, 0.0), 2e-4, t_s)
    for _ in range(500):
        before_s, t_s = t_s, t_s + float(rng.uniform(0, 0.05))
        own, off_m = int(rng.integers(sensors)), tuple(rng.normal(0, 0.1, 3).tolist())
        biased_filter.predict(joint, words, before_s, t_s)
        bias.age(words, bias_m2, own, tuple(rng.normal(0, 0.05, 3).tolist()), True, t_s)
        bias.reopen(words, bias_m2, own, bool(rng.uniform() < 0.8))
        if rng.uniform() < 0.2:
            biased_filter.learn_bias(joint, words, bias_m2, own, off_m, 2e-4)
        else:
            biased_filter.correct(joint, words, bias_m2, own, off_m, 2e-4, t_s, np.empty(sensors))
        whole = whole_covariance(joint, words, bias_m2)
        np.testing.assert_array_equal(whole, whole.T)
        assert np.linalg.eigvalsh(whole).min() > -1e-9


def whole_covariance(joint: np.void, words: np.ndarray, bias_m2: np.ndarray) -> np.ndarray:
    """(2 + K, 2 + K) of [p; v; b]."""
    own = np.array([[joint["pp"], joint["pv"]], [joint["pv"], joint["vv"]]])
    across = np.array([words["with_position"], words["with_velocity"]])
    return np.block([[own, across], [across.T, bias_m2]])
