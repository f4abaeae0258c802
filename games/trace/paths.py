"""Paths that the shown arm can follow with every joint inside its range, as long and as winding as asked."""

from __future__ import annotations

from math import log
from typing import Final

import numpy as np

from fusion.messages import Floats
from games.game import Point, Workspace
from games.trace.polyline import Polyline, evenly, polyline, rounded
from games.workspace import HIGHEST_M, IN_FRONT_M, LOWEST_M, MARGIN, distance_m, hand_at

STARTS: Final = 64
"""Poses drawn for the beginning, of which the one near the hand is taken."""
CANDIDATES: Final = 20
ROUGH, FINE = 1, 4
"""How often corners are cut: of a candidate, and of the path that is taken."""
ROUGH_SPACING_M, SPACING_M = 0.03, 0.015
"""How far apart the points of the two are."""
NEAR_M: Final = 0.08
"""A path begins about so far from the hand: near, and yet seen beside it."""
SPARE: Final = 1.2
"""Candidates are a little longer than asked, and cut to length."""
BEND_M: Final = 0.3
"""What a path costs that winds e times as much as asked, or as little."""
OUTSIDE: Final = 10.0
"""What it costs per metre to lead where the patient hardly sees it or where it tires."""
DEEP: Final = 0.5
"""What it costs per metre to lead to or from the trunk: there the arm hides the path from the eyes that lead it."""
TWIST_M_PER_RAD: Final = 0.02
"""What a turned humerus costs: people reach with the elbow hanging."""


def path(
    workspace: Workspace, length_m: float, winding: float, corners: int, hand: Point, rng: np.random.Generator
) -> Polyline:
    """Draw a path that begins near the hand.

    Corners are poses inside the joint ranges. Between them runs a curve in joint space that never leaves the hull of
    its corners, and the ranges are convex, so every pose on it is inside them too, and forward kinematics says where
    the hand then is: the whole path can be followed, by the exoskeleton and, in the mirror, by the healthy arm.

    Args:
        workspace: ranges and lengths.
        length_m: how long; shorter where the workspace is small.
        winding: its length over the straight way between its ends, 1 or more.
        corners: poses that shape it, with its beginning and end; at least 3.
        hand: where the hand is.
        rng: the game's own seeded generator.
    """
    begin = min(_poses(workspace, STARTS, rng), key=lambda pose: _start_cost(workspace, pose, hand))
    drawn = [_scaled(workspace, begin, _poses(workspace, corners - 1, rng), length_m) for _ in range(CANDIDATES)]
    best = min(drawn, key=lambda poses: _cost(workspace, poses, length_m, winding))
    return evenly(polyline(_hands(workspace, rounded(best, FINE))), length_m, SPACING_M)


def _poses(workspace: Workspace, number: int, rng: np.random.Generator) -> Floats:
    """(number, 4) joint angles, evenly inside the ranges less a margin."""
    ranges = np.array([workspace.plane_rad, workspace.elevation_rad, workspace.rotation_rad, workspace.elbow_rad])
    shares = rng.uniform(MARGIN, 1.0 - MARGIN, (number, 4))
    return np.asarray(ranges[:, 0] + shares * (ranges[:, 1] - ranges[:, 0]))


def _scaled(workspace: Workspace, begin: Floats, others: Floats, length_m: float) -> Floats:
    """(corners, 4) the corners, drawn towards the beginning where the path would be much too long."""
    steps = np.concatenate([np.zeros((1, 4)), others - begin])
    long_m = polyline(_hands(workspace, rounded(begin + steps, ROUGH))).length_m
    return np.asarray(begin + steps * min(1.0, SPARE * length_m / max(long_m, 1e-9)))


def _hands(workspace: Workspace, poses_rad: Floats) -> Floats:
    """(n, 3) where the hand is at each pose."""
    return np.array([hand_at(workspace, (p, e, r, f)) for p, e, r, f in poses_rad.tolist()])


def _start_cost(workspace: Workspace, pose_rad: Floats, hand: Point) -> float:
    place = _hands(workspace, pose_rad[None])
    x, y, z = place[0].tolist()
    return abs(distance_m((x, y, z), hand) - NEAR_M) + OUTSIDE * _outside_m(workspace, place)


def _cost(workspace: Workspace, poses_rad: Floats, length_m: float, winding: float) -> float:
    """How far a candidate is from what is wanted, in metres."""
    line = evenly(polyline(_hands(workspace, rounded(poses_rad, ROUGH))), length_m, ROUGH_SPACING_M)
    short_m = max(length_m - line.length_m, 0.0)
    bend_m = BEND_M * abs(log(line.winding / winding))
    twist_m = TWIST_M_PER_RAD * float(np.abs(poses_rad[:, 2]).max())
    deep_m = DEEP * float(np.abs(np.diff(line.points[:, 2])).sum())
    return short_m + bend_m + twist_m + deep_m + OUTSIDE * _outside_m(workspace, line.points)


def _outside_m(workspace: Workspace, hands: Floats) -> float:
    """How far the worst of (n, 3) places is behind, above or below where targets stand."""
    _, y, z = workspace.shoulder
    behind = hands[:, 2] - z + IN_FRONT_M
    above, below = hands[:, 1] - y - HIGHEST_M, y - LOWEST_M - hands[:, 1]
    return float(np.max(np.maximum(np.maximum(behind, 0.0), np.maximum(above, below))))
