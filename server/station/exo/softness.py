"""How softly each joint is held: the share of the drive's stiffness, and the torque it may use (SR-7, SR-18).

Whatever the share, the drive carries the arm's weight: soft is never limp. At the ends of the range every soft joint
meets a wall: through the soft margin the share rises to all of it.
"""

from __future__ import annotations

from typing import Final

from server.exoskeleton import Exoskeleton, Follows, StopCategory
from server.messages import EXO_JOINTS, JointLimits
from server.station.exo.driver import UNBOUND, Joints
from server.station.exo.evidence import Device, SafetyInputs
from server.station.exo.limiter import Box

SOFT_SHARE = 0.1
"""Of the stiffness, in a compliant hold."""
SOFT_TORQUE = 0.5
"""Of the resistance that the patient's limits allow: a compliant hold pushes with less than what made it so."""

_MOVES: Final[dict[Follows, tuple[str, ...]]] = {
    **{Follows(angle): (angle,) for angle in EXO_JOINTS},
    Follows.AXIAL_ROTATION: ("rotation", "plane"),
    Follows.NONE: (),
}
"""The angles that a joint's torque acts on."""


def device_of(exoskeleton: Exoskeleton, can_comply: bool) -> Device:
    """What the gate must know of a device."""
    moved = [[joint for joint in exoskeleton.joints if angle in _MOVES[joint.follows]] for angle in EXO_JOINTS]
    return Device(
        can_comply,
        tuple(any(joint.stop is StopCategory.COMPLIANT for joint in joints) for joints in moved),
        tuple(sum(joint.torque_nm for joint in joints) for joints in moved),
    )


def wall(inputs: SafetyInputs) -> Joints:
    """0..1 per joint: how far the measured angle has gone through the soft margin towards the end of the range."""
    if not inputs.limits:
        return (0.0,) * len(inputs.reading.angle_rad)
    return tuple(map(_joint_wall, inputs.reading.angle_rad, inputs.limits, inputs.boxes))


def _joint_wall(angle_rad: float, joint: JointLimits, box: Box) -> float:
    beyond = max(box.low_rad - angle_rad, angle_rad - box.high_rad, 0.0)
    return min(beyond / (joint.max_rad - box.high_rad), 1.0)


def torque_nm(inputs: SafetyInputs, soft: tuple[bool, ...], walls: Joints) -> Joints:
    """The most that each joint may use beyond carrying the arm: less where it is soft, but for the wall."""
    if not inputs.limits:
        return UNBOUND
    return tuple(map(_joint_nm, inputs.limits, soft, walls))


def _joint_nm(joint: JointLimits, soft: bool, wall_share: float) -> float:
    gentle = min(SOFT_TORQUE * joint.resistance_nm, joint.torque_nm) if soft else joint.torque_nm
    return gentle + wall_share * (joint.torque_nm - gentle)
