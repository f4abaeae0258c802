"""Where a stroke of the paddles leads: from far ahead straight back, every pose of it inside the joint ranges."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Final

import numpy as np

from fusion.messages import Floats
from fusion.skeleton import Side
from games.game import Point, Workspace
from games.workspace import Pose, hand_at, reachable

CANDIDATES: Final = 400
BELOW_SHOULDER_M: Final = 0.1
"""Hands row about this far below the shoulder."""
OUTWARD_M: Final = 0.16
"""And this far beside the body's middle: two hands side by side never meet."""
NEAREST_M: Final = 0.24
"""A stroke ends at least this far ahead of the shoulder, where the eyes still see the hand."""
LEAST_OUTWARD_M: Final = 0.1
LOWEST_M: Final = 0.3
"""A stroke stays at most this far below the shoulder: over the water, and out of the lap."""
LONGEST_M: Final = 0.4
SHORT, ASKEW, OUT_OF_PLACE = 2.5, 0.4, 10.0
"""What a metre too short, a metre off the straight line, and a metre out of place cost."""


@dataclass(frozen=True, slots=True)
class Course:
    """Two poses and all between them: joint ranges are a box, so every pose between two inside is inside."""

    workspace: Workspace
    ahead_rad: Pose
    back_rad: Pose

    def ends(self, length: float) -> tuple[Point, Point]:
        """The ahead and the back end of a shorter stroke in its middle; `length` is its share of the whole, 0..1."""
        return self.at(0.5 - 0.5 * length), self.at(0.5 + 0.5 * length)

    def at(self, share: float) -> Point:
        """The hand's place at a share of the way from the pose ahead (0) to the pose at the back (1)."""
        pose = np.add(np.multiply(self.ahead_rad, 1.0 - share), np.multiply(self.back_rad, share))
        plane, elevation, rotation, elbow = pose.tolist()
        return hand_at(self.workspace, (plane, elevation, rotation, elbow))


def longest_course(workspace: Workspace, rng: np.random.Generator) -> Course:
    """The best course there is room for: long, level, straight ahead and at the height of the ribs.

    Poses are drawn evenly inside the joint ranges less a margin, and of all their pairs the best one is taken.

    Args:
        workspace: where the hand can go.
        rng: the game's own seeded generator.
    """
    reaches = reachable(workspace, CANDIDATES, rng)
    hands = np.array([reach.position for reach in reaches])  # (n, 3)
    off_m = _off_the_line(hands, workspace)
    costs_m = _lacking(hands) + off_m[:, None] + off_m
    ahead, back = np.unravel_index(int(np.argmin(costs_m)), costs_m.shape)
    return Course(workspace, reaches[ahead].pose_rad, reaches[back].pose_rad)


def _off_the_line(hands: Floats, workspace: Workspace) -> Floats:  # (n,)
    """How far each hand is from where rowing hands go, in metres; hands unseen or in each other's way cost most."""
    outwards_m = hands[:, 0] * (1.0 if workspace.side is Side.RIGHT else -1.0)
    _, shoulder_y, shoulder_z = workspace.shoulder
    beside_m = np.abs(outwards_m - OUTWARD_M)
    above_m = np.abs(hands[:, 1] - shoulder_y + BELOW_SHOULDER_M)
    hidden_m = np.maximum(hands[:, 2] - shoulder_z + NEAREST_M, 0.0)
    low_m = np.maximum(shoulder_y - LOWEST_M - hands[:, 1], 0.0)
    high_m = np.maximum(hands[:, 1] - shoulder_y, 0.0)
    meeting_m = np.maximum(LEAST_OUTWARD_M - outwards_m, 0.0)
    return np.asarray(ASKEW * (beside_m + above_m) + OUT_OF_PLACE * (hidden_m + low_m + high_m + meeting_m))


def _lacking(hands: Floats) -> Floats:  # (n, n)
    """What is wrong with the way from each hand's place (row) to each other's (column), in metres."""
    steps = hands[None] - hands[:, None]
    askew_m = np.linalg.norm(steps[..., :2], axis=2)
    return np.asarray(SHORT * np.abs(LONGEST_M - steps[..., 2]) + ASKEW * askew_m)
