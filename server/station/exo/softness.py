"""How softly each joint is held: the share of the drive's stiffness, and the torque it may use (SR-7, SR-18).

Whatever the share, the drive carries the arm's weight: soft is never limp. At the ends of the range every soft joint
meets a wall: through the soft margin the share rises to all of it, and the sooner the faster the joint comes. Another
stands at the velocity limit: who pushes a soft joint faster is braked.
"""

from __future__ import annotations

from typing import Final

from server.exoskeleton import Exoskeleton, Follows, StopCategory
from server.messages import EXO_JOINTS, JointLimits
from server.station.exo.driver import UNBOUND, Joints
from server.station.exo.evidence import Device, SafetyInputs
from server.station.exo.limiter import Box

SOFT_SHARE = 0.3
"""Of the stiffness, in a compliant hold."""
WALL_AHEAD_S = 0.1
"""The wall sees where the joint will be so much later: who comes fast must be braked before the margin."""
TOO_FAST = 0.25
"""Share of the velocity limit beyond it at which the wall is all there."""
SOFT_TORQUE = 0.5
"""Of the resistance that the patient's limits allow: a compliant hold pushes with less than what made it so. The faster
the joint moves, the more it may brake, up to all of it at the velocity limit: it gives way, but does not let go."""

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
    """0..1 per joint: how far through the soft margin, towards the end of the range, it is or soon will be, or how much
    it is too fast.
    """
    if not inputs.limits:
        return (0.0,) * len(inputs.reading.angle_rad)
    reading = inputs.reading
    return tuple(map(_joint_wall, reading.angle_rad, reading.velocity_rad_s, inputs.limits, inputs.boxes))


def _joint_wall(angle_rad: float, velocity_rad_s: float, joint: JointLimits, box: Box) -> float:
    soon_rad = angle_rad + WALL_AHEAD_S * velocity_rad_s
    beyond = max(box.low_rad - min(angle_rad, soon_rad), max(angle_rad, soon_rad) - box.high_rad, 0.0)
    too_fast = max(abs(velocity_rad_s) / joint.velocity_rad_s - 1.0, 0.0)
    return min(max(beyond / (joint.max_rad - box.high_rad), too_fast / TOO_FAST), 1.0)


def torque_nm(inputs: SafetyInputs, soft: tuple[bool, ...], walls: Joints) -> Joints:
    """The most that each joint may use beyond carrying the arm: less where it is soft, but for the wall."""
    if not inputs.limits:
        return UNBOUND
    return tuple(map(_joint_nm, inputs.limits, inputs.reading.velocity_rad_s, soft, walls))


def _joint_nm(joint: JointLimits, measured_rad_s: float, soft: bool, wall_share: float) -> float:
    gentle = min(SOFT_TORQUE * joint.resistance_nm, joint.torque_nm) if soft else joint.torque_nm
    firm = max(wall_share, min(abs(measured_rad_s) / joint.velocity_rad_s, 1.0))
    return gentle + firm * (joint.torque_nm - gentle)
