"""The values that flow from a datagram to a mirror target; one direction, once per tick.

    Packet → SkeletonSample → AlignedSample → FusedFrame → JointAngles → MirrorTarget

All are immutable. Arrays inside are read-only by convention. Units: metres, radians, seconds.
"Room" is the frame of the reference sensor (Kinect v2 camera space: y up, z away from the sensor).
A joint that is missing has NaN positions and state 0. J = 25 (`fusion.skeleton.JOINTS`).
"""

from __future__ import annotations

from dataclasses import dataclass, field

import numpy as np
from numpy.typing import NDArray

from fusion.skeleton import Side

Floats = NDArray[np.float64]
States = NDArray[np.uint8]
Flags = NDArray[np.bool_]


@dataclass(frozen=True, slots=True)
class Packet:
    """A datagram as it came: which stream sent it, when it was received, and its bytes."""

    stream: str
    """Sender, "address" or "address/sensor"; sensors are told apart by it."""
    t_received_s: float
    """Monotonic receive time."""
    payload: bytes


@dataclass(frozen=True, slots=True)
class SkeletonSample:
    """One body seen by one sensor at one instant."""

    sensor: str
    body: str
    """The sensor's own number for the body; says nothing across sensors."""
    t_s: float
    """Sensor's own clock; equal to `t_received_s` where the sender gives no time."""
    t_received_s: float
    positions_in_sensor: Floats  # (J, 3) m
    state: States  # (J,) 0 lost, 1 inferred, 2 tracked


@dataclass(frozen=True, slots=True)
class AlignedSample:
    """A skeleton sample brought into the room's frame and the reference sensor's clock."""

    sensor: str
    t_s: float
    t_received_s: float
    positions_in_room: Floats  # (J, 3) m
    state: States  # (J,)
    lens_in_room: Floats  # (3,) where the sensor stands
    rotation_sensor_to_room: Floats  # (3, 3)


@dataclass(frozen=True, slots=True)
class SegmentSample:
    """How one body segment is turned, from an inertial sensor without magnetometer."""

    site: str
    """Where the sensor sits, as recordings name it: `upper-back`, `upper-arm-right`, …"""
    t_s: float
    """On the reference sensor's clock."""
    rotation_sensor_to_earth: Floats  # (3, 3), z of the earth up; its heading is the sensor's own and drifts slowly


@dataclass(frozen=True, slots=True)
class PositionSample:
    """Where a radio tag is, and the ranges that say so."""

    tag: str
    t_s: float
    """On the reference sensor's clock."""
    position_in_anchors: Floats  # (3,) m, z up
    anchors: Floats  # (A, 3) m, z up; A = 0 where the positioning system tells no ranges
    range_m: Floats  # (A,) the ranges behind the position, NaN where there is none


@dataclass(frozen=True, slots=True)
class Refusal:
    """A measurement that was not used, and why."""

    sensor: str
    joint: int
    reason: str


@dataclass(frozen=True, slots=True)
class FusedFrame:
    """The body at one instant, with the set that holds each joint."""

    t_s: float
    positions_in_room: Floats  # (J, 3) m
    shape_m2: Floats  # (J, 3, 3) m²: the set is (x-c)' shape^-1 (x-c) <= 1
    bound_m: Floats  # (J,) largest distance from the point to any point of its set
    state: States  # (J,) 2 seen within 50 ms, 1 held or predicted, 0 lost
    refusals: tuple[Refusal, ...] = ()


@dataclass(frozen=True, slots=True)
class TrunkFrame:
    """The patient's trunk: right-handed, x to the patient's right, y up the spine, z from chest to back."""

    origin_in_room: Floats  # (3,) mid-point of the shoulders
    rotation_trunk_to_room: Floats  # (3, 3), columns are the axes


@dataclass(frozen=True, slots=True)
class JointAngles:
    """One arm's angles: ISB (Wu 2005) for people, [Du2016 §1.3] α β γ beside, direction and twist for driving.

    `direction_in_limb` is the upper arm's unit vector as (outward, up, back): dot products with the trunk's
    axes, x reversed for a left arm, so that equal numbers on both sides are mirror images.
    """

    t_s: float
    side: Side
    plane_of_elevation_rad: float
    """0 = abduction, +π/2 = straight ahead."""
    elevation_rad: float
    """0 = hanging, π/2 = horizontal."""
    axial_rotation_rad: float
    """ISB Y-X-Y third angle; internal rotation positive."""
    elbow_flexion_rad: float
    """0 = straight."""
    alpha_rad: float
    beta_rad: float
    gamma_rad: float
    direction_in_limb: Floats  # (3,)
    twist_rad: float
    """Humerus rotation after the least swing from the hanging arm; 0 = bent forearm pointing ahead; internal +."""
    swing_bound_rad: float
    twist_bound_rad: float
    elbow_bound_rad: float
    valid: bool


@dataclass(frozen=True, slots=True)
class ArmLengths:
    """Segment lengths of an arm in metres."""

    upper_arm_m: float
    forearm_m: float
    hand_m: float


@dataclass(frozen=True, slots=True)
class MirrorTarget:
    """Where the affected arm should go: the healthy arm mirrored in the sagittal plane."""

    t_s: float
    side: Side
    """The affected side."""
    direction_in_limb: Floats  # (3,) (outward, up, back) unit vector of the upper arm
    twist_rad: float
    elbow_rad: float
    direction_velocity: Floats  # (3,) 1/s
    twist_rad_s: float
    elbow_rad_s: float
    swing_bound_rad: float
    twist_bound_rad: float
    elbow_bound_rad: float
    valid: bool


@dataclass(frozen=True, slots=True)
class SensorQuality:
    """What a therapist wants to know of one sensor."""

    sensor: str
    is_reference: bool
    frames_per_s: float
    latency_s: float
    """Median age of a frame when it is used, beyond the fastest seen."""
    joints_tracked: int
    clock_offset_s: float
    """t_reference = t_sensor - offset."""
    residual_m: float
    """Median distance to the reference sensor's joints after alignment; NaN until known."""
    aligned: bool
    last_seen_s: float
    refused_joints: int
    warnings: tuple[str, ...] = ()


@dataclass(frozen=True, slots=True)
class PipelineFrame:
    """Everything the pipeline says at one instant; parts are None until they can be known."""

    t_s: float
    sensors: tuple[SensorQuality, ...]
    samples: tuple[AlignedSample, ...]
    """The latest sample of every aligned sensor."""
    fused: FusedFrame | None = None
    trunk: TrunkFrame | None = None
    lengths: ArmLengths | None = None
    healthy: JointAngles | None = None
    target: MirrorTarget | None = None
    newest_received_s: float = float("nan")
    """Receive time of the newest sample that reached the body; NaN when none has yet."""
    warnings: tuple[str, ...] = field(default=())
