"""Whatever is in the prior and in the measurement is in the posterior: sampled all over both, and on their skins."""

from __future__ import annotations

import numpy as np
from hypothesis import given, settings
from hypothesis import strategies as st

from fusion.compiled import Record, record
from fusion.estimation import esmf, motion_set
from fusion.estimation.motion_set import SPEED_MAX

SEEDS = st.integers(0, 2**32 - 1)
POINTS = 2000
ROUNDING = 1e-6


def a_prior(rng: np.random.Generator) -> Record:
    """A joint's set as it comes about: begun, moved on, cut by boxes off its middle."""
    joint = np.zeros(1, record(motion_set.FIELDS))[0]
    begin, half = rng.normal(size=3), rng.uniform(0.05, 0.3, 3)
    motion_set.begin(joint, tuple(begin.tolist()), tuple(half.tolist()))
    for _ in range(rng.integers(0, 5)):
        motion_set.move(joint, float(rng.uniform(0.005, 0.1)))
        centre = begin + rng.uniform(-0.3, 0.3, 3)
        motion_set.take(joint, tuple(centre.tolist()), tuple(rng.uniform(0.1, 0.5, 3).tolist()))
    return joint


def states_in(rng: np.random.Generator, axis: Record) -> np.ndarray:
    """(N, 2) states of one axis: on the ellipse's skin, inside, and at the interval's ends."""
    root = np.linalg.cholesky([[axis["pp"], axis["pv"]], [axis["pv"], axis["vv"]]])
    angle, radius = rng.uniform(-np.pi, np.pi, POINTS), np.minimum(rng.uniform(0, 2, POINTS), 1.0)
    states = [axis["p"], axis["v"]] + (radius * [np.cos(angle), np.sin(angle)]).T @ root.T
    states[::5, 0] = axis["low"]
    states[1::5, 0] = axis["high"]
    return states[in_axis(axis, states, 0.0)]


def in_axis(axis: Record, states: np.ndarray, slack: float) -> np.ndarray:
    """(N,) whether states are in the ellipse and the interval."""
    p, v = states[:, 0] - axis["p"], states[:, 1] - axis["v"]
    square = axis["vv"] * p**2 - 2 * axis["pv"] * p * v + axis["pp"] * v**2
    inside = square <= (1 + slack) * (axis["pp"] * axis["vv"] - axis["pv"] ** 2)
    between = (axis["low"] - slack <= states[:, 0]) & (states[:, 0] <= axis["high"] + slack)
    return np.asarray(inside & between)


@settings(max_examples=100)
@given(seed=SEEDS)
def test_of_a_box_that_cuts_a_joints_set(seed: int) -> None:
    rng = np.random.default_rng(seed)
    joint = a_prior(rng)
    states = [states_in(rng, axis) for axis in joint["on"]]
    through = np.array([of_axis[rng.integers(len(of_axis)), 0] for of_axis in states])
    half = rng.uniform(0.02, 0.3, 3)
    centre = through + half * rng.choice([-1.0, -0.5, 0.0, 1.0], 3)  # its end, or its middle, goes through a state
    if not motion_set.take(joint, tuple(centre.tolist()), tuple(half.tolist())):
        return  # a corner of the set, and no more: it stays
    for axis, of_axis, middle, width in zip(joint["on"], states, centre, half, strict=True):
        in_both = of_axis[np.abs(of_axis[:, 0] - middle) <= width]
        assert in_axis(axis, in_both, ROUNDING).all()


@settings(max_examples=60)
@given(seed=SEEDS, dt=st.floats(0.002, 1.0))
def test_of_the_greatest_speed_that_cuts_what_moves_on(seed: int, dt: float) -> None:
    """At constant speed, every state that was in the set and is no faster than a limb is where it has moved to."""
    rng = np.random.default_rng(seed)
    joint = a_prior(rng)
    before = [states_in(rng, axis) for axis in joint["on"]]
    motion_set.move(joint, dt)
    for axis, states in zip(joint["on"], before, strict=True):
        slow = states[np.abs(states[:, 1]) <= SPEED_MAX]
        after = np.stack([slow[:, 0] + slow[:, 1] * dt, slow[:, 1]], axis=1)
        assert in_axis(axis, after, ROUNDING).all()


@settings(max_examples=100)
@given(seed=SEEDS)
def test_of_an_ellipsoid_that_cuts_the_papers_set(seed: int) -> None:
    rng = np.random.default_rng(seed)
    joint = np.zeros(1, esmf.JOINT)[0]
    root = rng.normal(size=(6, 6)) * 10.0 ** rng.uniform(-1.5, 0.5, 6)
    joint["shape"], joint["centre"] = root @ root.T + 1e-4 * np.eye(6), rng.normal(size=6)
    direction = rng.normal(size=(POINTS, 6))
    radius = np.minimum(rng.uniform(0, 2, (POINTS, 1)), 1.0) / np.linalg.norm(direction, axis=1, keepdims=True)
    states = joint["centre"] + radius * direction @ np.linalg.cholesky(joint["shape"]).T
    measured_m2 = rng.uniform(0.02, 1.0, 3)
    skin = rng.normal(size=3)
    centre = states[0, :3] + 0.999 * np.sqrt(measured_m2) * skin / np.linalg.norm(skin)
    if not esmf.cut(joint, tuple(centre.tolist()), tuple(measured_m2.tolist())):
        return
    in_both = states[((states[:, :3] - centre) ** 2 / measured_m2).sum(axis=1) <= 1]
    away = in_both - joint["centre"]
    assert (np.einsum("ni,in->n", away, np.linalg.solve(joint["shape"], away.T)) <= 1 + ROUNDING).all()
    assert len(in_both) > 0
