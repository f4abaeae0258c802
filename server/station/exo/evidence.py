"""What the gate knows of the target in one tick: free speed, losses, distance, blockers (SR-4, SR-6)."""

from __future__ import annotations

from dataclasses import dataclass
from math import isfinite, sin

from server.config import GateConfig
from server.messages import EXO_JOINTS, JointLimits
from server.station.exo.driver import JOINT_COUNT, UNBOUND, DriveReading, Joints
from server.station.exo.limiter import Box
from server.station.exo.mapping import JointTarget


@dataclass(frozen=True, slots=True)
class Device:
    """What the gate must know of the exoskeleton itself."""

    can_comply: bool = False
    """Whether its drive obeys a share below 1."""
    soft_stop: tuple[bool, ...] = (False,) * JOINT_COUNT
    """Per joint, whether its stop category is `compliant` (SR-7)."""
    torque_nm: Joints = UNBOUND
    """The most that each may use, weight and all."""


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
    authority: str = ""
    """Who is in charge and connected; "" = nobody (SR-11)."""
    device: Device = Device()


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
    return min(1.0, max(0.0, (none - value) / (none - full)))  # in this order 0 for what is not a number


def lost(target: JointTarget | None, age_s: float, free: Joints, config: GateConfig) -> str:
    """Why the healthy arm cannot be followed at all, in plain words; "" = it can (SR-4)."""
    if not age_s <= config.stale_s:
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


def far(target: JointTarget | None, inputs: SafetyInputs, free: Joints, config: GateConfig) -> tuple[str, ...]:
    """Where the target is too far for the arm to be led there, in plain words (SR-6)."""
    if target is None or not inputs.boxes:
        return ()
    apart = distance_rad(target, inputs, free)
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
