"""The extended set-membership filter as [Du2016 §2.4] prints it, with the gain mended [methods §5].

Each joint's [p; v] lies in one ellipsoid of six dimensions. The measurement is turned to Cartesian with the remainder
of its own box; bounding it over the predicted set, as printed, lets the sets explode.
"""

from __future__ import annotations

from dataclasses import dataclass, replace
from typing import ClassVar, Final

import numpy as np

from fusion.compiled import kernel
from fusion.estimation import refusals
from fusion.estimation.error_box import half_width_in_room
from fusion.estimation.estimator import Estimator
from fusion.estimation.evidence import BELIEVED_HALF_WIDTH_M, DOUBTED_HALF_WIDTH_M
from fusion.estimation.freshness import LOST_AFTER_S, TOO_OLD_S, seconds_in_motion, states_of
from fusion.estimation.measurement import Flags, Measurement, Sight, read, sight
from fusion.estimation.motion_set import ACCELERATION_MAX, SPEED_MAX
from fusion.estimation.vectors import plus, row
from fusion.messages import AlignedSample, Floats, FusedFrame, Refusal
from fusion.skeleton import JOINT_COUNT

RESTART_AFTER_S: Final = 0.5
"""Refusals in a row for this long mean that the set is wrong, not the sensors."""
REASONS: Final = ("", "does not meet the set")
P, V = slice(0, 3), slice(3, 6)


@dataclass(frozen=True, slots=True)
class EsmfState:
    """E(centre, shape) of every joint at `t_s`."""

    t_s: float
    centre: Floats  # (J, 6) m and m/s; NaN for a joint never seen
    shape: Floats  # (J, 6, 6)
    seen_s: Floats  # (J,) time of the last measurement that was used
    refused_since_s: Floats  # (J,) when the present row of refusals began; +inf when there is none
    latest: refusals.Latest


class Esmf(Estimator):
    """The paper's ellipsoid: the point is its centre, the bound its longest half axis."""

    name: ClassVar[str] = "esmf"

    def __init__(self) -> None:
        never, none = np.full(JOINT_COUNT, -np.inf), np.full(JOINT_COUNT, np.inf)
        shape = np.broadcast_to(np.eye(6), (JOINT_COUNT, 6, 6))
        self._state = EsmfState(-np.inf, np.full((JOINT_COUNT, 6), np.nan), shape, never, none, ())

    def update(self, sample: AlignedSample) -> tuple[Refusal, ...]:
        """Predict to the sample, drop what does not meet its set, cut with the rest."""
        if sample.t_s < self._state.t_s - TOO_OLD_S:
            return ()
        self._state, refused = _take(self._state, sample)
        return refused

    def frame(self, t_s: float) -> FusedFrame:
        """The predicted ellipsoid; its centre is halted three frames after the last measurement (SR-4)."""
        state = predict(self._state, t_s)
        from_s = min(self._state.t_s, t_s) if np.isfinite(self._state.t_s) else t_s
        held_s = np.maximum(t_s - from_s - _in_motion(self._state.seen_s, float(from_s), float(t_s)), 0.0)
        beyond = state.centre[:, V] * held_s[:, None]  # what the set moves on alone
        beyond_m = np.linalg.norm(np.nan_to_num(beyond), axis=1)
        seen = np.isfinite(state.seen_s)
        longest_m = np.sqrt(np.linalg.eigvalsh(state.shape[:, P, P])[:, -1])
        bound_m = np.where(seen, longest_m + beyond_m, np.inf)
        ball = np.where(seen, bound_m, 0.0)[:, None, None] ** 2 * np.eye(3)
        shape_m2 = np.where((beyond_m > 0)[:, None, None], ball, state.shape[:, P, P])
        shape_m2 = np.where(seen[:, None, None], shape_m2, np.nan)
        recent = refusals.fresh(state.latest, t_s)
        return FusedFrame(
            t_s, state.centre[:, P] - beyond, shape_m2, bound_m, states_of(state.seen_s, float(t_s)), recent
        )

    def snapshot(self) -> object:
        """The filter's state."""
        return self._state

    def restore(self, snapshot: object) -> None:
        """Go back to an earlier state."""
        if not isinstance(snapshot, EsmfState):
            raise TypeError(f"a snapshot of {self.name} is an EsmfState, not {type(snapshot).__name__}")
        self._state = snapshot


def predict(state: EsmfState, t_s: float) -> EsmfState:
    """F E ⊕ Q: P/(1-b) + Q/b with b = √tr Q / (√tr P + √tr Q), Q what |a| <= 20 m/s² adds to p and v."""
    dt = t_s - state.t_s
    if not 0 < dt < np.inf:  # an older sample, or the very first
        return replace(state, t_s=max(t_s, state.t_s))
    step = np.eye(6)
    step[P, V] = dt * np.eye(3)
    added = 2 * ACCELERATION_MAX**2 * np.diag([dt**4 / 4] * 3 + [dt**2] * 3)  # doubled: it holds both balls at once
    moved = step @ state.shape @ step.T
    ratio = np.sqrt(np.trace(added) / np.einsum("jii->j", moved))[:, None, None]  # b / (1 - b)
    shape = moved * (1 + ratio) + added * (1 + 1 / ratio)
    return replace(state, t_s=t_s, centre=state.centre @ step.T, shape=shape)


def cut(state: EsmfState, positions: Floats, measured_m2: Floats, joints: Flags) -> tuple[EsmfState, Flags]:
    """Cut with the ellipsoids around `positions` (J, 3) of diagonal shape `measured_m2` (J, 3), where `joints` (J,).

    B = P/(1-ρ), W = (C B C' + R/ρ)⁻¹, K = B C' W, x + K d, δ = d' W d, (1-δ)(B - B C' W C B), with
    ρ = √r/(√p + √r), r and p the largest singular values of R and C P C'. Says which met, δ < 1; the others stay.
    """
    largest_p = np.linalg.eigvalsh(state.shape[:, P, P])[:, -1]
    largest_r = measured_m2.max(axis=1)
    rho = (np.sqrt(largest_r) / (np.sqrt(largest_p) + np.sqrt(largest_r)))[:, None, None]
    body = state.shape / (1 - rho)
    weight = np.linalg.inv(body[:, P, P] + measured_m2[:, :, None] * np.eye(3) / rho)
    gain = body[:, :, P] @ weight  # (J, 6, 3)
    innovation = positions - state.centre[:, P]
    delta = np.einsum("ji,jik,jk->j", innovation, weight, innovation)
    met = joints & (delta < 1)
    centre = state.centre + np.einsum("jik,jk->ji", gain, innovation)
    shape = (1 - delta)[:, None, None] * (body - gain @ body[:, P, :])
    shape = (shape + shape.swapaxes(1, 2)) / 2
    return _replaced(state, met, centre, shape), met


def _take(state: EsmfState, sample: AlignedSample) -> tuple[EsmfState, tuple[Refusal, ...]]:
    state = predict(state, sample.t_s)
    seen = sight(sample, JOINT_COUNT)
    measured = read(seen)
    late_s = max(state.t_s - sample.t_s, 0.0)
    speed = np.clip(np.nan_to_num(state.centre[:, V]), -SPEED_MAX, SPEED_MAX)
    positions = measured.positions + speed * late_s
    measured_m2 = _measured_m2(seen, measured, float(2 * SPEED_MAX * late_s))  # the joint may have gone the other way
    state, met = cut(state, positions, measured_m2, measured.given)
    since_s = np.where(measured.given, np.minimum(state.refused_since_s, state.t_s), state.refused_since_s)
    since_s = np.where(met, np.inf, since_s)
    lost = ~(state.t_s - state.seen_s < LOST_AFTER_S)
    begun = measured.given & ~met & (lost | (state.t_s - since_s >= RESTART_AFTER_S))
    state = _begun(state, positions, measured_m2, begun)
    codes = (measured.given & ~met & ~begun).astype(np.uint8)
    refused = refusals.refused(sample.sensor, codes, REASONS)
    latest = refusals.remember(state.latest, sample.sensor, sample.t_s, refused)
    return replace(state, refused_since_s=np.where(begun, np.inf, since_s), latest=latest), refused


@kernel
def _measured_m2(seen: Sight, measured: Measurement, wider_m: float) -> Floats:
    """(J, 3) m², the diagonal of the least ellipsoid around each measurement's box."""
    squares = np.empty_like(measured.positions)
    for j in range(len(squares)):
        box_m = BELIEVED_HALF_WIDTH_M if measured.tracked[j] else DOUBTED_HALF_WIDTH_M
        from_lens = plus(row(measured.positions, j), seen.lens_in_room, -1.0)
        half = half_width_in_room(from_lens, seen.rotation_sensor_to_room, box_m)
        for k in range(3):
            squares[j, k] = 3 * (half[k] + wider_m) ** 2
    return squares


@kernel
def _in_motion(seen_s: Floats, from_s: float, to_s: float) -> Floats:
    """(J,) `seconds_in_motion` of every joint."""
    seconds = np.empty_like(seen_s)
    for j in range(len(seconds)):
        seconds[j] = seconds_in_motion(seen_s[j], from_s, to_s)
    return seconds


def _begun(state: EsmfState, positions: Floats, measured_m2: Floats, which: Flags) -> EsmfState:
    """Start the joints in `which` from their box alone, at any speed within the bound."""
    if not which.any():
        return state
    squares = np.concatenate([2 * measured_m2, np.full((JOINT_COUNT, 3), 2 * SPEED_MAX**2)], axis=1)
    at_rest = np.concatenate([positions, np.zeros_like(positions)], axis=1)
    return _replaced(state, which, at_rest, squares[:, :, None] * np.eye(6))


def _replaced(state: EsmfState, which: Flags, centre: Floats, shape: Floats) -> EsmfState:
    return replace(
        state,
        centre=np.where(which[:, None], centre, state.centre),
        shape=np.where(which[:, None, None], shape, state.shape),
        seen_s=np.where(which, state.t_s, state.seen_s),
    )
