"""The plain average of what the sensors say now; the lower end of every comparison."""

from __future__ import annotations

from dataclasses import dataclass
from typing import ClassVar, Final

import numpy as np

from fusion.estimation.estimator import Estimator
from fusion.estimation.freshness import CONTINUE_S, counts, states_of
from fusion.estimation.measurement import read, sight
from fusion.messages import AlignedSample, Floats, FusedFrame, Refusal
from fusion.skeleton import JOINT_COUNT

SENSOR_BOUND_M: Final = float(np.linalg.norm((0.2, 0.15, 0.2)))
"""Corner of one sensor's error box [Du2016 Table 1]."""
SPEED_MAX_M_S: Final = 6.0
"""A limb is no faster; what is held grows no less sure than this."""


Samples = tuple[AlignedSample, ...]


@dataclass(frozen=True, slots=True)
class AverageState:
    """The latest sample of each sensor and the last average of each joint."""

    samples: Samples
    position: Floats  # (J, 3) m
    seen_s: Floats  # (J,)


class Average(Estimator):
    """Mean over the sensors whose latest sample is no older than three frames; held when there is none."""

    name: ClassVar[str] = "average"

    def __init__(self) -> None:
        self._state = AverageState((), np.full((JOINT_COUNT, 3), np.nan), np.full(JOINT_COUNT, -np.inf))

    def update(self, sample: AlignedSample) -> tuple[Refusal, ...]:
        """Put the sample in the place of the sensor's former one; nothing is ever refused."""
        newest_s = max((s.t_s for s in self._state.samples), default=-np.inf)
        if counts(sample.t_s, newest_s):
            samples = _fresh(self._state.samples, sample, max(newest_s, sample.t_s))
            self._state = _joined(self._state, samples, self._weights(samples))
        return ()

    def frame(self, t_s: float) -> FusedFrame:
        """The last average; its bound is a sensor's box, widened while nothing is seen."""
        seen_s = self._state.seen_s
        bound_m = SENSOR_BOUND_M + SPEED_MAX_M_S * np.maximum(t_s - seen_s, 0.0)
        shape_m2 = np.where(np.isfinite(bound_m), bound_m, np.nan)[:, None, None] ** 2 * np.eye(3)
        return FusedFrame(t_s, self._state.position, shape_m2, bound_m, states_of(seen_s, float(t_s)))

    def _weights(self, samples: Samples) -> Floats:
        """(K, J) how much each sample counts for each joint that it gives."""
        return np.ones((len(samples), JOINT_COUNT))

    def snapshot(self) -> object:
        """The estimator's state."""
        return self._state

    def restore(self, snapshot: object) -> None:
        """Go back to an earlier state."""
        if not isinstance(snapshot, AverageState):
            raise TypeError(f"a snapshot of {self.name} is an AverageState, not {type(snapshot).__name__}")
        self._state = snapshot


def _fresh(samples: Samples, sample: AlignedSample, now_s: float) -> Samples:
    """The latest sample of each sensor, without what is too old."""
    others = (s for s in samples if s.sensor != sample.sensor and now_s - s.t_s <= CONTINUE_S)
    return (*others, sample)


def _joined(state: AverageState, samples: Samples, weights: Floats) -> AverageState:
    """The mean of K samples under `weights` (K, J) where they give the joint; held where none does."""
    positions = np.stack([s.positions_in_room for s in samples])  # (K, J, 3)
    given = np.stack([read(sight(s, JOINT_COUNT)).given for s in samples])  # (K, J)
    shares = np.where(given, weights, 0.0)
    total = (shares[..., None] * np.where(given[..., None], positions, 0.0)).sum(axis=0)
    count: Floats = given.sum(axis=0)
    seen = count > 0
    mean = total / np.where(seen, shares.sum(axis=0), 1.0)[:, None]
    newest_s = np.where(given, np.array([s.t_s for s in samples])[:, None], -np.inf).max(axis=0)
    return AverageState(
        samples,
        np.where(seen[:, None], mean, state.position),
        np.maximum(state.seen_s, newest_s),
    )
