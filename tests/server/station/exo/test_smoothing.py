"""Calming the target: a resting arm rests, a moving one is not left behind."""

from __future__ import annotations

import numpy as np
import pytest

from server.station.exo.driver import ZERO
from server.station.exo.mapping import JointTarget
from server.station.exo.smoothing import Calm, calmed

DT_S = 0.01


def _calmed(angles: np.ndarray) -> np.ndarray:
    state, out = Calm(), []
    for angle in angles:
        state, target = calmed(state, JointTarget((float(angle),) * 4, ZERO, ZERO, (1.0,) * 4), DT_S)
        assert target is not None
        out.append(target.angle_rad[1])
    return np.array(out)


def test_noise_of_a_resting_arm_is_more_than_halved() -> None:
    noise = np.random.default_rng(1).normal(0, 0.05, 5000)
    assert _calmed(noise)[200:].std() < 0.5 * 0.05


def test_a_steady_movement_is_followed_without_lag() -> None:
    ramp = np.arange(400) * DT_S * 0.5
    assert _calmed(ramp)[-1] == pytest.approx(ramp[-1], abs=0.01)


def test_the_first_target_is_taken_as_it_is() -> None:
    assert _calmed(np.array([0.7]))[0] == 0.7


def test_a_lost_target_is_forgotten() -> None:
    state, target = calmed(Calm((1.0,) * 4, (1.0,) * 4), None, DT_S)
    assert (state, target) == (Calm(), None)
