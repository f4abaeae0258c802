"""The reachable place nearest to one that was wished for: the arm's inverse kinematics inside its joint ranges."""

from __future__ import annotations

from math import cos, hypot, pi, sin, sqrt
from typing import Final

import numpy as np

from fusion.kinematics.angles import OUTWARD, swing_from_direction, twist_from_forearm
from fusion.kinematics.vectors import Vector, cross, dot, length, sum_of, unit
from games.game import Point, Workspace
from games.workspace import MARGIN, Pose, Reach, distance_m, hand_at

SWIVELS: Final = 16
"""Turns of the elbow about the line from shoulder to hand that are tried, from hanging to raised."""
HERE_M: Final = 0.002
"""A place this near is the one that was wished for."""
FIRST_SHARE, LAST_SHARE = 0.12, 0.004
"""Of a joint's range: the first and the last step of the search."""
Ranges = tuple[tuple[float, float], ...]


def nearest_reach(workspace: Workspace, wished: Point) -> Reach:
    """The place nearest to `wished` that the arm reaches with every joint inside its range, less `MARGIN`.

    Where the wished place itself is in reach, the arm hangs in the most natural of the elbow's turns that allow it.
    Where it is not, the best of those turns, cut to the ranges, is bettered joint by joint; what is found is reachable
    in any case, and no step of a single joint brings it nearer.

    Args:
        workspace: ranges and lengths.
        wished: m, trunk frame.
    """
    exact, best = _tried(workspace, wished)
    return best if exact else _bettered(workspace, wished, best)


def reaches(workspace: Workspace, wished: Point) -> bool:
    """Whether the hand gets to `wished` with every joint inside its range, less `MARGIN`."""
    return _tried(workspace, wished)[0]


def _tried(workspace: Workspace, wished: Point) -> tuple[bool, Reach]:
    """Whether one of the elbow's turns leads to the place, and the first that does, or the one that ends nearest."""
    ranges = _ranges(workspace)
    best: Reach | None = None
    for pose in _poses(workspace, wished, ranges):
        cut = _cut(pose, ranges)
        reach = Reach(hand_at(workspace, cut), cut)
        if distance_m(reach.position, wished) <= HERE_M:
            return True, reach
        if best is None or distance_m(reach.position, wished) < distance_m(best.position, wished):
            best = reach
    return False, best if best is not None else _middle(workspace, ranges)


def _poses(workspace: Workspace, wished: Point, ranges: Ranges) -> list[Pose]:
    """Poses whose hand is on the line from the shoulder to the place, as near to it as the elbow's range allows.

    With a, b the segments and f the flexion, the hand is at d² = a² + b² + 2ab cos f from the shoulder; the elbow lies
    on a circle about that line, at (a² − b² + d²) / 2d along it.
    """
    ahead = _to_limb(wished, workspace)
    far_m = length(ahead)
    if far_m == 0.0:
        return []
    a, b = workspace.upper_arm_m, workspace.forearm_m
    cosine = (far_m**2 - a**2 - b**2) / (2.0 * a * b)
    elbow = min(max(float(np.arccos(min(max(cosine, -1.0), 1.0))), ranges[3][0]), ranges[3][1])
    d = sqrt(max(a**2 + b**2 + 2.0 * a * b * cos(elbow), 1e-9))
    along_m = (a**2 - b**2 + d**2) / (2.0 * d)
    aside_m = sqrt(max(a**2 - along_m**2, 0.0))
    line = unit(ahead)
    return [_pose(line, d, along_m, aside_m, turn, elbow) for turn in _turns()]


def _turns() -> list[float]:
    """Angles from 0 to π on both sides, the smallest first."""
    steps = [pi * k / (SWIVELS // 2) for k in range(SWIVELS // 2 + 1)]
    return [0.0] + [sign * step for step in steps[1:] for sign in (1.0, -1.0)]


def _pose(line: Vector, d: float, along_m: float, aside_m: float, turn: float, elbow: float) -> Pose:
    """The pose with the elbow turned by `turn` from where it hangs, about the line (unit) from shoulder to hand."""
    down = _hanging(line)
    across = cross(line, down)
    to_elbow = sum_of(_times(line, along_m), _times(down, aside_m * cos(turn)), 1.0)
    to_elbow = sum_of(to_elbow, across, aside_m * sin(turn))
    upper = unit(to_elbow)
    forearm = unit(sum_of(_times(line, d), to_elbow, -1.0))
    plane, elevation = swing_from_direction(upper)
    return plane, elevation, twist_from_forearm(upper, forearm), elbow


def _hanging(line: Vector) -> Vector:
    """The direction across a line (unit) that points down most; backwards where the line itself is upright."""
    if hypot(line[0], line[2]) < 1e-6:
        return (0.0, 0.0, 1.0)
    return unit(sum_of((0.0, -1.0, 0.0), line, dot((0.0, 1.0, 0.0), line)))


def _bettered(workspace: Workspace, wished: Point, reach: Reach) -> Reach:
    """A pattern search: every joint a step up or down while that brings the hand nearer, then with half the step."""
    ranges = _ranges(workspace)
    share = FIRST_SHARE
    while share > LAST_SHARE:
        nearer = _neighbour(workspace, wished, reach, ranges, share)
        if nearer is None:
            share /= 2.0
        else:
            reach = nearer
    return reach


def _neighbour(workspace: Workspace, wished: Point, reach: Reach, ranges: Ranges, share: float) -> Reach | None:
    """The best pose one joint's step away, or None where none is nearer."""
    best, best_m = None, distance_m(reach.position, wished) - 1e-6
    for joint, (low, high) in enumerate(ranges):
        for step in (share, -share):
            moved = list(reach.pose_rad)
            moved[joint] += step * (high - low)
            pose = _cut((moved[0], moved[1], moved[2], moved[3]), ranges)
            place = hand_at(workspace, pose)
            if distance_m(place, wished) < best_m:
                best, best_m = Reach(place, pose), distance_m(place, wished)
    return best


def _ranges(workspace: Workspace) -> Ranges:
    """What targets may use of each joint's range."""
    whole = (workspace.plane_rad, workspace.elevation_rad, workspace.rotation_rad, workspace.elbow_rad)
    return tuple((low + MARGIN * (high - low), high - MARGIN * (high - low)) for low, high in whole)


def _cut(pose: Pose, ranges: Ranges) -> Pose:
    plane, elevation, rotation, elbow = (
        min(max(angle, low), high) for angle, (low, high) in zip(pose, ranges, strict=True)
    )
    return plane, elevation, rotation, elbow


def _middle(workspace: Workspace, ranges: Ranges) -> Reach:
    plane, elevation, rotation, elbow = ((low + high) / 2.0 for low, high in ranges)
    return Reach(hand_at(workspace, (plane, elevation, rotation, elbow)), (plane, elevation, rotation, elbow))


def _to_limb(place: Point, workspace: Workspace) -> Vector:
    """(outward, up, back) of a place, from the shoulder."""
    x, y, z = (float(p) - s for p, s in zip(place, workspace.shoulder, strict=True))
    return (OUTWARD[workspace.side] * x, y, z)


def _times(vector: Vector, factor: float) -> Vector:
    return (factor * vector[0], factor * vector[1], factor * vector[2])
