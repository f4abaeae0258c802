"""How far a segment's direction, and the angles made of it, can be from the truth: bounds in radians.

The truth of each joint lies in a set (`FusedFrame`). A segment's true vector v then differs from the estimated one
by no more than both ends' sets together, and its length is known (learnt). The bounds follow from these two facts and
hold whatever the truth is inside its sets. Derivations: docs/angles.md.
"""

from __future__ import annotations

from math import acos, asin, hypot, isfinite, log, pi, sin, sqrt, tan
from typing import Final, NamedTuple

from fusion.compiled import kernel
from fusion.kinematics.vectors import Triple, dot, length, step
from fusion.messages import Floats

UPPER_ARM_TOLERANCE_M: Final = 0.07
"""How far the learnt length of the upper arm may be from the true one. What sensors and skeletons call the shoulder
rides on the shoulder girdle: on the recordings with truth, raising the arm changes the true length by up to 64 mm."""
FOREARM_TOLERANCE_M: Final = 0.02
"""The forearm's true length stays within this of the learnt one there."""


class Segment(NamedTuple):
    """A segment as estimated and as known."""

    estimated_m: float
    known_m: float
    """Learnt length."""
    tolerance_m: float
    """How far that may be from the true one."""


class Spread(NamedTuple):
    """Largest difference between a true vector joining two joints and the estimated one, per direction."""

    any_m: float
    """In whatever direction."""
    along_m: float
    """Along the estimated vector."""
    across_m: float
    """Perpendicular to it."""


class ArmBounds(NamedTuple):
    """Of the three angles, in radians."""

    swing: float
    twist: float
    elbow: float


@kernel
def spread(positions: Floats, shape_m2: Floats, bound_m: Floats, start: int, end: int) -> Spread:
    """Both ends' sets added (Minkowski), measured along and across the line from joint `start` to joint `end`.

    Args:
        positions: (J, 3) m.
        shape_m2: (J, 3, 3) m², the joints' ellipsoids.
        bound_m: (J,) m, the joints' balls.
        start: joint.
        end: joint.
    """
    vector = step(positions, start, end, 1.0)
    size = max(length(vector), 1e-9)
    axis = (vector[0] / size, vector[1] / size, vector[2] / size)
    along_start, across_start = _reach(shape_m2[start], bound_m[start], axis)
    along_end, across_end = _reach(shape_m2[end], bound_m[end], axis)
    return Spread(bound_m[start] + bound_m[end], along_start + along_end, across_start + across_end)


@kernel
def _reach(shape_m2: Floats, bound_m: float, axis: Triple) -> tuple[float, float]:
    """Half-widths of one joint's set along `axis` and across it; the set lies in its ellipsoid and in its ball.

    Across: the larger eigenvalue of the shape projected on the plane, from that projection's trace and sum of squares.
    """
    image = (dot(shape_m2[0], axis), dot(shape_m2[1], axis), dot(shape_m2[2], axis))
    along = dot(axis, image)
    trace = shape_m2[0, 0] + shape_m2[1, 1] + shape_m2[2, 2] - along
    squares = (
        dot(shape_m2[0], shape_m2[0]) + dot(shape_m2[1], shape_m2[1]) + dot(shape_m2[2], shape_m2[2])
    ) - 2.0 * dot(image, image)
    across = 0.5 * (trace + _root(2.0 * (squares + along * along) - trace * trace))
    if not (isfinite(along) and isfinite(across)):
        return bound_m, bound_m
    return min(_root(along), bound_m), min(_root(across), bound_m)


@kernel
def _root(square: float) -> float:
    return sqrt(max(square, 0.0))


@kernel
def direction_bound(segment: Segment, spread: Spread) -> float:
    """Largest angle between a segment's true and estimated direction, the least of three bounds that each hold.

    With estimated length l, true length L within δ of the learnt one and the angle θ sought: the ball gives
    cos θ >= (l² + L² − B²) / 2lL, least at L = √(l² − B²) or at an end of L's interval; the part along gives
    L cos θ >= l − a; the part across gives L sin θ <= r, unless the true vector may point the other way.

    Args:
        segment: l, L and δ.
        spread: B, a and r.

    Returns:
        Radians in [0, π]; π where nothing is known.
    """
    estimated_m, known_m, tolerance_m = segment
    if not (estimated_m > 0.0 and isfinite(estimated_m) and isfinite(known_m) and isfinite(spread.any_m)):
        return pi
    shortest, longest = max(known_m - tolerance_m, 1e-3), known_m + tolerance_m
    least_along = estimated_m - spread.along_m
    by_along = _acos(least_along / (longest if least_along > 0.0 else shortest))
    by_across = pi
    if spread.across_m < shortest and least_along > -sqrt(shortest**2 - spread.across_m**2):
        by_across = asin(spread.across_m / shortest)
    return min(_by_ball(estimated_m, spread.any_m, shortest, longest), by_along, by_across)


@kernel
def _by_ball(estimated_m: float, radius_m: float, shortest: float, longest: float) -> float:
    """Cosine law at the length between `shortest` and `longest` that leaves the widest angle."""
    widest = min(max(_root(estimated_m**2 - radius_m**2), shortest), longest)
    return _acos((estimated_m**2 + widest**2 - radius_m**2) / (2.0 * estimated_m * widest))


@kernel
def elbow_bound(flexion_rad: float, swing_rad: float, forearm_rad: float, hinge: float) -> float:
    """Largest error of the flexion: both directions' errors together, or what shoulder and wrist alone allow.

    Args:
        flexion_rad: estimated flexion.
        swing_rad: bound of the upper arm's direction.
        forearm_rad: bound of the forearm's direction.
        hinge: bound from the distance between shoulder and wrist (`hinge_bound`).
    """
    return min(swing_rad + forearm_rad, hinge, max(flexion_rad, pi - flexion_rad))


@kernel
def hinge_bound(flexion_rad: float, upper: Segment, forearm: Segment, distance_m: float, ends: Spread) -> float:
    """Bound of the flexion from the distance D of shoulder and wrist: D² = a² + b² + 2ab cos γ, with D in an interval.

    It needs no elbow, so it holds when the elbow alone is badly seen. A length that is off by δ moves D by no more.
    """
    slack_m = upper.tolerance_m + forearm.tolerance_m
    longest = hypot(distance_m + ends.along_m, ends.across_m) + slack_m
    shortest = max(distance_m - ends.along_m - slack_m, 0.0)
    if not (isfinite(longest) and isfinite(upper.known_m) and isfinite(forearm.known_m)):
        return pi
    least = _flexion_at(longest, upper.known_m, forearm.known_m)
    most = _flexion_at(shortest, upper.known_m, forearm.known_m)
    return max(flexion_rad - least, most - flexion_rad)


@kernel
def _flexion_at(distance_m: float, upper_m: float, forearm_m: float) -> float:
    return _acos((distance_m**2 - upper_m**2 - forearm_m**2) / (2.0 * upper_m * forearm_m))


@kernel
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


@kernel
def arm_bounds(
    elevation_rad: float,
    flexion_rad: float,
    segments: tuple[Segment, Segment],
    spreads: tuple[Spread, Spread, Spread],
    distance_m: float,
) -> ArmBounds:
    """Bounds of an arm's angles from its joints' sets.

    Args:
        elevation_rad: of the upper arm, 0 = hanging.
        flexion_rad: of the elbow.
        segments: upper arm and forearm.
        spreads: of the upper arm, of the forearm, and from shoulder to wrist.
        distance_m: from shoulder to wrist.
    """
    swing = direction_bound(segments[0], spreads[0])
    forearm = direction_bound(segments[1], spreads[1])
    hinge = hinge_bound(flexion_rad, segments[0], segments[1], distance_m, spreads[2])
    twist = twist_bound(elevation_rad, flexion_rad, swing, forearm)
    return ArmBounds(swing, twist, elbow_bound(flexion_rad, swing, forearm, hinge))


@kernel
def _acos(cosine: float) -> float:
    return acos(min(1.0, max(-1.0, cosine)))
