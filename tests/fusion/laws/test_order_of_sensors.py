"""Independent sensors that speak at one instant: whoever is heard first, each point is within the other's bound."""

from __future__ import annotations

from itertools import pairwise

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from fusion.estimation import METHODS
from fusion.messages import AlignedSample, FusedFrame
from fusion.skeleton import JOINT_COUNT

from .rig import a_lens, states

TIMES_S = np.arange(0.0, 1.5, 1 / 30)
NOISE_M = 0.04
MIDDLE = np.array([0.0, 0.0, 2.4])


def instants(rng: np.random.Generator, body_at, sensors: int) -> list[list[AlignedSample]]:
    """What every sensor, mounted anyhow, says at each instant of a body that moves."""
    lenses = [a_lens(rng, f"sensor {k}") for k in range(sensors)]
    state = np.full((sensors, JOINT_COUNT), 2, np.uint8)
    found = []
    for t_s in TIMES_S.tolist():
        state = np.array([states(rng, each) for each in state])
        seen = body_at(t_s) + np.clip(rng.normal(0, NOISE_M, (sensors, JOINT_COUNT, 3)), -0.1, 0.1)
        seen = np.where(state[..., None] > 0, seen, np.nan)
        words = zip(lenses, seen, state, strict=True)
        found.append([AlignedSample(o.name, t_s, t_s, p, s, o.place + MIDDLE, o.rotation) for o, p, s in words])
    return found


def told(method: str, rounds: list[list[AlignedSample]], order: np.random.Generator) -> FusedFrame:
    """The body once all were heard, in a fresh order at every instant."""
    estimator = METHODS[method]()
    for samples in rounds:
        for k in order.permutation(len(samples)):
            estimator.update(samples[k])
    return estimator.frame(rounds[-1][0].t_s + 0.01)


@pytest.mark.parametrize("method", METHODS)
@settings(max_examples=10)
@given(seed=st.integers(0, 2**32 - 1), sensors=st.integers(2, 4))
def test_the_order_does_not_matter_within_the_bound(bodies, method: str, seed: int, sensors: int) -> None:
    rng = np.random.default_rng(seed)
    rounds = instants(rng, bodies.body_at, sensors)
    for one, other in pairwise(told(method, rounds, rng) for _ in range(3)):
        apart_m = np.linalg.norm(one.positions_in_room - other.positions_in_room, axis=1)
        assert (apart_m <= np.minimum(one.bound_m, other.bound_m)).all()
