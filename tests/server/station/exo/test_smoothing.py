"""Calming the target: a resting arm rests, a moving one is not left behind, and noise decides between the two."""

from __future__ import annotations

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from fusion.messages import Floats
from server.station.exo.driver import ZERO
from server.station.exo.mapping import JointTarget
from server.station.exo.smoothing import DAMPING, LEAD, QUICKNESS_1_S, Calm, calmed

DT_S = 0.01


def _target(angle: float) -> JointTarget:
    return JointTarget((angle,) * 4, ZERO, ZERO, (1.0,) * 4)


def _run(angles: Floats) -> tuple[Calm, Floats]:
    state, out = Calm(), []
    for angle in angles.tolist():
        state, target = calmed(state, _target(angle), DT_S)
        assert target is not None
        out.append(target.angle_rad[1])
    return state, np.array(out)


def test_noise_of_a_resting_arm_is_more_than_halved() -> None:
    noise = np.random.default_rng(1).normal(0, 0.05, 5000)
    assert _run(noise)[1][200:].std() < 0.5 * 0.05


def test_more_noise_makes_it_slower_and_less_makes_it_quicker_within_bounds() -> None:
    random = np.random.default_rng(2)
    loud, usual, still = (_run(random.normal(0, size, 2000))[0].joints[1].quickness_1_s for size in (0.3, 0.03, 0.0))
    assert loud == QUICKNESS_1_S[0] < usual < still == QUICKNESS_1_S[1]


def test_a_reach_alone_is_not_taken_for_noise() -> None:
    share = np.clip(np.arange(200) / 125, 0, 1)
    reach = 1.0 * share**3 * (10 - 15 * share + 6 * share**2)  # peak 1.5 rad/s
    state, _ = _run(np.concatenate([np.zeros(1000), reach]))
    assert state.joints[1].quickness_1_s > 20


def test_behind_a_steady_movement_of_good_sensors_it_stays_less_than_60_ms() -> None:
    ramp = np.arange(1500) * DT_S * 0.5
    behind_s = (ramp[-1] - _run(ramp)[1][-1]) / 0.5
    assert behind_s == pytest.approx(2 * DAMPING * (1 - LEAD) / QUICKNESS_1_S[1], abs=0.002)
    assert behind_s < 0.06


def test_the_velocity_told_is_that_of_the_target() -> None:
    state, target = Calm(), None
    for angle in (np.arange(2000) * DT_S * 0.5).tolist():
        state, target = calmed(state, _target(angle), DT_S)
    assert target is not None
    assert target.velocity_rad_s[0] == pytest.approx(0.5, abs=2e-3)


def test_the_first_target_is_taken_as_it_is() -> None:
    assert _run(np.array([0.7]))[1][0] == 0.7


def test_a_lost_target_is_forgotten() -> None:
    state, _ = calmed(Calm(), _target(1.0), DT_S)
    assert calmed(state, None, DT_S) == (Calm(), None)


@settings(max_examples=100, derandomize=True, deadline=None)
@given(st.lists(st.floats(-3.2, 3.2), min_size=2, max_size=60), st.floats(1e-4, 0.05))
def test_whatever_is_seen_it_stays_near_what_was_seen(seen: list[float], dt_s: float) -> None:
    """The step response overshoots by 1.5 %, and the lead adds less than a step's height."""
    state = Calm()
    for angle in seen:
        state, target = calmed(state, _target(angle), dt_s)
        assert target is not None
        assert abs(target.angle_rad[0]) <= 2 * max(map(abs, seen)) + 1e-9
