"""How far a segment's direction, and the angles made of it, can be from the truth: bounds in radians.

The truth of each joint lies in a set (`FusedFrame`). A segment's true vector v then differs from the estimated one
by no more than both ends' sets together, and its length is known (learnt). The bounds follow from these two facts and
hold whatever the truth is inside its sets; `believed` shrinks the sets to the share that the segment's length, which
is watched all the time, was ever seen to use. Derivations: docs/angles.md.
"""

from __future__ import annotations

from dataclasses import dataclass
from math import acos, asin, cos, hypot, log, pi, sin, sqrt, tan
from typing import Final

import numpy as np

from fusion.messages import Floats, FusedFrame

LENGTH_TOLERANCE_M: Final = 0.02
"""How far a learnt length may be from the true one (Kinect bone lengths vary by about this much with the pose)."""
SAFETY: Final = 1.5
"""Errors across a segment are taken as at most this times those seen along it."""


@dataclass(frozen=True, slots=True)
class Spread:
    """Largest difference between a true vector joining two joints and the estimated one, per direction."""

    any_m: float
    """In whatever direction."""
    along_m: float
    """Along the estimated vector."""
    across_m: float
    """Perpendicular to it."""


def spread(frame: FusedFrame, start: int, end: int) -> Spread:
    """Both ends' sets added (Minkowski), measured along and across the line from joint `start` to joint `end`."""
    vector = frame.positions_in_room[end] - frame.positions_in_room[start]
    axis = vector / max(float(np.linalg.norm(vector)), 1e-9)
    reaches = [_reach(frame.shape_m2[i], float(frame.bound_m[i]), axis) for i in (start, end)]
    along, across = (sum(part) for part in zip(*reaches, strict=True))
    return Spread(any_m=float(frame.bound_m[start] + frame.bound_m[end]), along_m=along, across_m=across)


def _reach(shape_m2: Floats, bound_m: float, axis: Floats) -> tuple[float, float]:
    """Half-widths of one joint's set along `axis` and across it; the set lies in its ellipsoid and in its ball.

    Across: the larger eigenvalue of the shape projected on the plane, from that projection's trace and sum of squares.
    """
    if not np.isfinite(shape_m2).all():
        return bound_m, bound_m
    image = shape_m2 @ axis
    along = float(axis @ image)
    trace = float(shape_m2.trace()) - along
    squares = float((shape_m2 * shape_m2).sum()) - 2.0 * float(image @ image) + along**2
    across = 0.5 * (trace + _root(2.0 * squares - trace**2))
    return min(_root(along), bound_m), min(_root(across), bound_m)


def _root(square: float) -> float:
    return sqrt(max(square, 0.0))


def believed(spread: Spread, estimated_m: float, known_m: float, share: float) -> Spread:
    """The part of a spread that the segment is believed to use: the learnt share, or what its length shows just now.

    A length that is off by m shows an error of m along the segment; one as large is to be expected across it.
    """
    misfit_m = SAFETY * abs(estimated_m - known_m)
    used = min(1.0, max(share, misfit_m / max(spread.along_m, 1e-9)))
    return Spread(used * spread.any_m, used * spread.along_m, used * spread.across_m)


def direction_bound(estimated_m: float, known_m: float, spread: Spread) -> float:
    """Largest angle between a segment's true and estimated direction, the least of three bounds that each hold.

    With estimated length l, known length L ± δ and the angle θ sought: the ball gives
    cos θ ≥ (l² + L² − B²) / 2lL; the part across gives L sin θ ≤ r; the part along gives L cos θ ≥ l − a.

    Args:
        estimated_m: length l of the estimated vector.
        known_m: learnt length L of the segment.
        spread: B, a and r.

    Returns:
        Radians in [0, π]; π where nothing is known.
    """
    if not (estimated_m > 0 and np.isfinite([estimated_m, known_m, spread.any_m]).all()):
        return pi
    shortest, longest = max(known_m - LENGTH_TOLERANCE_M, 1e-3), known_m + LENGTH_TOLERANCE_M
    ball = spread.any_m + LENGTH_TOLERANCE_M
    least_along = estimated_m - spread.along_m
    by_ball = _acos((estimated_m**2 + known_m**2 - ball**2) / (2.0 * estimated_m * known_m))
    by_along = _acos(least_along / (longest if least_along > 0 else shortest))
    by_across = pi
    if spread.across_m < shortest and least_along > -sqrt(shortest**2 - spread.across_m**2):
        by_across = asin(spread.across_m / shortest)
    return min(by_ball, by_along, by_across)


def distance_m(frame: FusedFrame, start: int, end: int) -> float:
    """Estimated distance of two joints."""
    return float(np.linalg.norm(frame.positions_in_room[end] - frame.positions_in_room[start]))


def hinge_distance_m(flexion_rad: float, upper_m: float, forearm_m: float) -> float:
    """Distance of shoulder and wrist at a flexion."""
    return sqrt(max(upper_m**2 + forearm_m**2 + 2.0 * upper_m * forearm_m * cos(flexion_rad), 0.0))


def elbow_bound(flexion_rad: float, swing_rad: float, forearm_rad: float, hinge: float) -> float:
    """Largest error of the flexion: both directions' errors together, or what shoulder and wrist alone allow.

    Args:
        flexion_rad: estimated flexion.
        swing_rad: bound of the upper arm's direction.
        forearm_rad: bound of the forearm's direction.
        hinge: bound from the distance between shoulder and wrist (`hinge_bound`).
    """
    return min(swing_rad + forearm_rad, hinge, max(flexion_rad, pi - flexion_rad))


def hinge_bound(flexion_rad: float, upper_m: float, forearm_m: float, distance_m: float, spread: Spread) -> float:
    """Bound of the flexion from the distance D of shoulder and wrist: D² = a² + b² + 2ab cos γ, with D in an interval.

    It needs no elbow, so it holds when the elbow alone is badly seen.
    """
    longest = hypot(distance_m + spread.along_m, spread.across_m) + 2.0 * LENGTH_TOLERANCE_M
    shortest = max(distance_m - spread.along_m - 2.0 * LENGTH_TOLERANCE_M, 0.0)
    if not np.isfinite([longest, upper_m, forearm_m]).all():
        return pi
    least, most = (_flexion_at(d, upper_m, forearm_m) for d in (longest, shortest))
    return max(flexion_rad - least, most - flexion_rad)


def _flexion_at(distance_m: float, upper_m: float, forearm_m: float) -> float:
    return _acos((distance_m**2 - upper_m**2 - forearm_m**2) / (2.0 * upper_m * forearm_m))


def twist_bound(elevation_rad: float, flexion_rad: float, swing_rad: float, forearm_rad: float) -> float:
    """Largest error of the twist: how far the forearm can lie about the upper arm, and what the swing's error turns.

    Take the estimated arm's own direction over to the true one, a way of at most ε_d on the sphere. On that way the
    azimuth of the estimated forearm turns by at most ∫ cot(m − s) ds = ln(sin m / sin(m − ε_d)), m being the elbow's
    distance from straight or folded; the true forearm is within asin(sin ε_f / sin(m − ε_d)) of it; and the zero of the
    twist turns by at most ε_d tan((elevation + ε_d) / 2). Undefined (π) where the elbow may be straight or folded.
    """
    bend = min(flexion_rad, pi - flexion_rad) - swing_rad
    highest = elevation_rad + swing_rad
    if highest >= pi or bend <= forearm_rad:
        return pi
    carried = log(sin(bend + swing_rad) / sin(bend))
    return min(pi, carried + asin(sin(forearm_rad) / sin(bend)) + swing_rad * tan(0.5 * highest))


def _acos(cosine: float) -> float:
    return acos(min(1.0, max(-1.0, cosine)))
