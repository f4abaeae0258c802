"""Where the demonstration's virtual patient reaches: what the game wants, or as far as it can when asked to show it."""

from __future__ import annotations

from typing import Final

from fusion.skeleton import Side
from server.api.course import Course
from server.messages import DemoGoal, DriveState, LiveTick, Point

SHOWN_FOR_S: Final = 2.5
"""How long each of the places is reached for."""
PLACES: Final = (
    (0.25, 0.0, 0.55),
    (0.05, 0.05, 0.2),
    (0.7, -0.1, 0.15),
    (-0.12, -0.1, 0.4),
    (0.5, -0.4, 0.25),
    (0.3, 0.25, 0.45),
    (0.55, -0.4, 0.0),
    (0.0, -0.3, 0.25),
)
"""Outward of the trunk's middle, up and ahead of the shoulders, in metres: ahead, mouth, aside, across, low, high.
Fixed, because a goal that changes with every tick is never reached for."""


def goal(course: Course | None, tick: LiveTick) -> DemoGoal:
    """Where the virtual patient's healthy hand should go, and where the exoskeleton holds the other."""
    sought = None if course is None else _sought(course, tick)
    return DemoGoal(
        hand_in_trunk=None if sought is None else (-sought[0], sought[1], sought[2]),
        healthy_side=tick.healthy_side if course is None else course.opening.affected_side.other,
        exo_rad=tick.exo.angle_rad,
    )


def _sought(course: Course, tick: LiveTick) -> Point | None:
    """What the healthy hand mirrors: the game's aim, or the held arm, near which a movement may begin; None = rest."""
    if course.picture is None:
        return _shown(course.opening.affected_side, tick.t_s) if course.is_asked_to_show else None
    if tick.state is not DriveState.ENGAGED:
        return tick.affected.points_in_trunk[-1]
    return course.picture.aim


def _shown(affected_side: Side, t_s: float) -> Point:
    outward, up, ahead = PLACES[int(t_s / SHOWN_FOR_S) % len(PLACES)]
    return (outward if affected_side is Side.RIGHT else -outward, up, -ahead)
