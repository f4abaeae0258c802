"""Late samples end up where they belong."""

from __future__ import annotations

import numpy as np
import pytest

from fusion.estimation.kalman import Kalman
from fusion.messages import AlignedSample
from fusion.rewind import WINDOW_S, RewindingEstimator
from fusion.skeleton import JOINT_COUNT


@pytest.fixture
def samples(bodies):
    state = np.full(JOINT_COUNT, 2, dtype=np.uint8)
    return [
        AlignedSample(sensor, t, t, bodies.body_at(t), state, np.zeros(3), np.eye(3))
        for t, sensor in [(k / 30 + (0.011 if k % 2 else 0.0), "ab"[k % 2]) for k in range(20)]
    ]


def fed(samples):
    estimator = RewindingEstimator(Kalman)
    taken = [estimator.take(sample) for sample in samples]
    return estimator, taken


def test_any_order_of_arrival_gives_the_same_body(samples):
    late = list(samples)
    for k in range(4, 18, 3):
        late[k], late[k + 2] = late[k + 2], late[k]
    in_order, shuffled = fed(samples)[0].frame(0.7), fed(late)[0].frame(0.7)
    np.testing.assert_array_equal(in_order.positions_in_room, shuffled.positions_in_room)
    np.testing.assert_array_equal(in_order.bound_m, shuffled.bound_m)


def test_a_sample_later_than_the_window_is_not_used(samples):
    estimator, taken = fed([samples[-1], samples[0]])
    assert samples[-1].t_s - samples[0].t_s > WINDOW_S
    assert taken == [(), None]
    assert estimator.newest_s == samples[-1].t_s


def test_a_restart_forgets_everything(samples):
    estimator, _ = fed(samples)
    estimator.restart()
    assert estimator.newest_s is None
    assert np.isnan(estimator.frame(1.0).positions_in_room).all()
