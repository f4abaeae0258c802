"""A joint that is not where it is told to be is found, and one that is, never."""

from __future__ import annotations

import numpy as np
from hypothesis import given
from hypothesis import strategies as st

from server.exoskeleton import BUILT_IN
from server.station.exo.cia402.following import FAR_RAD, FAR_S, Following

STIFF, SOFT = np.zeros(7, dtype=bool), np.ones(7, dtype=bool)
ZERO = np.zeros(7)
ELBOW = np.eye(7)[3]


def _judged(told: list[np.ndarray], measured: list[np.ndarray], soft: np.ndarray = STIFF) -> list[str]:
    following = Following(BUILT_IN.joints)
    return [
        following.judge(wanted, angle, soft, index * 0.01)
        for index, (wanted, angle) in enumerate(zip(told, measured, strict=True))
    ]


@given(st.floats(-2, 2), st.floats(-0.3, 0.3))
def test_motion_at_the_joints_speed_with_a_little_lag_is_no_fault(speed: float, lag_rad: float) -> None:
    told = [np.full(7, speed * 0.01 * tick) for tick in range(100)]
    assert not any(_judged(told, [wanted - lag_rad for wanted in told]))


def test_a_joint_that_stays_far_is_found_after_its_time_and_named() -> None:
    said = _judged([ELBOW * (FAR_RAD + 0.01)] * 60, [ZERO] * 60)
    first = next(index for index, words in enumerate(said) if words)
    assert first * 0.01 > FAR_S
    assert "'elbow' does not follow" in said[first]


def test_a_joint_that_gives_way_may_be_anywhere() -> None:
    assert not any(_judged([ELBOW] * 100, [ZERO] * 100, SOFT))


def test_a_measurement_that_leaps_is_found_at_once() -> None:
    said = _judged([ZERO] * 3, [ZERO, ZERO, ELBOW * 0.3])
    assert said[:2] == ["", ""]
    assert "'elbow' measures a place that it cannot have moved to" in said[2]


def test_measurements_that_come_late_and_then_catch_up_are_no_leap() -> None:
    moving = [ZERO, ZERO, ZERO, ZERO, ELBOW * 0.08]
    assert not any(_judged(moving, moving))
