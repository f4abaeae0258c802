"""The baseline: a constant-velocity Kalman filter per joint with a 4-sigma gate."""

from __future__ import annotations

from dataclasses import dataclass
from math import isinf, sqrt
from typing import ClassVar, Final, TypeAlias

import numpy as np

from fusion.compiled import Records, kernel, record
from fusion.estimation import gated_filter, refusals
from fusion.estimation.estimator import Estimator
from fusion.estimation.freshness import CONTINUE_S, counts, state_of
from fusion.estimation.gated_filter import ACCELERATION_DENSITY, GATE_SIGMA
from fusion.estimation.measurement import Sight, read, sight
from fusion.estimation.vectors import put, row
from fusion.messages import AlignedSample, Floats, FusedFrame, Refusal, States
from fusion.skeleton import JOINT_COUNT

TRACKED_STD_M: Final = 0.035
INFERRED_STD_M: Final = 0.14
"""Also of a joint that the same sensor inferred within the last three frames (six serve as well): a wandering joint
flickers between inferred and tracked, and is no better in the frames that say tracked."""
REASONS: Final = ("", f"beyond {GATE_SIGMA:g} sigma")
TAKEN, GATE = range(len(REASONS))
JOINT: Final = record(gated_filter.FIELDS)
Times: TypeAlias = Floats
"""(J, K) s, when each sensor last inferred each joint; -inf never."""


@dataclass(frozen=True, slots=True)
class KalmanState:
    """All that the filter knows at `t_s`."""

    t_s: float
    joints: Records  # (J,) of JOINT
    sensors: tuple[str, ...]
    inferred_s: Times
    latest: refusals.Latest


class Kalman(Estimator):
    """Gated constant-velocity Kalman filter; the bound is four standard deviations and no guarantee."""

    name: ClassVar[str] = "kalman"

    def __init__(self, joints: int = JOINT_COUNT) -> None:
        self._state = KalmanState(-np.inf, _unseen(np.zeros(joints, JOINT)), (), np.zeros((joints, 0)), ())

    def update(self, sample: AlignedSample) -> tuple[Refusal, ...]:
        """Predict to the sample, refuse what is beyond the gate, take the rest."""
        if not counts(sample.t_s, self._state.t_s):
            return ()
        self._state, refused = _updated(self._state, sample)
        return refused

    def frame(self, t_s: float) -> FusedFrame:
        """The predicted mean; the set is the ball of four standard deviations."""
        told = _tell(self._state.joints, self._state.t_s, float(t_s))
        return FusedFrame(t_s, *told, refusals.fresh(self._state.latest, t_s))

    def snapshot(self) -> object:
        """The filter's state."""
        return self._state

    def restore(self, snapshot: object) -> None:
        """Go back to an earlier state."""
        if not isinstance(snapshot, KalmanState):
            raise TypeError(f"a snapshot of {self.name} is a KalmanState, not {type(snapshot).__name__}")
        self._state = snapshot


def _updated(state: KalmanState, sample: AlignedSample) -> tuple[KalmanState, tuple[Refusal, ...]]:
    sensors, inferred_s = state.sensors, state.inferred_s
    if sample.sensor not in sensors:
        sensors = (*sensors, sample.sensor)
        inferred_s = np.concatenate([inferred_s, np.full((len(inferred_s), 1), -np.inf)], axis=1)
    own, at_s = sensors.index(sample.sensor), float(sample.t_s)
    t_s = max(at_s, state.t_s)
    seen = sight(sample, len(state.joints))
    joints, inferred_s, codes = _take(state.joints, inferred_s, own, seen, state.t_s, t_s, t_s - at_s)
    refused = refusals.refused(sample.sensor, codes, REASONS)
    latest = refusals.remember(state.latest, sample.sensor, at_s, refused)
    return KalmanState(t_s, joints, sensors, inferred_s, latest), refused


@kernel
def _unseen(joints: Records) -> Records:
    for j in range(len(joints)):
        gated_filter.forget(joints[j])
    return joints


@kernel
def _take(
    before: Records, inferred_before_s: Times, own: int, seen: Sight, from_s: float, t_s: float, late_s: float
) -> tuple[Records, Times, refusals.Codes]:
    """Move all joints from `from_s` to `t_s`, take what sensor `own` measured `late_s` before.

    Returns the joints and times after, and what was refused.
    """
    joints, inferred_s, measured = before.copy(), inferred_before_s.copy(), read(seen)
    codes = np.zeros(len(joints), np.uint8)
    for j in range(len(joints)):
        joint = joints[j]
        gated_filter.predict(joint, from_s, t_s, ACCELERATION_DENSITY)
        if not measured.given[j]:
            continue
        if not measured.tracked[j]:
            inferred_s[j, own] = t_s
        position = gated_filter.carried_on(joint, row(measured.positions, j), late_s)
        variance = TRACKED_STD_M**2 if t_s - inferred_s[j, own] > CONTINUE_S else INFERRED_STD_M**2
        near = gated_filter.sigmas_off(joint, position, variance) <= GATE_SIGMA
        insists = gated_filter.insists(joint, near, t_s)
        if near:
            gated_filter.correct(joint, position, variance, t_s)
        elif insists or isinf(joint.seen_s):
            gated_filter.start(joint, position, variance, t_s)
        else:
            codes[j] = GATE
    return joints, inferred_s, codes


@kernel
def _tell(before: Records, from_s: float, t_s: float) -> tuple[Floats, Floats, Floats, States]:
    """Positions (J, 3), shapes (J, 3, 3), bounds (J,) and states (J,) of the joints moved on to `t_s`."""
    joints, count = before.copy(), len(before)
    positions, shape_m2 = np.empty((count, 3)), np.zeros((count, 3, 3))
    bound_m, states = np.empty(count), np.empty(count, np.uint8)
    for j in range(count):
        joint = joints[j]
        gated_filter.predict(joint, from_s, t_s, ACCELERATION_DENSITY)
        seen = not isinf(joint.seen_s)
        put(positions, j, (joint.position[0], joint.position[1], joint.position[2]))
        bound_m[j] = GATE_SIGMA * sqrt(joint.pp) if seen else np.inf
        for k in range(3):
            shape_m2[j, k, k] = bound_m[j] ** 2
        if not seen:
            shape_m2[j] = np.nan
        states[j] = state_of(joint.seen_s, t_s)
    return positions, shape_m2, bound_m, states
