"""What a patient's arm may do: the patient's limits inside the device's own, with the soft margin (SR-1)."""

from __future__ import annotations

from math import isfinite

from server.config import GateConfig
from server.messages import EXO_JOINTS, JointLimits
from server.station.exo.limiter import Box

LEAST_RANGE_RAD = 0.1
"""A joint's range below which there is nothing to move."""


def refused(limits: tuple[JointLimits, ...], device: tuple[JointLimits, ...]) -> str:
    """Why these limits cannot be used, as a sentence; "" = they can."""
    if tuple(joint.joint for joint in limits) != EXO_JOINTS:
        return f"Limits are needed for each of {', '.join(EXO_JOINTS)}, in this order."
    for own, outer in zip(limits, device, strict=True):
        reason = _joint_refused(own, outer)
        if reason:
            return f"The limits of '{own.joint}' {reason}."
    return ""


def _joint_refused(own: JointLimits, outer: JointLimits) -> str:
    positive = (own.velocity_rad_s, own.acceleration_rad_s2, own.torque_nm, own.resistance_nm)
    if not all(map(isfinite, (own.min_rad, own.max_rad, *positive))):
        return "are not all numbers"
    if min(positive) <= 0:
        return "need a velocity, an acceleration, a torque and a resistance above 0"
    if own.max_rad - own.min_rad < LEAST_RANGE_RAD:
        return f"leave less than {LEAST_RANGE_RAD} rad of movement"
    if min(own.max_rad, outer.max_rad) - max(own.min_rad, outer.min_rad) < LEAST_RANGE_RAD:
        return f"lie outside the device's own ({outer.min_rad:.2f} to {outer.max_rad:.2f} rad)"
    return ""


def inside_device(limits: tuple[JointLimits, ...], device: tuple[JointLimits, ...]) -> tuple[JointLimits, ...]:
    """The patient's limits, cut to the device's."""
    return tuple(
        JointLimits(
            joint=own.joint,
            min_rad=max(own.min_rad, outer.min_rad),
            max_rad=min(own.max_rad, outer.max_rad),
            velocity_rad_s=min(own.velocity_rad_s, outer.velocity_rad_s),
            acceleration_rad_s2=min(own.acceleration_rad_s2, outer.acceleration_rad_s2),
            torque_nm=min(own.torque_nm, outer.torque_nm),
            resistance_nm=min(own.resistance_nm, outer.torque_nm),
        )
        for own, outer in zip(limits, device, strict=True)
    )


def boxes(limits: tuple[JointLimits, ...], config: GateConfig) -> tuple[Box, ...]:
    """What the set-points may do: the range less the soft margin, of which a narrow range keeps half."""
    return tuple(_box(joint, config) for joint in limits)


def _box(joint: JointLimits, config: GateConfig) -> Box:
    margin = min(config.soft_margin_rad, (joint.max_rad - joint.min_rad) / 4)
    return Box(
        joint.min_rad + margin,
        joint.max_rad - margin,
        joint.velocity_rad_s,
        joint.acceleration_rad_s2,
        joint.acceleration_rad_s2 / config.jerk_time_s,
    )
