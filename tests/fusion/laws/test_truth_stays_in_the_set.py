"""Whatever sensors and limbs do within their bounds, and however the sensors are mounted, the truth is in the set."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from fusion.compiled import Records
from fusion.estimation import esmf, motion_set
from fusion.estimation.esmf import Esmf, EsmfState
from fusion.estimation.estimator import Estimator
from fusion.estimation.set_membership import SetMembership, SetState
from fusion.rewind import RewindingEstimator

from .rig import Adversary, Scene, Word, a_scene

SEEDS = st.integers(0, 2**32 - 1)
ALLOWED_S = 0.35
AHEAD_S = 0.02
ROUNDING = 1e-6
Holds = Callable[[Estimator, float, np.ndarray, np.ndarray], np.ndarray]


def joints_of(estimator: Estimator) -> tuple[float, Records]:
    """What is known, and of which instant."""
    state = estimator.snapshot()
    assert isinstance(state, SetState | EsmfState)
    return state.t_s, (state.known if isinstance(state, SetState) else state).joints.copy()


def in_set(estimator: Estimator, t_s: float, position: np.ndarray, velocity: np.ndarray) -> np.ndarray:
    """(J,) whether [p; v] is in the ellipse and p in the interval on every axis; true for a joint never seen."""
    from_s, joints = joints_of(estimator)
    for joint in joints:
        motion_set.move(joint, t_s - from_s)
    on = joints["on"]
    p, v = position - on["p"], velocity - on["v"]
    square = on["vv"] * p**2 - 2 * on["pv"] * p * v + on["pp"] * v**2
    inside = square <= (1 + ROUNDING) * (on["pp"] * on["vv"] - on["pv"] ** 2)
    between = (on["low"] - ROUNDING <= position) & (position <= on["high"] + ROUNDING)
    return np.asarray((inside & between).all(axis=1) | ~np.isfinite(joints["seen_s"]))


def in_ellipsoid(estimator: Estimator, t_s: float, position: np.ndarray, velocity: np.ndarray) -> np.ndarray:
    """(J,) likewise for the paper's filter; and within the bound that it tells."""
    from_s, joints = joints_of(estimator)
    for joint in joints:
        esmf.predict(joint, t_s - from_s)
    away = np.concatenate([position, velocity], axis=1) - joints["centre"]
    depth = np.einsum("ji,ji->j", away, np.linalg.solve(joints["shape"], away[..., None])[..., 0])
    frame = estimator.frame(t_s)
    told = np.linalg.norm(position - frame.positions_in_room, axis=1) <= frame.bound_m + ROUNDING
    return np.asarray(((depth <= 1 + ROUNDING) & told) | ~np.isfinite(joints["seen_s"]))


METHODS = pytest.mark.parametrize(
    ("make", "holds"), [(SetMembership, in_set), (Esmf, in_ellipsoid)], ids=["set-membership", "esmf"]
)
scenes = {
    "seed": SEEDS,
    "sensors": st.integers(1, 4),
    "kind": st.sampled_from(Adversary.KINDS),
    "together": st.booleans(),
}


def arrivals(words: list[Word]) -> list[Word]:
    return sorted(words, key=lambda word: word.sample.t_s + word.late_s)


def assert_held(scene: Scene, estimator: Estimator, holds: Holds, now_s: float) -> None:
    """At the newest sample, and a little later without any."""
    assert holds(estimator, now_s, *scene.at(now_s)).all()
    later_s = scene.motion.t_s[np.searchsorted(scene.motion.t_s, now_s + AHEAD_S) :][:1]
    for t_s in later_s.tolist():
        assert holds(estimator, t_s, *scene.at(t_s)).all()


@METHODS
@settings(max_examples=60)
@given(**scenes)
def test_of_samples_in_their_order(
    make: Callable[[], Estimator], holds: Holds, seed: int, sensors: int, kind: str, together: bool
) -> None:
    scene = a_scene(np.random.default_rng(seed), sensors, kind, together)
    estimator = make()
    for word in scene.words:
        estimator.update(word.sample)
        assert_held(scene, estimator, holds, word.sample.t_s)


@METHODS
@settings(max_examples=40)
@given(**scenes)
def test_of_late_samples_taken_as_they_come(
    make: Callable[[], Estimator], holds: Holds, seed: int, sensors: int, kind: str, together: bool
) -> None:
    scene = a_scene(np.random.default_rng(seed), sensors, kind, together, latest_s=ALLOWED_S)
    estimator, now_s = make(), -np.inf
    for word in arrivals(scene.words):
        estimator.update(word.sample)
        now_s = max(now_s, word.sample.t_s)
        assert_held(scene, estimator, holds, now_s)


@METHODS
@settings(max_examples=20)
@given(**scenes)
def test_of_late_samples_put_in_their_place(
    make: Callable[[], Estimator], holds: Holds, seed: int, sensors: int, kind: str, together: bool
) -> None:
    scene = a_scene(np.random.default_rng(seed), sensors, kind, together, latest_s=ALLOWED_S)
    inner = make()
    rewinding = RewindingEstimator(lambda: inner)
    for word in arrivals(scene.words):
        assert rewinding.take(word.sample) is not None
        assert_held(scene, inner, holds, float(rewinding.newest_s or 0.0))


def test_the_set_is_no_wider_than_a_box_where_all_is_believed() -> None:
    """So that the laws above are of sets that say something."""
    scene = a_scene(np.random.default_rng(2), 2, "any corner", together=True)
    estimator, widths = SetMembership(), []
    for word in scene.words:
        estimator.update(word.sample)
        _, joints = joints_of(estimator)
        widths.append(np.median((joints["on"]["high"] - joints["on"]["low"])[np.isfinite(joints["seen_s"])]))
    assert np.median(widths) < 1.0
