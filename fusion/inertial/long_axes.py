"""How segments lie in their sensors: from a pose in which the arm hangs, or from movement alone."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Final

import numpy as np
from numpy.typing import NDArray

from fusion.errors import InputError
from fusion.geometry import Floats
from fusion.inertial.joint_centres import shared_centre, still_centre
from fusion.inertial.orientation import Oriented
from fusion.inertial.pose import Pose

BEGINNING_S: Final = 2.0
MOST_LEFT_M_S2: Final = 0.5
"""What a fit may leave at a shoulder that keeps still."""
SEGMENT_M: Final = (0.12, 0.5)
"""Between the centres at both ends of an upper arm or a forearm."""


@dataclass(frozen=True, slots=True)
class LongAxes:
    """Unit vectors from distal to proximal, each in its sensor."""

    upper_arm: Floats  # (3,)
    forearm: Floats  # (3,)
    hand: Floats | None  # (3,); None: straight with the forearm, on average
    pose: Pose | None
    """When the arm hung, if that is where they come from."""

    def counted(self, t_s: Floats) -> NDArray[np.bool_]:
        """The samples (T,) in which a segment's twist is called zero: the pose, or all on average."""
        return np.ones(len(t_s), dtype=np.bool_) if self.pose is None else self.pose.at(t_s)

    def begin(self, t_s: Floats) -> NDArray[np.bool_]:
        """The samples (T,) in which the elbow's axis gives the arm's frame its direction."""
        return Pose(t_s[0], t_s[0] + BEGINNING_S).at(t_s) if self.pose is None else self.pose.at(t_s)


def from_pose(upper_arm: Oriented, forearm: Oriented, hand: Oriented, pose: Pose) -> LongAxes:
    """Where gravity ran while the arm hung."""
    return LongAxes(pose.up(upper_arm), pose.up(forearm), pose.up(hand), pose)


def from_movement(upper_arm: Oriented, forearm: Oriented, hand: Oriented) -> LongAxes:
    """Through the centres of shoulder, elbow and wrist, found from how the arm moved; no pose is needed.

    Raises:
        InputError: the shoulder moved, or the centres are not a segment apart.
    """
    shoulder, elbow, wrist = still_centre(upper_arm), shared_centre(upper_arm, forearm), shared_centre(forearm, hand)
    if shoulder.left_m_s2 > MOST_LEFT_M_S2:
        what = f"the shoulder of '{upper_arm.site}' moved (the fit leaves {shoulder.left_m_s2:.1f} m/s²)"
        raise InputError(what, "a trunk that keeps still while the arm moves", "calibrate from a pose")
    upper, fore = shoulder.in_child_m - elbow.in_parent_m, elbow.in_child_m - wrist.in_parent_m
    return LongAxes(_unit(upper, upper_arm.site), _unit(fore, forearm.site), None, None)


def _unit(between_m: Floats, site: str) -> Floats:
    length_m = float(np.linalg.norm(between_m))
    if not SEGMENT_M[0] <= length_m <= SEGMENT_M[1]:
        what = f"movement puts the ends of '{site}' {length_m:.2f} m apart"
        raise InputError(what, f"{SEGMENT_M[0]} to {SEGMENT_M[1]} m", "move every joint more, or use a pose")
    unit: Floats = between_m / length_m
    return unit
