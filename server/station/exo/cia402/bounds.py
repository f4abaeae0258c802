"""The limits that a drive keeps by itself, from the device's joints and from the patient's range (SR-1, SR-2)."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from itertools import product

from fusion.errors import MachineError
from server.exoskeleton import Exoskeleton, ExoskeletonJoint, Follows
from server.messages import JointLimits
from server.station.exo.cia402 import objects
from server.station.exo.cia402.objects import Entry
from server.station.exo.cia402.sdo import Parameters, Place
from server.station.exo.cia402.units import Units
from server.station.exo.joint_map import JointMap

OUTSIDE_RAD = 0.02
"""A joint this little outside its limits is inside."""
AT_REST_RAD = 0.2
"""A joint that follows nothing may stand so far from its `rest_rad`; it is held where it stands."""


@dataclass(frozen=True, slots=True)
class Bounds:
    """What one joint may do, in its own angle."""

    min_rad: float
    max_rad: float
    velocity_rad_s: float
    acceleration_rad_s2: float


def device_bounds(joint: ExoskeletonJoint) -> Bounds:
    """The joint's own."""
    return Bounds(joint.min_rad, joint.max_rad, joint.velocity_rad_s, joint.acceleration_rad_s2)


def patient_bounds(exoskeleton: Exoskeleton, limits: tuple[JointLimits, ...]) -> tuple[Bounds, ...]:
    """A patient's limits (of `EXO_JOINTS`) as limits of the joints, inside the device's own.

    A joint that follows two angles (axial rotation = rotation - plane) gets what any pair of allowed angles can ask.
    """
    joint_map = JointMap(exoskeleton)
    corners = [joint_map.joints_rad(c) for c in product(*((limit.min_rad, limit.max_rad) for limit in limits))]
    speeds = _most(joint_map, [limit.velocity_rad_s for limit in limits])
    accelerations = _most(joint_map, [limit.acceleration_rad_s2 for limit in limits])
    return tuple(
        _inside(
            joint, min(corner[i] for corner in corners), max(corner[i] for corner in corners), speed, accelerations[i]
        )
        for i, (joint, speed) in enumerate(zip(exoskeleton.joints, speeds, strict=True))
    )


def _most(joint_map: JointMap, per_angle: list[float]) -> list[float]:
    ends = [abs(joint_map.joints_rad_s(c)) for c in product(*((-each, each) for each in per_angle))]
    return [float(most) for most in map(max, zip(*ends, strict=True))]


def _inside(joint: ExoskeletonJoint, low: float, high: float, speed: float, acceleration: float) -> Bounds:
    """A joint that follows nothing keeps the device's own: it is on its way to its rest, or there."""
    if low == high:
        return device_bounds(joint)
    return Bounds(
        max(float(low), joint.min_rad),
        min(float(high), joint.max_rad),
        min(speed, joint.velocity_rad_s),
        min(acceleration, joint.acceleration_rad_s2),
    )


def expect_inside(place: Place, angle_rad: float, bounds: Bounds, whose: str) -> None:
    """Refuse limits that a joint stands outside of: under power its drive would take it inside by itself.

    Raises:
        MachineError: names the joint, where it stands and the range.
    """
    if not bounds.min_rad - OUTSIDE_RAD <= angle_rad <= bounds.max_rad + OUTSIDE_RAD:
        raise MachineError(
            f"{place} stands at {angle_rad:.2f} rad, outside {whose}",
            f"{bounds.min_rad:.2f} to {bounds.max_rad:.2f} rad",
            "bring the device there with nobody in it, or check homing, sign and offset_rad",
        )


def expect_rest(place: Place, angle_rad: float) -> None:
    """Refuse a joint that follows nothing and stands elsewhere: nobody would ask for its way to its rest.

    Raises:
        MachineError: names the joint, where it stands and where it should.
    """
    joint = place.joint
    if joint.follows is Follows.NONE and abs(angle_rad - joint.rest_rad) > AT_REST_RAD:
        raise MachineError(
            f"{place} follows nothing and stands at {angle_rad:.2f} rad",
            f"within {AT_REST_RAD} rad of {place.key('rest_rad')} = {joint.rest_rad:g}",
            "bring it there with nobody in the device",
        )


def impose(node: Parameters, bounds: Bounds, units: Units, source: str = "") -> None:
    """Write the limits into the drive and read them back.

    Args:
        node: of the joint.
        bounds: what it may do.
        units: of the joint.
        source: where the limits come from; "" = the joint's table in the exoskeleton file.

    Raises:
        MachineError: the drive does not take one; names joint, node, key and what was expected.
    """
    for entry, value, name in _values(bounds, units):
        node.set(entry, value, source or node.place.key(name))


def impose_torque(node: Parameters, units: Units) -> None:
    """Write the joint's greatest torque into the drive and read it back; the motor's current with it, where it can.

    Raises:
        MachineError: the drive does not take it.
    """
    joint, key = node.place.joint, node.place.key("torque_nm")
    node.set(objects.MAX_TORQUE, units.per_mille(joint.torque_nm), key)
    if node.has(objects.MAX_CURRENT):
        node.set(objects.MAX_CURRENT, units.per_mille(joint.torque_nm), key)


def _values(bounds: Bounds, units: Units) -> Iterator[tuple[Entry, int, str]]:
    yield objects.MIN_POSITION, units.counts(bounds.min_rad), "min_rad"
    yield objects.MAX_POSITION, units.counts(bounds.max_rad), "max_rad"
    yield objects.MAX_PROFILE_VELOCITY, units.counts(bounds.velocity_rad_s), "velocity_rad_s"
    yield objects.MAX_MOTOR_SPEED, units.rpm(bounds.velocity_rad_s), "velocity_rad_s"
    yield objects.MAX_ACCELERATION, units.counts(bounds.acceleration_rad_s2), "acceleration_rad_s2"
