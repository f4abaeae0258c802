"""The exoskeleton file: what joints a device has, which anatomical angle each follows, and how it is reached.

joint = sign · angle + offset; a motor turns `gear_ratio` times as far. The safety gate works in the anatomical angles
of `EXO_JOINTS`; a drive turns them into its joints (`server.station.exo.joint_map`). docs/exoskeletons.md.
"""

from __future__ import annotations

from enum import StrEnum
from math import pi
from typing import Annotated, Literal

import msgspec
from msgspec import Meta

from server.messages import EXO_JOINTS, JointLimits

Positive = Annotated[float, Meta(gt=0)]
NodeId = Annotated[int, Meta(ge=0, le=127)]
FAMILIES = ("simulated", "cia402", "rosbridge")
"""Of drives: the names of `server.station.exo.drives`."""


class Follows(StrEnum):
    """The anatomical angle that a joint follows."""

    PLANE = "plane"
    ELEVATION = "elevation"
    ROTATION = "rotation"
    AXIAL_ROTATION = "axial_rotation"
    """Rotation less plane: the last axis of a shoulder that turns about Y, X, Y one after the other (ISB)."""
    ELBOW = "elbow"
    NONE = "none"
    """No sensor gives it; the joint is held at `rest_rad`."""


class StopCategory(StrEnum):
    """What a joint does when it is stopped (SR-7). In both it carries the arm's weight."""

    HOLD = "hold"
    COMPLIANT = "compliant"


class ExoskeletonJoint(msgspec.Struct, frozen=True, kw_only=True, forbid_unknown_fields=True):
    """One joint of the device; every angle is the joint's own."""

    name: str
    follows: Follows
    sign: Literal[1, -1]
    """1 where the joint's angle grows with the anatomical one."""
    offset_rad: float = 0.0
    """The joint's angle where the anatomical one is 0."""
    gear_ratio: Positive = 1.0
    """Turns of the motor for one of the joint."""
    rest_rad: float = 0.0
    """Where a joint that follows nothing is held."""
    min_rad: float
    max_rad: float
    velocity_rad_s: Positive
    acceleration_rad_s2: Positive
    torque_nm: Positive
    """The most that the joint may use."""
    stop: StopCategory = StopCategory.HOLD
    node: NodeId = 0
    """CANopen node; 0 = the joint is not on a bus."""
    counts_per_turn: Annotated[int, Meta(gt=0)] = 65_536
    """Of the motor's encoder."""


class Cia402Settings(msgspec.Struct, frozen=True, kw_only=True, forbid_unknown_fields=True):
    """How a CANopen bus is reached; the names are python-can's."""

    interface: str = ""
    channel: str = ""
    bitrate: Annotated[int, Meta(gt=0)] = 1_000_000
    heartbeat_s: Positive = 0.05
    """Both ways: a node that is silent for twice this time has failed, and a drive that hears no PC stops."""
    homing_method: Annotated[int, Meta(ge=-128, le=127)] = 35
    """Object 6098h; 35 = the present position is home, 0 = absolute encoders that need no homing."""
    options: dict[str, str | int | float | bool] = {}
    """Further words of the interface, such as host and port of "socketcand"."""
    period_s: Positive = 0.01
    """From one set-point to the next (60C2h): one tick of the station."""
    own_node: Annotated[int, Meta(ge=1, le=127)] = 127
    """The station's own number on the bus; its heartbeats carry it."""
    carry_nm: dict[str, float] = {}
    """Joint to the torque that carries device and heaviest arm in the worst pose. Without one, a joint never yields."""


class RosbridgeSettings(msgspec.Struct, frozen=True, kw_only=True, forbid_unknown_fields=True):
    """How a ROS 2 robot is reached through rosbridge."""

    url: str = ""
    """Such as "ws://127.0.0.1:9091"."""
    trajectory_topic: str = "/joint_trajectory_controller/joint_trajectory"
    state_topic: str = "/joint_states"
    lead_s: Annotated[float, Meta(ge=0.01, le=0.1)] = 0.02
    """Where a trajectory's first point lies; from there it brakes. What is later than this costs smoothness."""
    following_rad: Annotated[float, Meta(gt=0, le=1)] = 0.35
    """A joint that is further from where it is told to be, for 0.3 s, has failed."""


class Exoskeleton(msgspec.Struct, frozen=True, kw_only=True, forbid_unknown_fields=True):
    """A device."""

    name: str
    drive: str
    """One of `FAMILIES`."""
    joints: tuple[ExoskeletonJoint, ...]
    cia402: Cia402Settings = Cia402Settings()
    rosbridge: RosbridgeSettings = RosbridgeSettings()

    def joint_for(self, angle: Follows) -> ExoskeletonJoint | None:
        """The joint that follows an anatomical angle."""
        return next((joint for joint in self.joints if joint.follows is angle), None)


def device_limits(exoskeleton: Exoskeleton) -> tuple[JointLimits, ...]:
    """What the joints allow each angle of `EXO_JOINTS`, whatever the other angles are.

    Where a joint follows the axial rotation, the range and speed of the rotation are what is left of the joint's own
    at every plane: [min + greatest plane, max + least plane], and the speed less the plane's.
    """
    direct = {joint.follows: _own(joint) for joint in exoskeleton.joints}
    if Follows.AXIAL_ROTATION in direct:
        direct[Follows.ROTATION] = _rotation(direct[Follows.AXIAL_ROTATION], direct[Follows.PLANE])
    return tuple(direct[Follows(angle)] for angle in EXO_JOINTS)


def _own(joint: ExoskeletonJoint) -> JointLimits:
    ends = sorted(joint.sign * (end - joint.offset_rad) for end in (joint.min_rad, joint.max_rad))
    return JointLimits(
        joint=joint.follows.value,
        min_rad=ends[0],
        max_rad=ends[1],
        velocity_rad_s=joint.velocity_rad_s,
        acceleration_rad_s2=joint.acceleration_rad_s2,
        torque_nm=joint.torque_nm,
        resistance_nm=joint.torque_nm,
    )


def _rotation(axial: JointLimits, plane: JointLimits) -> JointLimits:
    return msgspec.structs.replace(
        axial,
        joint=Follows.ROTATION.value,
        min_rad=axial.min_rad + plane.max_rad,
        max_rad=axial.max_rad + plane.min_rad,
        velocity_rad_s=axial.velocity_rad_s - plane.velocity_rad_s,
        acceleration_rad_s2=axial.acceleration_rad_s2 - plane.acceleration_rad_s2,
    )


def _simulated(
    name: str, follows: Follows, ends: tuple[float, float], torque_nm: float, quickness: float = 1.0
) -> ExoskeletonJoint:
    return ExoskeletonJoint(
        name=name,
        follows=follows,
        sign=1,
        gear_ratio=100.0,
        min_rad=ends[0],
        max_rad=ends[1],
        velocity_rad_s=2.0 * quickness,
        acceleration_rad_s2=10.0 * quickness,
        torque_nm=torque_nm,
    )


BUILT_IN = Exoskeleton(
    name="simulated seven-joint arm",
    drive="simulated",
    joints=(
        _simulated("shoulder plane", Follows.PLANE, (-0.7, 2.3), 40.0),
        _simulated("shoulder elevation", Follows.ELEVATION, (-0.1, 2.6), 60.0),
        _simulated("upper arm rotation", Follows.AXIAL_ROTATION, (-3.9, 2.3), 15.0, quickness=2.0),
        _simulated("elbow", Follows.ELBOW, (-0.1, 2.6), 20.0),
        _simulated("forearm rotation", Follows.NONE, (-pi / 2, pi / 2), 8.0),
        _simulated("wrist flexion", Follows.NONE, (-1.2, 1.2), 6.0),
        _simulated("wrist deviation", Follows.NONE, (-0.5, 0.4), 6.0),
    ),
)
"""The device of the demonstration, and where no file is named."""
