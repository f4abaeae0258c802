"""What the arm may do in a session: the patient's limits, inside the device's own (SR-1, SR-2, SR-18)."""

from __future__ import annotations

import msgspec

from db.limits import JointForce, JointRange, PatientLimits
from db.therapy_session import LimitsSnapshot
from fusion.errors import RefusedError
from server.messages import JointLimits


def session_limits(patient: PatientLimits, device: tuple[JointLimits, ...]) -> tuple[JointLimits, ...]:
    """The part of the passive range that the device has too, and the lesser torques; speeds are the device's.

    Raises:
        RefusedError: nothing is left of a joint's range.
    """
    return tuple(
        _narrowed(joint, getattr(patient.passive_range, joint.joint), getattr(patient.force_limits, joint.joint))
        for joint in device
    )


def _narrowed(device: JointLimits, passive: JointRange, force: JointForce) -> JointLimits:
    low, high = max(device.min_rad, passive.min_rad), min(device.max_rad, passive.max_rad)
    if low >= high:
        raise RefusedError(
            f"the device cannot move the {device.joint} anywhere inside the patient's passive range",
            "ranges that overlap",
            "correct the patient's passive range",
        )
    return msgspec.structs.replace(
        device,
        min_rad=low,
        max_rad=high,
        torque_nm=min(device.torque_nm, force.torque_nm),
        resistance_nm=min(device.resistance_nm, force.resistance_nm),
    )


def snapshots(limits: tuple[JointLimits, ...]) -> tuple[LimitsSnapshot, ...]:
    """The same limits in the database's and the REST interface's form."""
    return tuple(LimitsSnapshot(**msgspec.to_builtins(joint)) for joint in limits)
