"""The figures by which a fused joint is judged against the truth."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from fusion.errors import RecordingError
from fusion.messages import Floats
from fusion.recording.recording import TruthStream
from fusion.skeleton import INDEX, JOINT_COUNT, TrackingState

MM_PER_M = 1000.0


@dataclass(frozen=True, slots=True)
class Errors:
    """Every instant of every judged joint; N of them."""

    distance_m: Floats  # (N,) from the fused joint to the truth
    bound_m: Floats  # (N,) as reported
    lost: NDArray[np.bool_]  # (N,) state 0; scored all the same


@dataclass(frozen=True, slots=True)
class Score:
    """Figures over some instants; distances in millimetres."""

    instants: int
    rms_mm: float
    mean_mm: float
    std_mm: float
    p50_mm: float
    p95_mm: float
    max_mm: float
    inside_share: float
    """Share of instants at which the truth is no further off than the reported bound."""
    bound_p50_mm: float
    frames_lost: int
    """Instants with state 0."""


def score(errors: Errors) -> Score:
    """The figures of at least one instant."""
    mm = errors.distance_m * MM_PER_M
    return Score(
        instants=len(mm),
        rms_mm=float(np.sqrt(np.mean(mm**2))),
        mean_mm=float(np.mean(mm)),
        std_mm=float(np.std(mm)),
        p50_mm=float(np.median(mm)),
        p95_mm=float(np.percentile(mm, 95)),
        max_mm=float(np.max(mm)),
        inside_share=float(np.mean(errors.distance_m <= errors.bound_m)),
        bound_p50_mm=float(np.median(errors.bound_m)) * MM_PER_M,
        frames_lost=int(np.count_nonzero(errors.lost)),
    )


def joined(parts: list[Errors]) -> Errors:
    """Several joints or recordings as one."""
    return Errors(
        np.concatenate([part.distance_m for part in parts]),
        np.concatenate([part.bound_m for part in parts]),
        np.concatenate([part.lost for part in parts]),
    )


def errors_of(
    truth: Floats, positions: Floats, bound_m: Floats, state: NDArray[np.uint8], instants: NDArray[np.bool_]
) -> Errors:
    """Errors of one joint at those `instants` (T,) where it and its truth are known; both (T, 3) m."""
    known = instants & np.isfinite(truth).all(axis=1) & np.isfinite(positions).all(axis=1)
    distance_m = np.linalg.norm(positions[known] - truth[known], axis=1)
    return Errors(distance_m, bound_m[known], state[known] == TrackingState.LOST)


def truth_at(truth: TruthStream, t_s: Floats) -> Floats:
    """(T, 25, 3) m, the true joints at the given times, interpolated; NaN where there is no truth.

    Raises:
        RecordingError: the truth is of something else than a body's joints.
    """
    strangers = [name for name in truth.joints if name not in INDEX]
    if strangers:
        raise RecordingError(
            f"the truth is of '{strangers[0]}'", "joints of the body", "evaluate a recording of a body with truth"
        )
    at = np.full((len(t_s), JOINT_COUNT, 3), np.nan)
    for i, name in enumerate(truth.joints):
        known = np.isfinite(truth.positions[:, i]).all(axis=1)
        if known.any():
            at[:, INDEX[name]] = _interpolated(truth.t_s[known], truth.positions[known, i], t_s)
    return at


def _interpolated(known_s: Floats, positions: Floats, t_s: Floats) -> Floats:
    return np.stack([np.interp(t_s, known_s, axis, np.nan, np.nan) for axis in positions.T], axis=1)
