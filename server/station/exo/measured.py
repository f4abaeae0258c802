"""What is wrong with what the drive measures, in plain words: broken, old, outside its limits, astray (SR-1, SR-2)."""

from __future__ import annotations

from math import isfinite

from server.messages import EXO_JOINTS, JointLimits
from server.station.exo.driver import JOINT_COUNT, WATCHDOG_S, ZERO, DriveReading, Joints
from server.station.exo.evidence import SafetyInputs

OLD_S = WATCHDOG_S
"""A measurement further from now than this says nothing of where the arm is."""
FURTHEST_RAD = 10.0
JUMP_RAD, QUICKEST_RAD_S = 0.1, 15.0
"""No joint moves further than that between two measurements, even by hand."""
RANGE_TOLERANCE_RAD = 0.02
"""A led arm that is measured this far outside the patient's range is a fault."""
YIELDING_TOLERANCE_RAD = 0.05
"""The same where the drive yields: the person may lean on the soft wall at the end of the range."""
SPEED_TOLERANCE, SPEED_SLACK_RAD_S = 1.5, 0.3
"""Measured speed above this multiple of the limit, and so much more, is too fast."""
RUNAWAY = 2.0
"""... and a fault where the drive yields only beyond this multiple of that: a person may be quick."""
TORQUE_TOLERANCE = 1.1
"""Measured torque above this multiple of what the device may use is a fault."""
ASTRAY_RAD, ASTRAY_S = 0.2, 0.2
"""A stiffly led joint that is so far from its set-point for so long does not obey, or does not tell the truth."""


def sound(
    reading: DriveReading, expected_rad: Joints, seen_rad: Joints | None, now_s: float, elapsed_s: float
) -> DriveReading:
    """The reading; a fault at the expected angles instead of one that cannot be true (SR-2).

    Args:
        reading: what the drive says.
        expected_rad: the set-points.
        seen_rad: where the joints were measured last; None = nothing is known of it.
        now_s: the tick's time.
        elapsed_s: since the last tick.
    """
    reason = _unusable(reading, now_s) or _jumped(reading, seen_rad, elapsed_s)
    if not reason:
        return reading
    return DriveReading(reading.t_s, expected_rad, ZERO, ZERO, reading.fault or reason)


def _unusable(reading: DriveReading, now_s: float) -> str:
    parts = (reading.angle_rad, reading.velocity_rad_s, reading.torque_nm, reading.interaction_nm)
    if not all(len(part) == JOINT_COUNT and all(map(isfinite, part)) for part in parts):
        return "The drive's measurement is not usable (missing joints or not a number)."
    if not abs(now_s - reading.t_s) <= OLD_S:
        return "The drive's measurement is not of now: it has stopped measuring."
    if max(map(abs, reading.angle_rad)) > FURTHEST_RAD:
        return "The drive measured an angle that no arm can have."
    return ""


def _jumped(reading: DriveReading, seen_rad: Joints | None, elapsed_s: float) -> str:
    """A set-point may begin anew where the arm is measured, so a measurement that jumps must not be believed."""
    if seen_rad is None:
        return ""
    most_rad = JUMP_RAD + QUICKEST_RAD_S * elapsed_s
    for name, angle, before in zip(EXO_JOINTS, reading.angle_rad, seen_rad, strict=True):
        if abs(angle - before) > most_rad:
            return f"The {name}'s measurement jumped."
    return ""


def seen(reading: DriveReading, before_rad: Joints | None) -> Joints | None:
    """Where the joints were measured last, true or not; what is no measurement is passed over."""
    usable = len(reading.angle_rad) == JOINT_COUNT and all(map(isfinite, reading.angle_rad))
    return reading.angle_rad if usable else before_rad


def fault(inputs: SafetyInputs, astray_s: Joints, share: Joints) -> str:
    """What is wrong with a drive that moves or holds a patient's arm; "" = nothing.

    Args:
        inputs: the tick's.
        astray_s: `astray` so far.
        share: of the drive's stiffness, but for the walls; below 1 the person may move the joint too.
    """
    for i, joint in enumerate(inputs.limits):
        reason = _joint_fault(inputs, i, joint, yields=share[i] < 1.0) or _gone_astray(joint.joint, astray_s[i])
        if reason:
            return reason
    return ""


def _joint_fault(inputs: SafetyInputs, i: int, joint: JointLimits, *, yields: bool) -> str:
    reading = inputs.reading
    if _outside(reading.angle_rad[i], joint, YIELDING_TOLERANCE_RAD if yields else RANGE_TOLERANCE_RAD):
        return f"The {joint.joint} was measured outside the patient's range."
    if abs(reading.velocity_rad_s[i]) > (RUNAWAY if yields else 1.0) * top_speed_rad_s(joint):
        return f"The {joint.joint} was measured moving faster than allowed."
    if abs(reading.torque_nm[i]) > TORQUE_TOLERANCE * inputs.device.torque_nm[i]:
        return f"The {joint.joint} was measured using more torque than the device may."
    return ""


def _gone_astray(joint: str, astray_s: float) -> str:
    return f"The {joint} does not follow its command." if astray_s > ASTRAY_S else ""


def astray(before_s: Joints, inputs: SafetyInputs, commanded_rad: Joints, share: Joints, elapsed_s: float) -> Joints:
    """For how long each joint has been far from its set-point; only where the drive leads it stiffly."""
    return tuple(
        so_far + elapsed_s if stiff >= 1.0 and abs(angle - wanted) > ASTRAY_RAD else 0.0
        for so_far, angle, wanted, stiff in zip(before_s, inputs.reading.angle_rad, commanded_rad, share, strict=True)
    )


def outside_range(inputs: SafetyInputs) -> tuple[str, ...]:
    """Why an arm that waits must be moved by hand first, in plain words (SR-10)."""
    return tuple(
        f"The exoskeleton's {joint.joint} stands outside the patient's range; move it by hand."
        for i, joint in enumerate(inputs.limits)
        if _outside(inputs.reading.angle_rad[i], joint, RANGE_TOLERANCE_RAD)
    )


def _outside(angle_rad: float, joint: JointLimits, tolerance_rad: float) -> bool:
    return not joint.min_rad - tolerance_rad <= angle_rad <= joint.max_rad + tolerance_rad


def top_speed_rad_s(joint: JointLimits) -> float:
    """Above this, a measured speed is too fast."""
    return SPEED_TOLERANCE * joint.velocity_rad_s + SPEED_SLACK_RAD_S
