"""The baseline: a constant-velocity Kalman filter per joint with a 4-sigma gate [methods §5]."""

from __future__ import annotations

from dataclasses import dataclass, replace
from typing import ClassVar, Final

import numpy as np

from fusion.estimation import gated_filter, refusals
from fusion.estimation.estimator import Estimator
from fusion.estimation.freshness import TOO_OLD_S, state_of
from fusion.estimation.gated_filter import Track
from fusion.estimation.measurement import Flags, Measurement, read
from fusion.messages import AlignedSample, Floats, FusedFrame, Refusal
from fusion.skeleton import JOINT_COUNT

TRACKED_STD_M: Final = 0.035
INFERRED_STD_M: Final = 0.14
GATE_SIGMA: Final = 4.0
RESTART_AFTER_S: Final = 0.5
"""Refusals in a row for this long mean that the track is wrong, not the sensors."""


@dataclass(frozen=True, slots=True)
class KalmanState:
    """All that the filter knows."""

    track: Track
    refused_since_s: Floats  # (J,) when the present row of refusals began; +inf when there is none
    latest: refusals.Latest


class Kalman(Estimator):
    """Gated constant-velocity Kalman filter; the bound is four standard deviations and no guarantee."""

    name: ClassVar[str] = "kalman"

    def __init__(self) -> None:
        self._state = KalmanState(gated_filter.unseen(-np.inf), np.full(JOINT_COUNT, np.inf), ())

    def update(self, sample: AlignedSample) -> tuple[Refusal, ...]:
        """Predict to the sample, refuse what is beyond the gate, take the rest."""
        if sample.t_s < self._state.track.t_s - TOO_OLD_S:
            return ()
        self._state, refused = _take(self._state, sample)
        return refused

    def frame(self, t_s: float) -> FusedFrame:
        """The predicted mean; the set is the ball of four standard deviations."""
        track = gated_filter.predict(self._state.track, t_s)
        seen = np.isfinite(track.seen_s)
        bound_m = np.where(seen, GATE_SIGMA * np.sqrt(track.pp), np.inf)
        shape_m2 = np.where(seen, bound_m, np.nan)[:, None, None] ** 2 * np.eye(3)
        recent = refusals.fresh(self._state.latest, t_s)
        return FusedFrame(t_s, track.position, shape_m2, bound_m, state_of(track.seen_s, t_s), recent)

    def snapshot(self) -> object:
        """The filter's state."""
        return self._state

    def restore(self, snapshot: object) -> None:
        """Go back to an earlier state."""
        if not isinstance(snapshot, KalmanState):
            raise TypeError(f"a snapshot of {self.name} is a KalmanState, not {type(snapshot).__name__}")
        self._state = snapshot


def _take(state: KalmanState, sample: AlignedSample) -> tuple[KalmanState, tuple[Refusal, ...]]:
    track = gated_filter.predict(state.track, sample.t_s)
    measured = read(sample)
    measured = replace(measured, positions=gated_filter.carried_on(track, measured.positions, sample.t_s))
    variance = np.where(measured.tracked, TRACKED_STD_M**2, INFERRED_STD_M**2)
    near, refused_since_s = _gate(state, track, measured, variance)
    begin = measured.given & ~near & (track.t_s - refused_since_s >= RESTART_AFTER_S)
    begin |= measured.given & np.isneginf(track.seen_s)
    track = gated_filter.correct(track, measured.positions, variance, near)
    track = gated_filter.start(track, measured.positions, variance, begin)
    refused = refusals.refuse(sample.sensor, measured.given & ~near & ~begin, f"beyond {GATE_SIGMA:g} sigma")
    latest = refusals.remember(state.latest, sample.sensor, sample.t_s, refused)
    return KalmanState(track, np.where(begin, np.inf, refused_since_s), latest), refused


def _gate(state: KalmanState, track: Track, measured: Measurement, variance: Floats) -> tuple[Flags, Floats]:
    """Which joints pass, and since when each has been refused in a row."""
    near = measured.given & (gated_filter.sigmas_off(track, measured.positions, variance) <= GATE_SIGMA)
    still = np.where(measured.given, np.minimum(state.refused_since_s, track.t_s), state.refused_since_s)
    return near, np.where(near, np.inf, still)
