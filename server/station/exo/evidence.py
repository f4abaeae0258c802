"""What the gate knows in one tick: free speed, faults, losses, distance, blockers (SR-2, SR-4, SR-6)."""

from __future__ import annotations

from dataclasses import dataclass
from math import isfinite, sin

from server.config import GateConfig
from server.messages import EXO_JOINTS, JointLimits
from server.station.exo.driver import JOINT_COUNT, ZERO, DriveReading, Joints
from server.station.exo.limiter import Box
from server.station.exo.mapping import JointTarget

RANGE_TOLERANCE_RAD = 0.02
"""Measured angles this far outside the patient's range are a fault."""
SPEED_TOLERANCE = 1.5
"""Measured speed above this multiple of the limit (and 0.3 rad/s more) is a fault."""


@dataclass(frozen=True, slots=True)
class SafetyInputs:
    """Everything the safety gate sees in one tick."""

    reading: DriveReading
    target: JointTarget | None
    evidence_age_s: float
    """Since the newest datagram that reached the target."""
    service_age_s: float
    """Since the service's last heartbeat."""
    limits: tuple[JointLimits, ...] = ()
    """The patient's, inside the device's; () = no session."""
    boxes: tuple[Box, ...] = ()
    interrupted: str = ""
    """Why the station itself must hold (the service has gone, too many ticks were late), in plain words."""
    blockers: tuple[str, ...] = ()
    """What the session lacks (SR-10)."""


def usable(target: JointTarget | None) -> JointTarget | None:
    """The target, unless anything in it is not a number or the wrong length (SR-2)."""
    if target is None:
        return None
    parts = (target.angle_rad, target.velocity_rad_s, target.bound_rad, target.freedom)
    if any(len(part) != JOINT_COUNT or not all(map(isfinite, part)) for part in parts):
        return None
    return target


def free_speed(target: JointTarget | None, age_s: float, config: GateConfig) -> Joints:
    """0..1 per joint: 1 while bound and age are small, 0 from where the joint is held (SR-4)."""
    if target is None:
        return (0.0,) * JOINT_COUNT
    fresh = _falling(age_s, config.slow_from_s, config.stale_s)
    return tuple(fresh * _falling(bound, config.slow_from_rad, config.hold_from_rad) for bound in target.bound_rad)


def _falling(value: float, full: float, none: float) -> float:
    return min(max((none - value) / (none - full), 0.0), 1.0)


def sound(reading: DriveReading, expected_rad: Joints) -> DriveReading:
    """The reading; in place of one with missing joints or what is no number, a fault at the expected angles (SR-2)."""
    parts = (reading.angle_rad, reading.velocity_rad_s, reading.torque_nm)
    if all(len(part) == JOINT_COUNT and all(map(isfinite, part)) for part in parts):
        return reading
    unusable = "The drive's measurement is not usable (missing joints or not a number)."
    return DriveReading(reading.t_s, expected_rad, ZERO, ZERO, reading.fault or unusable)


def fault(inputs: SafetyInputs, moving: bool) -> str:
    """What is wrong with drive or arm, in plain words; "" = nothing. Range and speed are judged while `moving`."""
    return inputs.reading.fault or (_excursion(inputs) if moving else "")


def _excursion(inputs: SafetyInputs) -> str:
    for i, joint in enumerate(inputs.limits):
        if _outside(inputs.reading.angle_rad[i], joint, RANGE_TOLERANCE_RAD):
            return f"The {joint.joint} was measured outside the patient's range."
        if abs(inputs.reading.velocity_rad_s[i]) > SPEED_TOLERANCE * joint.velocity_rad_s + 0.3:
            return f"The {joint.joint} was measured moving faster than allowed."
    return ""


def _outside(angle_rad: float, joint: JointLimits, tolerance_rad: float) -> bool:
    return not joint.min_rad - tolerance_rad <= angle_rad <= joint.max_rad + tolerance_rad


def lost(target: JointTarget | None, age_s: float, free: Joints, config: GateConfig) -> str:
    """Why the healthy arm cannot be followed at all, in plain words; "" = it can (SR-4)."""
    if age_s > config.stale_s:
        return "No sensor sees the patient now."
    if target is None:
        return "The healthy arm is not seen well enough to follow."
    return "" if any(free) else "The healthy arm's position is too uncertain."


def distance_rad(target: JointTarget, inputs: SafetyInputs, free: Joints) -> Joints:
    """How far each joint is from where it would be sent; 0 for joints that are held (SR-6).

    The plane counts by the sine of the elevation, as the hand does: near hanging it means little.
    """
    apart = [
        abs(min(max(goal, box.low_rad), box.high_rad) - angle) if speed else 0.0
        for goal, angle, box, speed in zip(target.angle_rad, inputs.reading.angle_rad, inputs.boxes, free, strict=True)
    ]
    raised = max(sin(min(abs(e), 1.57)) for e in (target.angle_rad[1], inputs.reading.angle_rad[1]))
    return (apart[0] * raised, *apart[1:])


def blockers(target: JointTarget | None, inputs: SafetyInputs, free: Joints, config: GateConfig) -> tuple[str, ...]:
    """What forbids motion to begin, besides loss and faults, in plain words (SR-6, SR-10)."""
    if inputs.blockers or not inputs.boxes:
        return inputs.blockers
    outside = tuple(
        f"The exoskeleton's {joint.joint} stands outside the patient's range; move it by hand."
        for angle, joint in zip(inputs.reading.angle_rad, inputs.limits, strict=True)
        if _outside(angle, joint, RANGE_TOLERANCE_RAD)
    )
    if outside or target is None:
        return outside
    return _far(distance_rad(target, inputs, free), config)


def _far(apart: Joints, config: GateConfig) -> tuple[str, ...]:
    worst = max(range(JOINT_COUNT), key=apart.__getitem__)
    if apart[worst] <= config.engage_within_rad:
        return ()
    return (
        f"The healthy arm is too far from where the exoskeleton holds the other "
        f"({EXO_JOINTS[worst]} by {apart[worst]:.1f} rad); bring it near.",
    )


def near(target: JointTarget | None, inputs: SafetyInputs, free: Joints, config: GateConfig) -> bool:
    """Whether the target is so near that a short loss may end by itself (SR-5)."""
    if target is None or not inputs.boxes:
        return False
    return max(distance_rad(target, inputs, free)) <= config.resume_within_rad
