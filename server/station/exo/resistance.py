"""When the drive must give way: the arm resists more than this patient's may be pushed (SR-18, SR-2).

Resistance is the torque by which the arm acts on a joint beyond its weight and inertia, against the joint's motion; on
a joint that stands still, either way. What the patient adds to a motion is no resistance until it is more than the
drive itself may use. A joint that the person moves too fast, where the drive yields, is given way to as well: it is
braked softly, by a person's leave only.
"""

from __future__ import annotations

from server.messages import JointLimits
from server.station.exo import measured
from server.station.exo.driver import Joints
from server.station.exo.evidence import SafetyInputs

RESISTED_S = 0.025
"""Resistance counts from the third tick in a row at 100 Hz: one outlier of a torque sensor is none."""
MOVING_RAD_S = 0.05
"""A set-point that is slower stands still."""


def strained(before_s: Joints, inputs: SafetyInputs, commanded_rad_s: Joints, elapsed_s: float) -> Joints:
    """For how long each joint has been resisting in a row, this tick included."""
    if not inputs.limits:
        return (0.0,) * len(before_s)
    return tuple(
        so_far + elapsed_s if _resists(nm, speed, joint) else 0.0
        for so_far, nm, speed, joint in zip(
            before_s, inputs.reading.interaction_nm, commanded_rad_s, inputs.limits, strict=True
        )
    )


def _resists(interaction_nm: float, commanded_rad_s: float, joint: JointLimits) -> bool:
    if abs(interaction_nm) > joint.torque_nm:
        return True
    with_it = abs(commanded_rad_s) > MOVING_RAD_S and interaction_nm * commanded_rad_s > 0
    return abs(interaction_nm) > joint.resistance_nm and not with_it


def give_way(strained_s: Joints, inputs: SafetyInputs, share: Joints) -> str:
    """Why the drive must give way now, naming the joint; "" = it need not."""
    held = "held softly" if inputs.device.can_comply else "held"
    for i, joint in enumerate(inputs.limits):
        if strained_s[i] > RESISTED_S:
            nm = inputs.reading.interaction_nm[i]
            return f"The {joint.joint} resists with {abs(nm):.1f} N m; the arm is {held}."
        if share[i] < 1.0 and abs(inputs.reading.velocity_rad_s[i]) > measured.top_speed_rad_s(joint):
            return f"The {joint.joint} moves faster than allowed; the arm is {held}."
    return ""
