"""Sensors that say different things of a joint neither pull the point to and fro nor move it as they come and go."""

from __future__ import annotations

from dataclasses import replace
from itertools import pairwise

import numpy as np
from hypothesis import given, settings
from hypothesis import strategies as st

from fusion.compiled import record
from fusion.estimation import bias
from fusion.estimation.set_membership import SetMembership
from fusion.messages import AlignedSample

from .scene import FRAME_S, WRIST, changed, sample_at

APART_M = np.array([0.07, -0.03, 0.05])
WORD = record(bias.FIELDS)


def standing(t_s: float, sensor: str, apart_m: np.ndarray = APART_M) -> AlignedSample:
    """The body of the first instant, each sensor seeing the wrist elsewhere."""
    sample = changed(sample_at(0.0, sensor), WRIST, apart_m if sensor == "side" else -apart_m)
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


@settings(derandomize=True, max_examples=50, deadline=None)
@given(seed=st.integers(0, 2**32 - 1), sensors=st.integers(2, 4))
def test_biases_are_bounded_and_share_nothing(seed: int, sensors: int) -> None:
    rng = np.random.default_rng(seed)
    words = np.zeros(sensors, WORD)
    for k in range(500):
        own = int(rng.integers(sensors))
        off_m = tuple(rng.normal(0, 0.5, 3).tolist())
        bias.learn(words, own, off_m, bias.share_of(words[own], k * FRAME_S))
        offsets_m = words["offset_m"]
        assert (np.linalg.norm(offsets_m, axis=1) <= bias.LARGEST_M + 1e-12).all()
        assert np.linalg.norm(offsets_m.mean(axis=0)) <= bias.LARGEST_M / 2
