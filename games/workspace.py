"""Where targets may stand: points that the shown arm reaches with every joint inside its range."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Final

import numpy as np

from fusion.kinematics.angles import arm_points_in_trunk
from fusion.messages import ArmLengths, Floats
from games.game import Point, Workspace

Pose = tuple[float, float, float, float]
"""plane, elevation, rotation and elbow in radians."""

MARGIN: Final = 0.1
"""Share of each joint's range kept free at both ends, so that no target asks for an end stop."""
CANDIDATES: Final = 48
IN_FRONT_M: Final = 0.25
"""Targets stand at least this far ahead of the shoulders, where the patient sees them."""
HIGHEST_M: Final = 0.15
"""Targets stand no higher than this above the shoulder: arms held overhead tire, and the eyes look ahead."""
LOWEST_M: Final = 0.3
"""Targets stand no lower than this below the shoulder: seen from the eyes, the sleeve would hide them in the lap."""
AWKWARD_M_PER_RAD: Final = 0.1
"""What a turned humerus costs. With little rotation the elbow hangs below the line to the hand, as people reach; a
target whose drawn pose is far from that would make them leave the ranges in which it was drawn."""
NEAREST_STEP_M, FARTHEST_STEP_M = 0.15, 0.40
"""Way from one target to the next at level 0 and level 1."""
CROWDED_M: Final = 0.15
"""Targets nearer than this to a recent one are avoided, so that they spread."""


@dataclass(frozen=True, slots=True)
class Reach:
    """A target's place and one pose of the arm that reaches it."""

    position: Point
    pose_rad: Pose


def hand_at(workspace: Workspace, pose_rad: Pose) -> Point:
    """The hand's centre in the trunk frame at a pose (forward kinematics)."""
    lengths = ArmLengths(workspace.upper_arm_m, workspace.forearm_m, 0.0)
    points = arm_points_in_trunk(*pose_rad, lengths, workspace.side, np.asarray(workspace.shoulder))
    return _point(points[-1])


def next_reach(
    workspace: Workspace, level: float, hand: Point, recent: tuple[Point, ...], rng: np.random.Generator
) -> Reach:
    """Draw the next target.

    Poses are drawn evenly inside the joint ranges (less a margin) and carried forward, so that every target is
    reachable by construction, by the exoskeleton and by the healthy arm in the mirror. Among the candidates the one is
    taken whose way from the hand suits the level and that stands clear of recent targets.

    Args:
        workspace: ranges and lengths.
        level: difficulty 0..1; higher means a longer way.
        hand: where the hand is now.
        recent: places of the last targets.
        rng: the game's own seeded generator.
    """
    reaches = reachable(workspace, CANDIDATES, rng)
    wanted_m = NEAREST_STEP_M + level * (FARTHEST_STEP_M - NEAREST_STEP_M)
    return min(reaches, key=lambda reach: _cost(reach, workspace, wanted_m, hand, recent))


def reachable(workspace: Workspace, count: int, rng: np.random.Generator) -> list[Reach]:
    """Places drawn by poses spread evenly over the joint ranges, less a margin at the ends."""
    return [_drawn(workspace, rng) for _ in range(count)]


def middle_pose(workspace: Workspace) -> Pose:
    """Every joint in the middle of its range."""
    return _pose(workspace, 0.5, 0.5, 0.5, 0.5)


def _drawn(workspace: Workspace, rng: np.random.Generator) -> Reach:
    plane, elevation, rotation, elbow = (float(share) for share in rng.uniform(MARGIN, 1.0 - MARGIN, 4))
    pose = _pose(workspace, plane, elevation, rotation, elbow)
    return Reach(hand_at(workspace, pose), pose)


def _pose(workspace: Workspace, plane: float, elevation: float, rotation: float, elbow: float) -> Pose:
    """The pose at these shares of the joint ranges."""
    return (
        _at(workspace.plane_rad, plane),
        _at(workspace.elevation_rad, elevation),
        _at(workspace.rotation_rad, rotation),
        _at(workspace.elbow_rad, elbow),
    )


def _at(ends: tuple[float, float], share: float) -> float:
    return ends[0] + share * (ends[1] - ends[0])


def _cost(reach: Reach, workspace: Workspace, wanted_m: float, hand: Point, recent: tuple[Point, ...]) -> float:
    """How far a candidate is from what is wanted, in metres; hidden, tiring or crowded costs more than a wrong way."""
    way_m = distance_m(reach.position, hand)
    behind_m = max(reach.position[2] - workspace.shoulder[2] + IN_FRONT_M, 0.0)
    above_m = max(reach.position[1] - workspace.shoulder[1] - HIGHEST_M, 0.0)
    below_m = max(workspace.shoulder[1] - LOWEST_M - reach.position[1], 0.0)
    crowding_m = sum(max(CROWDED_M - distance_m(reach.position, other), 0.0) for other in recent)
    too_near_m = max(NEAREST_STEP_M - way_m, 0.0)
    awkward_m = AWKWARD_M_PER_RAD * abs(reach.pose_rad[2])
    return (
        abs(way_m - wanted_m) + 10.0 * (behind_m + above_m + below_m) + 2.0 * crowding_m + 3.0 * too_near_m + awkward_m
    )


def distance_m(a: Point, b: Point) -> float:
    """Distance of two points; NaN where one is unknown."""
    return float(np.linalg.norm(np.subtract(a, b)))


def _point(vector: Floats) -> Point:
    x, y, z = (float(part) for part in vector)
    return x, y, z
