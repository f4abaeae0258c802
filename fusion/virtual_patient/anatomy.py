"""How the virtual patient is built, and where all 25 joints are for a pose of the trunk and both arms."""

from __future__ import annotations

from dataclasses import dataclass, field
from enum import StrEnum
from typing import Final

import numpy as np

from fusion.kinematics.angles import arm_points_in_trunk
from fusion.messages import ArmLengths, Floats
from fusion.skeleton import INDEX, JOINT_COUNT, Side

UP: Final[Floats] = np.array([0.0, 1.0, 0.0])


class Posture(StrEnum):
    """How the patient keeps."""

    SITTING = "sitting"
    STANDING = "standing"


@dataclass(frozen=True, slots=True)
class ArmPose:
    """An arm's joint angles, as `server.messages.EXO_JOINTS` describes them."""

    plane_rad: float
    """Of the swing from the hanging arm: 0 = sideways, π/2 = ahead."""
    elevation_rad: float
    """Of the swing: 0 = hanging."""
    rotation_rad: float
    """Of the humerus after the swing; internal +."""
    elbow_rad: float
    """Flexion; 0 = straight."""

    def as_array(self) -> Floats:
        """(4,) rad."""
        return np.array([self.plane_rad, self.elevation_rad, self.rotation_rad, self.elbow_rad])


@dataclass(frozen=True, slots=True)
class Anatomy:
    """Lengths in metres; the defaults are an adult of about 1.75 m as a Kinect sees one."""

    shoulder_width_m: float = 0.36
    spine_m: float = 0.50
    """From the pelvis to the line of the shoulders."""
    hip_width_m: float = 0.18
    thigh_m: float = 0.42
    shank_m: float = 0.42
    foot_m: float = 0.14
    seat_m: float = 0.50
    """Height of the pelvis of somebody who sits."""
    arm: ArmLengths = field(default_factory=lambda: ArmLengths(upper_arm_m=0.29, forearm_m=0.25, hand_m=0.08))


LAP: Final = ArmPose(plane_rad=1.2, elevation_rad=0.35, rotation_rad=0.3, elbow_rad=1.25)
"""A hand that rests on the thigh."""
HANGING: Final = ArmPose(plane_rad=0.4, elevation_rad=0.12, rotation_rad=0.2, elbow_rad=0.25)
"""A relaxed arm beside the body."""


def resting(posture: Posture) -> ArmPose:
    """Where an arm is that does nothing."""
    return LAP if posture is Posture.SITTING else HANGING


def pelvis_height_m(anatomy: Anatomy, posture: Posture) -> float:
    """Height of SpineBase above the floor."""
    return anatomy.seat_m if posture is Posture.SITTING else anatomy.thigh_m + anatomy.shank_m + 0.08


def trunk_and_arms(anatomy: Anatomy, arms: dict[Side, ArmPose]) -> Floats:
    """Joints above the pelvis in the trunk frame (origin between the shoulders); NaN for the legs. (25, 3) m."""
    positions = np.full((JOINT_COUNT, 3), np.nan)
    for name, height_m in _SPINE.items():
        positions[INDEX[name]] = height_m * UP
    positions[INDEX["SpineBase"]] = -anatomy.spine_m * UP
    positions[INDEX["SpineMid"]] = -0.4 * anatomy.spine_m * UP
    for side, pose in arms.items():
        _place_arm(positions, anatomy, side, pose)
    return positions


_SPINE: Final = {"SpineShoulder": 0.03, "Neck": 0.09, "Head": 0.24}


def _place_arm(positions: Floats, anatomy: Anatomy, side: Side, pose: ArmPose) -> None:
    shoulder = np.array([_outward(side) * anatomy.shoulder_width_m / 2, 0.0, 0.0])
    angles = (pose.plane_rad, pose.elevation_rad, pose.rotation_rad, pose.elbow_rad)
    points = arm_points_in_trunk(*angles, anatomy.arm, side, shoulder)
    for name, point in zip(("Shoulder", "Elbow", "Wrist", "Hand"), points, strict=True):
        positions[INDEX[f"{name}{side.suffix}"]] = point
    along = (points[3] - points[2]) / anatomy.arm.hand_m
    positions[INDEX[f"HandTip{side.suffix}"]] = points[3] + 0.08 * along
    positions[INDEX[f"Thumb{side.suffix}"]] = points[3] + 0.03 * along + 0.04 * UP


def legs_from_pelvis(anatomy: Anatomy, posture: Posture) -> dict[int, Floats]:
    """Hips, knees, ankles and feet from SpineBase in the room's axes (x to the patient's right, y up, z back)."""
    sitting = posture is Posture.SITTING
    thigh = anatomy.thigh_m * (np.array([0.0, -0.05, -1.0]) if sitting else -UP)
    steps = (("Knee", thigh), ("Ankle", -anatomy.shank_m * UP), ("Foot", np.array([0.0, -0.06, -anatomy.foot_m])))
    places: dict[int, Floats] = {}
    for side in Side:
        point = np.array([_outward(side) * anatomy.hip_width_m / 2, -0.04, 0.0])
        places[INDEX[f"Hip{side.suffix}"]] = point
        for name, step in steps:
            point = point + step
            places[INDEX[f"{name}{side.suffix}"]] = point
    return places


def _outward(side: Side) -> float:
    return 1.0 if side is Side.RIGHT else -1.0
