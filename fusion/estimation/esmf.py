"""The extended set-membership filter as [Du2016 §2.4] prints it, with the gain mended (docs/estimation.md).

Each joint's [p; v] lies in one ellipsoid of six dimensions. The measurement is turned to Cartesian with the remainder
of its own box; bounding it over the predicted set, as printed, lets the sets explode.
"""

from __future__ import annotations

from dataclasses import dataclass
from math import isfinite, sqrt
from typing import ClassVar, Final

import numpy as np

from fusion.compiled import Record, Records, kernel, record
from fusion.estimation import refusals
from fusion.estimation.error_box import half_width_in_room
from fusion.estimation.estimator import Estimator
from fusion.estimation.evidence import BELIEVED_HALF_WIDTH_M, DOUBTED_HALF_WIDTH_M
from fusion.estimation.freshness import LOST_AFTER_S, counts, seconds_in_motion, state_of
from fusion.estimation.gated_filter import insists
from fusion.estimation.matrices import inverse, largest_eigenvalue
from fusion.estimation.measurement import Measurement, Sight, read, sight
from fusion.estimation.motion_set import ACCELERATION_MAX, SPEED_MAX
from fusion.estimation.vectors import Vector, length, plus, row, widened
from fusion.messages import AlignedSample, Floats, FusedFrame, Refusal, States
from fusion.skeleton import JOINT_COUNT

REASONS: Final = ("", "does not meet the set")
TAKEN, SET = range(len(REASONS))
JOINT: Final = record(
    [
        ("centre", "f8", (6,)),  # m and m/s; NaN for a joint never seen
        ("shape", "f8", (6, 6)),  # of E(centre, shape)
        ("seen_s", "f8"),  # time of the last measurement that was used
        ("refused_since_s", "f8"),  # when the present row of refusals began; +inf when there is none
    ]
)


@dataclass(frozen=True, slots=True)
class EsmfState:
    """All that the filter knows at `t_s`."""

    t_s: float
    joints: Records  # (J,) of JOINT
    latest: refusals.Latest


class Esmf(Estimator):
    """The paper's ellipsoid: the point is its centre, the bound its longest half axis."""

    name: ClassVar[str] = "esmf"

    def __init__(self, joints: int = JOINT_COUNT) -> None:
        unseen = np.zeros(joints, JOINT)
        unseen["centre"], unseen["shape"] = np.nan, np.eye(6)
        unseen["seen_s"], unseen["refused_since_s"] = -np.inf, np.inf
        self._state = EsmfState(-np.inf, unseen, ())

    def update(self, sample: AlignedSample) -> tuple[Refusal, ...]:
        """Predict to the sample, drop what does not meet its set, cut with the rest."""
        if not counts(sample.t_s, self._state.t_s):
            return ()
        self._state, refused = _updated(self._state, sample)
        return refused

    def frame(self, t_s: float) -> FusedFrame:
        """The predicted ellipsoid; its centre is halted three frames after the last measurement (SR-4)."""
        told = _tell(self._state.joints, self._state.t_s, float(t_s))
        return FusedFrame(t_s, *told, refusals.fresh(self._state.latest, t_s))

    def snapshot(self) -> object:
        """The filter's state."""
        return self._state

    def restore(self, snapshot: object) -> None:
        """Go back to an earlier state."""
        if not isinstance(snapshot, EsmfState):
            raise TypeError(f"a snapshot of {self.name} is an EsmfState, not {type(snapshot).__name__}")
        self._state = snapshot


def _updated(state: EsmfState, sample: AlignedSample) -> tuple[EsmfState, tuple[Refusal, ...]]:
    at_s = float(sample.t_s)
    t_s = max(at_s, state.t_s)
    joints, codes = _take(state.joints, sight(sample, len(state.joints)), state.t_s, t_s, t_s - at_s)
    refused = refusals.refused(sample.sensor, codes, REASONS)
    return EsmfState(t_s, joints, refusals.remember(state.latest, sample.sensor, at_s, refused)), refused


@kernel
def predict(joint: Record, dt: float) -> None:
    """F E ⊕ Q: P/(1-b) + Q/b with b = √tr Q / (√tr P + √tr Q), Q what |a| <= 20 m/s² adds to p and v."""
    if not 0 < dt < np.inf:  # an older sample, or the very first
        return
    P = joint.shape
    for i in range(3):
        joint.centre[i] += dt * joint.centre[3 + i]
        for k in range(6):
            P[i, k] += dt * P[3 + i, k]  # F P, then (F P) F'
    trace = 0.0
    for i in range(6):
        for k in range(3):
            P[i, k] += dt * P[i, 3 + k]
        trace += P[i, i]
    added_p, added_v = ACCELERATION_MAX**2 * dt**4 / 2, 2 * ACCELERATION_MAX**2 * dt**2  # doubled: both balls at once
    ratio = sqrt(3 * (added_p + added_v) / trace)  # b / (1 - b)
    for i in range(6):
        for k in range(6):
            P[i, k] *= 1 + ratio
        P[i, i] += (added_p if i < 3 else added_v) * (1 + 1 / ratio)


@kernel
def cut(joint: Record, position: Vector, measured_m2: Vector) -> bool:
    """Cut with the ellipsoid around `position` of diagonal shape `measured_m2`; says whether they met.

    B = P/(1-ρ), W = (C B C' + R/ρ)⁻¹, K = B C' W, x + K d, δ = d' W d, (1-δ)(B - B C' W C B), with
    ρ = √r/(√p + √r), r and p the largest singular values of R and C P C'. They met where δ < 1; else it stays.
    """
    r, p = sqrt(max(measured_m2[0], measured_m2[1], measured_m2[2])), sqrt(largest_eigenvalue(joint.shape))
    rho = r / (p + r)
    B, S, d = np.empty((6, 6)), np.empty((3, 3)), np.empty(3)
    for i in range(6):
        for k in range(6):
            B[i, k] = joint.shape[i, k] / (1 - rho)
    for i in range(3):
        for k in range(3):
            S[i, k] = B[i, k]
        S[i, i] += measured_m2[i] / rho
        d[i] = position[i] - joint.centre[i]
    W = inverse(S)
    delta = _form(d, W, d)
    if delta < 1:
        _shrink(joint, B, W, d, 1 - delta)
    return delta < 1


@kernel
def _shrink(joint: Record, B: Floats, W: Floats, d: Floats, left: float) -> None:
    """Take x + B C' W d and (1-δ)(B - B C' W C B), the latter's two halves alike."""
    for i in range(6):
        joint.centre[i] += _form(B[i], W, d)
        for k in range(i + 1):
            entry = left * (B[i, k] - _form(B[i], W, B[k]))
            joint.shape[i, k], joint.shape[k, i] = entry, entry


@kernel
def _form(a: Floats, W: Floats, b: Floats) -> float:
    """The sum a' W b over the first three of each."""
    total = 0.0
    for i in range(3):
        for k in range(3):
            total += a[i] * W[i, k] * b[k]
    return total


@kernel
def _take(before: Records, seen: Sight, from_s: float, t_s: float, late_s: float) -> tuple[Records, refusals.Codes]:
    """Move all joints from `from_s` to `t_s`, take what was measured `late_s` before, say what was refused."""
    joints, measured = before.copy(), read(seen)
    codes = np.zeros(len(joints), np.uint8)
    for j in range(len(joints)):
        joint = joints[j]
        predict(joint, t_s - from_s)
        if not measured.given[j]:
            continue
        position = _carried_on(joint, row(measured.positions, j), late_s)
        measured_m2 = _measured_m2(seen, measured, j, 2 * SPEED_MAX * late_s)  # it may have gone the other way
        met = cut(joint, position, measured_m2)
        insisting = insists(joint, met, t_s)
        if not (met or insisting or not t_s - joint.seen_s < LOST_AFTER_S):
            codes[j] = SET
            continue
        if not met:
            _begin(joint, position, measured_m2)
        joint.seen_s, joint.refused_since_s = t_s, np.inf
    return joints, codes


@kernel
def _carried_on(joint: Record, position: Vector, late_s: float) -> Vector:
    """A position measured a little before the joint's own time, moved on with its velocity."""
    if not isfinite(joint.seen_s):
        return position
    v = joint.centre
    slow = (min(max(v[3], -SPEED_MAX), SPEED_MAX), min(max(v[4], -SPEED_MAX), SPEED_MAX))
    return plus(position, (slow[0], slow[1], min(max(v[5], -SPEED_MAX), SPEED_MAX)), late_s)


@kernel
def _measured_m2(seen: Sight, measured: Measurement, j: int, wider_m: float) -> Vector:
    """The diagonal of the least ellipsoid around a measurement's box, in m²."""
    box_m = BELIEVED_HALF_WIDTH_M if measured.tracked[j] else DOUBTED_HALF_WIDTH_M
    from_lens = plus(row(measured.positions, j), seen.lens_in_room, -1.0)
    half = widened(half_width_in_room(from_lens, seen.rotation_sensor_to_room, box_m), wider_m)
    return (3 * half[0] ** 2, 3 * half[1] ** 2, 3 * half[2] ** 2)


@kernel
def _begin(joint: Record, position: Vector, measured_m2: Vector) -> None:
    """Start from a measurement's box alone, at any speed within the bound."""
    for i in range(6):
        for k in range(6):
            joint.shape[i, k] = 0.0
    for k in range(3):
        joint.centre[k], joint.centre[3 + k] = position[k], 0.0
        joint.shape[k, k], joint.shape[3 + k, 3 + k] = 2 * measured_m2[k], 2 * SPEED_MAX**2


@kernel
def _tell(before: Records, from_s: float, t_s: float) -> tuple[Floats, Floats, Floats, States]:
    """Positions (J, 3), shapes (J, 3, 3), bounds (J,) and states (J,) of the joints moved on to `t_s`."""
    joints, count = before.copy(), len(before)
    positions, shape_m2 = np.full((count, 3), np.nan), np.full((count, 3, 3), np.nan)
    bound_m, states = np.full(count, np.inf), np.empty(count, np.uint8)
    for j in range(count):
        joint = joints[j]
        states[j] = state_of(joint.seen_s, t_s)
        if isfinite(joint.seen_s):
            predict(joint, t_s - from_s)
            alone_s = max(t_s - from_s, 0.0) - seconds_in_motion(joint.seen_s, min(from_s, t_s), t_s)
            bound_m[j] = _tell_set(joint, max(alone_s, 0.0), positions[j], shape_m2[j])
    return positions, shape_m2, bound_m, states


@kernel
def _tell_set(joint: Record, alone_s: float, point: Floats, shape_m2: Floats) -> float:
    """Write the point and the set around it; the farthest point of the set from it.

    For `alone_s` the set moved on and the point did not: the set told is then a ball that holds it.
    """
    velocity = joint.centre[3], joint.centre[4], joint.centre[5]
    bound_m = sqrt(largest_eigenvalue(joint.shape)) + alone_s * length(velocity)
    for i in range(3):
        point[i] = joint.centre[i] - alone_s * velocity[i]
        for k in range(3):
            ball_m2 = bound_m**2 if i == k else 0.0
            shape_m2[i, k] = ball_m2 if alone_s > 0 else joint.shape[i, k]
    return bound_m
