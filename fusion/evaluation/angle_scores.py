"""How far the healthy arm's angles are from the true ones, and how long their bounds would let a robot follow."""

from __future__ import annotations

from dataclasses import dataclass
from math import pi, radians
from typing import Final

import numpy as np

from fusion.kinematics.angles import arm_angles, wrapped
from fusion.kinematics.body_frame import trunk_frame
from fusion.messages import ArmLengths, Flags, Floats, FusedFrame, JointAngles
from fusion.recording.recording import Trouble
from fusion.skeleton import JOINT_COUNT, Side, TrackingState

SLOW_FROM_RAD: Final = 0.35
HOLD_FROM_RAD: Final = 0.7
"""A robot's joint slows down from the one bound and is held from the other (SR-4, docs/safety.md)."""
BENT_FROM_RAD: Final = radians(45.0)
"""The twist is asked for while the true elbow is bent further than this; a straight one does not tell it."""
SWING, ELBOW, TWIST = range(3)
ROWS: Final = {
    "swing": (SWING,),
    "elbow": (ELBOW,),
    "swing and elbow": (SWING, ELBOW),
    "twist, elbow bent": (TWIST,),
    "all asked for": (SWING, ELBOW, TWIST),
}
"""What is scored: each angle, and the worst of those that a robot would be following."""
_USUAL: Final = ArmLengths(0.29, 0.25, 0.08)  # needed for bounds only, of which the truth has none


@dataclass(frozen=True, slots=True)
class AngleErrors:
    """The three angles at every judged instant; N of them, angles in the order swing, elbow, twist."""

    error_rad: Floats  # (N, 3) NaN where no angle was told
    bound_rad: Floats  # (N, 3) as reported, π where no angle was told
    bent: Flags  # (N,) the true elbow tells the twist
    planted: Flags  # (N,) the recording knows of trouble here


@dataclass(frozen=True, slots=True)
class Engaged:
    """Shares of instants by what these thresholds would do; NaN where there was no such instant."""

    instants: int
    engaged: float
    """Not held: bound below `HOLD_FROM_RAD`. An instant without an angle is held."""
    full_speed: float
    """Bound below `SLOW_FROM_RAD`."""


@dataclass(frozen=True, slots=True)
class AngleScore:
    """Figures of an angle, or of the worst of several, in radians."""

    rms_rad: float
    p50_rad: float
    p95_rad: float
    max_rad: float
    inside_share: float
    """Share of the told instants at which every true angle is within its bound."""
    bound_p50_rad: float
    clear: Engaged
    """Outside the planted trouble."""
    planted: Engaged


def angle_errors(
    told: tuple[JointAngles | None, ...],
    truth: Floats,
    t_s: Floats,
    side: Side,
    events: tuple[Trouble, ...],
    instants: Flags,
) -> AngleErrors:
    """Compare told angles with those of the true joints, each in the trunk frame of its own joints.

    So what the told trunk is off counts as an error of the swing and of the twist.

    Args:
        told: (T,) the healthy arm's angles; None where nothing was told.
        truth: (T, 25, 3) m, NaN where unknown.
        t_s: (T,) on the truth's clock.
        side: the healthy one.
        events: where trouble was planted.
        instants: (T,) those that are judged; of them, the ones whose truth is known.
    """
    true = [true_angles(positions, side) if judged else None for positions, judged in zip(truth, instants, strict=True)]
    judged = [(k, a) for k, a in enumerate(true) if a is not None]
    rows = [_compared(told[k], a) for k, a in judged]
    at = np.array([k for k, _ in judged], dtype=np.int64)
    return AngleErrors(
        np.array([error for error, _ in rows]).reshape(-1, 3),
        np.array([bound for _, bound in rows]).reshape(-1, 3),
        np.array([a.elbow_flexion_rad > BENT_FROM_RAD for _, a in judged], dtype=np.bool_),
        _planted(t_s, events)[at],
    )


def true_angles(positions: Floats, side: Side) -> JointAngles | None:
    """The angles of true joints (25, 3) m; None where the arm or the trunk is not known."""
    trunk = trunk_frame(positions)
    if trunk is None:
        return None
    state = np.where(np.isfinite(positions).all(axis=1), TrackingState.TRACKED, TrackingState.LOST).astype(np.uint8)
    exact = FusedFrame(0.0, positions, np.zeros((JOINT_COUNT, 3, 3)), np.zeros(JOINT_COUNT), state)
    angles = arm_angles(exact, trunk, side, _USUAL)
    return angles if angles.valid else None


def _compared(told: JointAngles | None, true: JointAngles) -> tuple[tuple[float, ...], tuple[float, ...]]:
    """Errors and bounds in the order swing, elbow, twist."""
    if told is None or not told.valid:
        return (np.nan,) * 3, (pi,) * 3
    apart = np.linalg.norm(told.direction_in_limb - true.direction_in_limb)
    errors = (
        2.0 * np.arcsin(min(0.5 * float(apart), 1.0)),
        abs(told.elbow_flexion_rad - true.elbow_flexion_rad),
        abs(wrapped(told.twist_rad - true.twist_rad)),
    )
    return errors, (told.swing_bound_rad, told.elbow_bound_rad, told.twist_bound_rad)


def _planted(t_s: Floats, events: tuple[Trouble, ...]) -> Flags:
    inside = np.zeros(len(t_s), dtype=np.bool_)
    for event in events:
        inside |= (t_s >= event.from_s) & (t_s <= event.to_s)
    return inside


def score_angles(errors: AngleErrors) -> dict[str, AngleScore]:
    """Figures by the names of `ROWS`, in that order; a row is left out where nothing of it was told."""
    scores = {name: _worst(errors, list(angles)) for name, angles in ROWS.items()}
    return {name: found for name, found in scores.items() if found is not None}


def _worst(errors: AngleErrors, angles: list[int]) -> AngleScore | None:
    """Scores of the worst of some angles at the instants that ask for any of them."""
    asked = np.stack([np.ones_like(errors.bent), np.ones_like(errors.bent), errors.bent], axis=1)[:, angles]
    some = asked.any(axis=1)
    error = np.where(asked, errors.error_rad[:, angles], 0.0)[some]
    bound = np.where(asked, errors.bound_rad[:, angles], 0.0)[some]
    told = np.isfinite(error).all(axis=1)
    return _scored(error[told], bound[told], bound.max(axis=1), errors.planted[some]) if told.any() else None


def _scored(error: Floats, bound: Floats, robots: Floats, planted: Flags) -> AngleScore:
    """Figures of told errors and bounds (told, angles), and of the bounds (N,) that a robot would go by."""
    worst = error.max(axis=1)
    return AngleScore(
        rms_rad=float(np.sqrt(np.mean(worst**2))),
        p50_rad=float(np.median(worst)),
        p95_rad=float(np.percentile(worst, 95)),
        max_rad=float(np.max(worst)),
        inside_share=float(np.mean((error <= bound).all(axis=1))),
        bound_p50_rad=float(np.median(bound.max(axis=1))),
        clear=_engaged(robots[~planted]),
        planted=_engaged(robots[planted]),
    )


def _engaged(bound_rad: Floats) -> Engaged:
    count = len(bound_rad)
    if not count:
        return Engaged(0, np.nan, np.nan)
    return Engaged(count, float(np.mean(bound_rad < HOLD_FROM_RAD)), float(np.mean(bound_rad < SLOW_FROM_RAD)))


def joined_angles(parts: list[AngleErrors]) -> AngleErrors:
    """Several recordings as one."""
    return AngleErrors(
        np.concatenate([part.error_rad for part in parts]),
        np.concatenate([part.bound_rad for part in parts]),
        np.concatenate([part.bent for part in parts]),
        np.concatenate([part.planted for part in parts]),
    )
