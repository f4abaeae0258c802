"""Somebody else in the room of the virtual patient: walks past, stands beside, or reaches over; a therapist's build."""

from __future__ import annotations

from enum import StrEnum
from math import cos, pi, sin
from typing import Final

import numpy as np
from scipy.spatial.transform import Rotation

from fusion.messages import ArmLengths, Floats
from fusion.skeleton import Side
from fusion.virtual_patient.anatomy import Anatomy, ArmPose, Posture
from fusion.virtual_patient.patient import PoseGoal, VirtualPatient

SPEED_M_S: Final = 0.9
THERAPIST: Final = Anatomy(
    shoulder_width_m=0.42,
    spine_m=0.56,
    hip_width_m=0.20,
    thigh_m=0.47,
    shank_m=0.47,
    arm=ArmLengths(upper_arm_m=0.33, forearm_m=0.28, hand_m=0.09),
)
"""A tall adult."""
_REACHING: Final = PoseGoal(ArmPose(plane_rad=1.4, elevation_rad=1.2, rotation_rad=0.0, elbow_rad=0.3))
_WAY_M: Final = 1.6
"""Someone who walks past goes this far to either side of the patient."""


class Visit(StrEnum):
    """What the visitor does."""

    PASSES = "walks past before the patient, to and fro"
    STANDS = "stands beside the patient"
    REACHES = "stands beside the patient and reaches over"


class Bystander:
    """A visitor, stepped beside the patient.

    Args:
        visit: what they do.
        seed: of everything random.
    """

    def __init__(self, visit: Visit, seed: int) -> None:
        self._visit = visit
        self._body = VirtualPatient(Side.RIGHT, seed, posture=Posture.STANDING, anatomy=THERAPIST)

    def step(self, dt_s: float) -> Floats:
        """Live on for `dt_s`; (25, 3) m in the patient's world (`VirtualPatient`)."""
        goal = _REACHING if self._visit is Visit.REACHES else None
        positions = self._body.step(dt_s, goal)
        facing_rad, place = self._stands(self._body.t_s)
        turn = Rotation.from_euler("y", facing_rad)
        turned: Floats = turn.apply(positions) + place
        return turned

    def _stands(self, t_s: float) -> tuple[float, Floats]:
        """How far turned from the patient's own facing, and where."""
        if self._visit is Visit.STANDS:
            return 0.0, np.array([0.8, 0.0, 0.1])
        if self._visit is Visit.REACHES:  # at the patient's right, turned towards them
            return pi / 2, np.array([0.65, 0.0, -0.15])
        rate = SPEED_M_S / _WAY_M
        heading = -pi / 2 if cos(rate * t_s) > 0 else pi / 2
        return heading, np.array([_WAY_M * sin(rate * t_s), 0.0, -0.7])
