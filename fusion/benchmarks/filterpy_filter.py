"""The baseline in FilterPy: one constant-velocity Kalman filter with a 4-sigma gate per joint."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
from filterpy.common import Q_discrete_white_noise
from filterpy.kalman import KalmanFilter

from fusion.estimation.gated_filter import GATE_SIGMA
from fusion.estimation.kalman import TRACKED_STD_M
from fusion.messages import AlignedSample, Floats

ACCELERATION_STD = 12.0
"""m/s² per frame, as in our own filter (`fusion.estimation.gated_filter`)."""


class FilterPyBody:
    """Takes the same samples as an estimator; does less: no sets, no bounds, no judgement but the gate."""

    def __init__(self, joints: int) -> None:
        self._filters = [_filter() for _ in range(joints)]
        self._t_s: float | None = None

    def take(self, samples: Sequence[AlignedSample]) -> Floats:
        """(J, 3) m after all samples of one frame."""
        for sample in samples:
            dt = 0.0 if self._t_s is None else sample.t_s - self._t_s
            self._t_s = sample.t_s
            motion, noise = _motion(dt)
            for one, position in zip(self._filters, sample.positions_in_room, strict=True):
                _take(one, position, motion, noise)
        return np.array([one.x[::2] for one in self._filters])


def _filter() -> KalmanFilter:
    one = KalmanFilter(dim_x=6, dim_z=3)
    one.x = np.zeros(6)
    one.P = np.eye(6) * 10.0
    one.R = np.eye(3) * TRACKED_STD_M**2
    one.H = np.zeros((3, 6))
    one.H[[0, 1, 2], [0, 2, 4]] = 1.0
    return one


def _motion(dt: float) -> tuple[Floats, Floats]:
    step = np.kron(np.eye(3), np.array([[1.0, dt], [0.0, 1.0]]))
    return step, Q_discrete_white_noise(2, dt, ACCELERATION_STD**2, block_size=3)


def _take(one: KalmanFilter, position: Floats, motion: Floats, noise: Floats) -> None:
    one.predict(F=motion, Q=noise)
    residual = position - one.H @ one.x
    covariance = one.H @ one.P @ one.H.T + one.R
    if residual @ np.linalg.solve(covariance, residual) <= GATE_SIGMA**2:
        one.update(position)
