"""The default: a set that holds each joint whatever sensors and limbs do within their bounds, and a point inside it.

The stable form of [Du2016 §2.4], see [methods §5]. Every believed measurement is a box in range, azimuth and elevation
that cuts the set; a bound of ±0.2 m refuses nothing below half a metre, so the point is the mean of a gated filter
that takes only what is believed, or what agrees with it.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import ClassVar, Final

import numpy as np

from fusion.estimation import ball, bias, gated_filter, motion_set, refusals, trust
from fusion.estimation.estimator import Estimator
from fusion.estimation.evidence import Evidence, weigh
from fusion.estimation.freshness import LOST_AFTER_S, TOO_OLD_S, state_of
from fusion.estimation.gated_filter import Track
from fusion.estimation.measurement import Flags
from fusion.estimation.motion_set import MotionSet
from fusion.estimation.trust import SensorTrust
from fusion.messages import AlignedSample, Floats, FusedFrame, Refusal
from fusion.skeleton import JOINT_COUNT

GATE_SIGMA: Final = 4.0
RESTART_AFTER_S: Final = 0.5
"""Refusals in a row for this long mean that the set is wrong, not the sensors."""


@dataclass(frozen=True, slots=True)
class SetState:
    """All that the estimator knows."""

    track: Track
    motion: MotionSet
    sensors: tuple[SensorTrust, ...]
    biases: bias.Biases
    worst_innovation_m: Floats  # (J,)
    refused_since_s: Floats  # (J,) when the present row of refusals began; +inf when there is none
    latest: refusals.Latest


class SetMembership(Estimator):
    """Gated mean inside a set under bounded error, acceleration and speed."""

    name: ClassVar[str] = "set-membership"

    def __init__(self) -> None:
        none = np.full(JOINT_COUNT, np.inf)
        nothing = gated_filter.unseen(-np.inf)
        self._state = SetState(nothing, motion_set.anywhere(-np.inf), (), (), ball.start(), none, ())

    def update(self, sample: AlignedSample) -> tuple[Refusal, ...]:
        """Judge the sample, cut the set with what is believed of it, and move the point."""
        if sample.t_s < self._state.track.t_s - TOO_OLD_S:
            return ()
        self._state, refused = _take(self._state, sample)
        return refused

    def frame(self, t_s: float) -> FusedFrame:
        """The filter's mean kept inside the set, and the farthest point of set and ball from it."""
        state = self._state
        track = gated_filter.predict(state.track, t_s)
        low, high = motion_set.extent(motion_set.move(state.motion, t_s))
        point = np.clip(track.position, low, high)
        half = np.maximum(high - point, point - low)  # (J, 3)
        corner_m = np.linalg.norm(half, axis=1)
        radius_m = ball.radius_m(state.worst_innovation_m, trust.last_believed_s(state.sensors), t_s)
        bound_m = np.where(np.isfinite(track.seen_s), np.minimum(corner_m, radius_m), np.inf)
        shape_m2 = _shape(half, bound_m, radius_m < corner_m)
        recent = refusals.fresh(state.latest, t_s)
        return FusedFrame(t_s, point, shape_m2, bound_m, state_of(track.seen_s, t_s), recent)

    def snapshot(self) -> object:
        """The estimator's state."""
        return self._state

    def restore(self, snapshot: object) -> None:
        """Go back to an earlier state."""
        if not isinstance(snapshot, SetState):
            raise TypeError(f"a snapshot of {self.name} is a SetState, not {type(snapshot).__name__}")
        self._state = snapshot


def _shape(half: Floats, bound_m: Floats, is_ball: Flags) -> Floats:
    """(J, 3, 3) m², the ball, or the ellipsoid around the set's box; NaN for a joint never seen."""
    squares = np.where(is_ball[:, None], bound_m[:, None] ** 2, 3 * half**2)
    return np.where(np.isfinite(bound_m), 1.0, np.nan)[:, None, None] * squares[:, :, None] * np.eye(3)


def _take(state: SetState, sample: AlignedSample) -> tuple[SetState, tuple[Refusal, ...]]:
    track = gated_filter.predict(state.track, sample.t_s)
    motion = motion_set.move(state.motion, sample.t_s)
    own, others = trust.split(state.sensors, sample.sensor)
    evidence, own = weigh(sample, own, others, track, bias.offset_of(state.biases, sample.sensor))
    fit = _fit(state, track, motion, evidence)
    innovation_m = np.linalg.norm(evidence.unbiased - track.position, axis=1)
    worst_m = ball.learn(
        state.worst_innovation_m, innovation_m, fit.taken & evidence.believed, track.t_s - state.track.t_s
    )
    refused = _refusals(sample.sensor, evidence, fit)
    latest = refusals.remember(state.latest, sample.sensor, sample.t_s, refused)
    own = trust.believe(own, track.t_s, (fit.taken | fit.begun) & evidence.believed)
    difference_m = evidence.positions - track.position
    biases = bias.learn(state.biases, sample.sensor, track.t_s, difference_m, evidence.shared & fit.taken & fit.near)
    track = _corrected(track, evidence, fit)
    motion = motion_set.begin(fit.motion, evidence.positions, evidence.half_width, fit.begun)
    return SetState(track, motion, (*others, own), biases, worst_m, fit.refused_since_s, latest), refused


@dataclass(frozen=True, slots=True)
class Fit:
    """How the evidence fits what was expected."""

    motion: MotionSet  # cut with what is taken
    near: Flags  # (J,) used and within the gate
    taken: Flags  # (J,) within the gate, or with nothing to judge it by, and meeting the set
    begun: Flags  # (J,) used, and the joint starts anew from it
    refused_since_s: Floats  # (J,)


def _fit(state: SetState, track: Track, motion: MotionSet, evidence: Evidence) -> Fit:
    near = evidence.used & (gated_filter.sigmas_off(track, evidence.unbiased, evidence.variance) <= GATE_SIGMA)
    motion, met = motion_set.take(motion, evidence.positions, evidence.half_width, near | evidence.unchecked)
    since_s = np.where(evidence.used, np.minimum(state.refused_since_s, track.t_s), state.refused_since_s)
    since_s = np.where(met, np.inf, since_s)
    lost = ~(track.t_s - track.seen_s < LOST_AFTER_S)
    begun = evidence.used & (lost | (track.t_s - since_s >= RESTART_AFTER_S))
    return Fit(motion, near, met & ~begun, begun, np.where(begun, np.inf, since_s))


def _corrected(track: Track, evidence: Evidence, fit: Fit) -> Track:
    """Take what is near; start anew where the joint is begun, or where it was not near and nothing spoke against it."""
    corrected = gated_filter.correct(track, evidence.unbiased, evidence.variance, fit.taken & fit.near)
    anew = fit.begun | (fit.taken & ~fit.near)
    return gated_filter.start(corrected, evidence.unbiased, evidence.variance, anew)


def _refusals(sensor: str, evidence: Evidence, fit: Fit) -> tuple[Refusal, ...]:
    asked = evidence.used & ~fit.taken & ~fit.begun
    tried = fit.near | evidence.unchecked
    return (
        *refusals.refuse(sensor, evidence.outvoted & evidence.wandering, "bone length changed"),
        *refusals.refuse(sensor, evidence.outvoted & ~evidence.wandering, "in doubt, another sensor is sure"),
        *refusals.refuse(sensor, asked & ~tried, f"beyond {GATE_SIGMA:g} sigma"),
        *refusals.refuse(sensor, asked & tried, "does not meet the set"),
    )
