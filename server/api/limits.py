"""What the arm may do in a session: the range measured by hand, inside the device's own (SR-1, SR-18)."""

from __future__ import annotations

import msgspec

from db.patient import JointRange, PassiveRange
from db.therapy_session import LimitsSnapshot
from fusion.errors import RefusedError
from server.messages import JointLimits


def session_limits(passive: PassiveRange, device: tuple[JointLimits, ...]) -> tuple[JointLimits, ...]:
    """The part of the passive range that the device has too, joint by joint; speeds are the device's.

    Raises:
        RefusedError: nothing is left of a joint's range.
    """
    return tuple(_narrowed(joint, getattr(passive, joint.joint)) for joint in device)


def _narrowed(device: JointLimits, passive: JointRange) -> JointLimits:
    low, high = max(device.min_rad, passive.min_rad), min(device.max_rad, passive.max_rad)
    if low >= high:
        raise RefusedError(
            f"the device cannot move the {device.joint} anywhere inside the patient's passive range",
            "ranges that overlap",
            "correct the patient's passive range",
        )
    return msgspec.structs.replace(device, min_rad=low, max_rad=high)


def snapshots(limits: tuple[JointLimits, ...]) -> tuple[LimitsSnapshot, ...]:
    """The same limits in the database's and the REST interface's form."""
    return tuple(LimitsSnapshot(**msgspec.to_builtins(joint)) for joint in limits)
