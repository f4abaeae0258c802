"""The baseline in Stone Soup: one constant-velocity Kalman filter with a 4-sigma gate per joint."""

from __future__ import annotations

from collections.abc import Sequence
from datetime import UTC, datetime, timedelta
from typing import Final

import numpy as np
from stonesoup.measures import Mahalanobis
from stonesoup.models.measurement.linear import LinearGaussian
from stonesoup.models.transition.linear import CombinedLinearGaussianTransitionModel, ConstantVelocity
from stonesoup.predictor.kalman import KalmanPredictor
from stonesoup.types.detection import Detection
from stonesoup.types.hypothesis import SingleHypothesis
from stonesoup.types.state import GaussianState
from stonesoup.updater.kalman import KalmanUpdater

from fusion.estimation.gated_filter import GATE_SIGMA
from fusion.estimation.kalman import TRACKED_STD_M
from fusion.messages import AlignedSample, Floats

EPOCH: Final = datetime(2000, 1, 1, tzinfo=UTC)
ACCELERATION_DENSITY: Final = 12.0**2 / 30
"""m²/s³: 12 m/s² per frame of 1/30 s."""


class StoneSoupBody:
    """Takes the same samples as an estimator; does less: no sets, no bounds, no judgement but the gate."""

    def __init__(self, joints: int) -> None:
        motion = CombinedLinearGaussianTransitionModel([ConstantVelocity(ACCELERATION_DENSITY)] * 3)
        self._predictor = KalmanPredictor(motion)
        self._model = LinearGaussian(6, (0, 2, 4), np.eye(3) * TRACKED_STD_M**2)
        self._updater = KalmanUpdater(self._model)
        self._apart = Mahalanobis()
        self._states = [GaussianState(np.zeros((6, 1)), np.eye(6) * 10.0, EPOCH) for _ in range(joints)]

    def take(self, samples: Sequence[AlignedSample]) -> Floats:
        """(J, 3) m after all samples of one frame."""
        for sample in samples:
            at = EPOCH + timedelta(seconds=sample.t_s)
            pairs = zip(self._states, sample.positions_in_room, strict=True)
            self._states = [self._taken(state, position, at) for state, position in pairs]
        return np.array([np.asarray(state.state_vector).ravel()[::2] for state in self._states])

    def _taken(self, state: GaussianState, position: Floats, at: datetime) -> GaussianState:
        prediction = self._predictor.predict(state, timestamp=at)
        detection = Detection(position[:, None], timestamp=at, measurement_model=self._model)
        expected = self._updater.predict_measurement(prediction, self._model)
        if self._apart(expected, detection) > GATE_SIGMA:
            return prediction
        return self._updater.update(SingleHypothesis(prediction, detection, expected))
