"""The two methods that the default is measured against."""

from __future__ import annotations

import numpy as np
import pytest

from fusion.estimation.average import Average
from fusion.estimation.gated_filter import RESTART_AFTER_S
from fusion.estimation.kalman import Kalman
from fusion.skeleton import TrackingState

from .scene import ELBOW, FRAME_S, WRIST, both, changed, sample_at

FAR = np.array([1.0, 0.0, 0.0])


def settled() -> Kalman:
    kalman = Kalman()
    for sample in both(2.0):
        kalman.update(sample)
    return kalman


def test_the_gate_refuses_what_is_far_and_says_why() -> None:
    kalman = settled()
    before = kalman.frame(2.0).positions_in_room[WRIST]
    refused = kalman.update(changed(sample_at(2.0), WRIST, FAR))
    assert [(refusal.sensor, refusal.joint, refusal.reason) for refusal in refused] == [
        ("front", WRIST, "beyond 4 sigma")
    ]
    np.testing.assert_allclose(kalman.frame(2.0).positions_in_room[WRIST], before, atol=0.01)


def test_half_a_second_of_refusals_in_a_row_begins_anew() -> None:
    kalman = settled()
    for k in range(round((RESTART_AFTER_S + 0.1) / FRAME_S)):
        far = changed(sample_at(2.0 + k * FRAME_S), WRIST, 3 * FAR)  # the gate widens as it refuses
        refused = kalman.update(far)
        if k * FRAME_S < RESTART_AFTER_S - FRAME_S:
            assert refused
    assert not refused
    np.testing.assert_allclose(kalman.frame(far.t_s).positions_in_room[WRIST], far.positions_in_room[WRIST], atol=0.05)


def test_an_inferred_joint_pulls_less_than_a_tracked_one() -> None:
    pulled = {}
    for state in (TrackingState.INFERRED, TrackingState.TRACKED):
        kalman = settled()
        before = kalman.frame(2.0).positions_in_room[WRIST]
        kalman.update(changed(sample_at(2.0), WRIST, 0.06, state))
        pulled[state] = np.linalg.norm(kalman.frame(2.0).positions_in_room[WRIST] - before)
    assert pulled[TrackingState.INFERRED] < pulled[TrackingState.TRACKED] / 2


def test_the_average_is_the_mean_of_the_sensors_that_give_the_joint() -> None:
    average = Average()
    front, side = changed(sample_at(0.0), WRIST, 0.1), changed(sample_at(0.0, "side"), ELBOW, np.nan, state=0)
    average.update(front)
    average.update(side)
    at = average.frame(0.01).positions_in_room
    np.testing.assert_allclose(at[WRIST], (front.positions_in_room[WRIST] + side.positions_in_room[WRIST]) / 2)
    np.testing.assert_allclose(at[ELBOW], front.positions_in_room[ELBOW])


@pytest.mark.parametrize(("silent_s", "counts"), [(0.05, True), (0.5, False)])
def test_a_sensor_that_fell_silent_leaves_the_average(silent_s: float, counts: bool) -> None:
    average = Average()
    old, new = sample_at(0.0, "side"), changed(sample_at(silent_s), slice(None), FAR)
    average.update(old)
    average.update(new)
    at = average.frame(silent_s).positions_in_room[WRIST]
    both_m, alone_m = (old.positions_in_room[WRIST] + new.positions_in_room[WRIST]) / 2, new.positions_in_room[WRIST]
    np.testing.assert_allclose(at, both_m if counts else alone_m)
