"""The arm as a chain of shoulder (3), elbow (2) and wrist (2 degrees of freedom): a product of exponentials.

Home is the hanging arm in the arm's frame: x to the patient's right, y up, z to the back, the shoulder at the origin.
Whatever the angles, the segments keep their lengths: the constraints hold by construction [Liu2017 §1–2].
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from fusion.geometry import Floats
from fusion.inertial.lie import exp_se3, moved, revolute_twist
from fusion.messages import ArmLengths

X, Y, Z = np.eye(3)
CHAIN_JOINTS = ("shoulder", "elbow", "wrist", "hand")


@dataclass(frozen=True, slots=True)
class ArmAngles:
    """The seven angles of the chain; all zero is the hanging arm."""

    shoulder_rotvec_rad: Floats  # (T, 3) axis λ times angle θ = 2 acos q0 [Liu2017 eqs. 3–4]
    elbow_flexion_rad: Floats  # (T,) about x
    pronation_rad: Floats  # (T,) about y
    wrist_flexion_rad: Floats  # (T,) about x
    wrist_deviation_rad: Floats  # (T,) about z


def home(lengths: ArmLengths) -> Floats:
    """Where shoulder, elbow, wrist and hand are while the arm hangs, (4, 3) m."""
    down = np.cumsum([0.0, lengths.upper_arm_m, lengths.forearm_m, lengths.hand_m])
    return -down[:, None] * Y


def segment_motions(angles: ArmAngles, lengths: ArmLengths) -> tuple[Floats, Floats, Floats]:
    """How upper arm, forearm and hand have moved since home: ``exp(ξ1 θ1) … exp(ξk θk)``, three times (T, 4, 4)."""
    shoulder, elbow, wrist, _ = home(lengths)
    rotvec = angles.shoulder_rotvec_rad
    upper = exp_se3(revolute_twist(rotvec, np.broadcast_to(shoulder, rotvec.shape)))
    forearm = upper @ _turn(X, elbow, angles.elbow_flexion_rad) @ _turn(Y, elbow, angles.pronation_rad)
    hand = forearm @ _turn(X, wrist, angles.wrist_flexion_rad) @ _turn(Z, wrist, angles.wrist_deviation_rad)
    return upper, forearm, hand


def joint_positions(angles: ArmAngles, lengths: ArmLengths) -> Floats:
    """Shoulder, elbow, wrist and hand, (T, 4, 3) m in the arm's frame."""
    shoulder, elbow, wrist, hand = home(lengths)
    upper_motion, forearm_motion, hand_motion = segment_motions(angles, lengths)
    places = [
        moved(upper_motion, shoulder),
        moved(upper_motion, elbow),
        moved(forearm_motion, wrist),
        moved(hand_motion, hand),
    ]
    return np.stack(places, axis=1)


def _turn(axis: Floats, centre_m: Floats, angle_rad: Floats) -> Floats:
    return exp_se3(angle_rad[:, None] * revolute_twist(axis, centre_m))
