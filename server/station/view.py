"""What one tick shows to people: the pipeline's frame, the gate and the drive as a `LiveTick`."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from math import isfinite

import numpy as np

from fusion.align.bodies import Verdict
from fusion.align.identity import BodyInView
from fusion.kinematics.angles import arm_points_in_trunk, swing_from_direction
from fusion.messages import (
    AlignedSample,
    ArmLengths,
    Floats,
    FusedFrame,
    JointAngles,
    MirrorTarget,
    PipelineFrame,
    SensorQuality,
    TrunkFrame,
)
from fusion.skeleton import Side, arm
from server.messages import ArmView, BodyView, DriveState, ExoView, PersonView, Point, SensorView
from server.station.exo.driver import DriveCommand, DriveReading, Joints
from server.station.exo.safety_state import SafetyState

USUAL_LENGTHS = ArmLengths(upper_arm_m=0.29, forearm_m=0.25, hand_m=0.08)
"""An adult's, until the patient's own are learnt."""
USUAL_HALF_WIDTH_M = 0.18
STANDING = (DriveState.HOLD, DriveState.STOPPED, DriveState.FAULT)
_UPPER_TRIANGLE = np.triu_indices(3)  # xx, xy, xz, yy, yz, zz

Points = tuple[Point, Point, Point, Point]


@dataclass(frozen=True, slots=True)
class Build:
    """The patient's build as far as it has been learnt; it changes slowly, so that the shown arm does not shake."""

    lengths: ArmLengths = USUAL_LENGTHS
    half_width_m: float = USUAL_HALF_WIDTH_M
    """Half the distance between the shoulders."""

    def learnt(self, frame: PipelineFrame, share: float) -> Build:
        """The build after another frame, which counts for `share`."""
        if frame.fused is None:
            return self
        left, right = (frame.fused.positions_in_room[arm(side)[0]] for side in Side)
        half_m = float(np.linalg.norm(right - left)) / 2
        if not 0.1 < half_m < 0.3:
            return Build(frame.lengths or self.lengths, self.half_width_m)
        return Build(frame.lengths or self.lengths, self.half_width_m + share * (half_m - self.half_width_m))

    def shoulder_in_trunk(self, side: Side) -> Floats:
        """(3,) m; the trunk's origin lies between the shoulders."""
        return np.array([self.half_width_m if side is Side.RIGHT else -self.half_width_m, 0.0, 0.0])


def sensor_view(
    quality: SensorQuality, sample: AlignedSample | None, dialect_of: Callable[[str], str], now_s: float
) -> SensorView:
    """One sensor."""
    return SensorView(
        sensor=quality.sensor,
        dialect=dialect_of(quality.sensor),
        is_reference=quality.is_reference,
        frames_per_s=_number(quality.frames_per_s),
        latency_s=_number(quality.latency_s),
        joints_tracked=quality.joints_tracked,
        clock_offset_s=_number(quality.clock_offset_s),
        residual_m=quality.residual_m if isfinite(quality.residual_m) else None,
        aligned=quality.aligned,
        age_s=_number(now_s - quality.last_seen_s),
        refused_joints=quality.refused_joints,
        warnings=quality.warnings,
        position_in_room=_point(sample.lens_in_room.tolist()) if sample else None,
        joints_in_room=_points(sample.positions_in_room) if sample else (),
    )


def person_view(seen: BodyInView) -> PersonView | None:
    """A body in view; None where it has no place."""
    in_sensor = _point(seen.centre_in_sensor.tolist())
    if in_sensor is None:
        return None
    return PersonView(
        sensor=seen.sensor,
        body=seen.body,
        place_in_sensor=in_sensor,
        place_in_room=None if seen.centre_in_room is None else _point(seen.centre_in_room.tolist()),
        is_patient=seen.verdict is Verdict.PATIENT,
        confirmed=seen.confirmed,
        reason=seen.verdict.value,
    )


def body_view(fused: FusedFrame | None) -> BodyView | None:
    """The fused body."""
    if fused is None:
        return None
    known = np.nan_to_num(fused.shape_m2[:, _UPPER_TRIANGLE[0], _UPPER_TRIANGLE[1]], nan=0.0, posinf=0.0, neginf=0.0)
    return BodyView(
        joints_in_room=_points(fused.positions_in_room),
        bound_m=tuple(np.nan_to_num(fused.bound_m, nan=0.0, posinf=0.0).tolist()),
        shape_m2=tuple(map(tuple, known.tolist())),
        state=tuple(fused.state.tolist()),
    )


def healthy_view(angles: JointAngles | None, frame: PipelineFrame) -> ArmView | None:
    """The healthy arm as it is seen."""
    if angles is None or not angles.valid or frame.fused is None or frame.trunk is None:
        return None
    plane, elevation = swing_from_direction(angles.direction_in_limb)
    in_room = frame.fused.positions_in_room[list(arm(angles.side))]
    in_trunk = (in_room - frame.trunk.origin_in_room) @ frame.trunk.rotation_trunk_to_room
    if not np.isfinite(in_room).all():
        return None
    return ArmView(
        plane_rad=plane,
        elevation_rad=elevation,
        rotation_rad=angles.twist_rad,
        elbow_rad=angles.elbow_flexion_rad,
        plane_of_elevation_rad=angles.plane_of_elevation_rad,
        axial_rotation_rad=angles.axial_rotation_rad,
        alpha_rad=angles.alpha_rad,
        beta_rad=angles.beta_rad,
        gamma_rad=angles.gamma_rad,
        valid=True,
        points_in_trunk=_four(in_trunk),
        points_in_room=_four(in_room),
    )


def target_view(target: MirrorTarget | None, build: Build, trunk: TrunkFrame | None) -> ArmView | None:
    """The mirrored arm."""
    if target is None or not target.valid:
        return None
    plane, elevation = swing_from_direction(target.direction_in_limb)
    return affected_view((plane, elevation, target.twist_rad, target.elbow_rad), target.side, build, trunk)


def affected_view(angle_rad: Joints, side: Side, build: Build, trunk: TrunkFrame | None) -> ArmView:
    """An arm at the exoskeleton's joint angles."""
    plane, elevation, rotation, elbow = angle_rad
    in_trunk = arm_points_in_trunk(
        plane, elevation, rotation, elbow, build.lengths, side, build.shoulder_in_trunk(side)
    )
    in_room = None if trunk is None else trunk.origin_in_room + in_trunk @ trunk.rotation_trunk_to_room.T
    return ArmView(
        plane_rad=plane,
        elevation_rad=elevation,
        rotation_rad=rotation,
        elbow_rad=elbow,
        valid=True,
        points_in_trunk=_four(in_trunk),
        points_in_room=None if in_room is None or not np.isfinite(in_room).all() else _four(in_room),
    )


def exo_view(reading: DriveReading, command: DriveCommand, state: SafetyState) -> ExoView:
    """Measured against commanded. The rotation's speed is left out of the one factor shown: a straight elbow leaves
    the twist unknown, and that is no trouble.
    """
    return ExoView(
        angle_rad=reading.angle_rad,
        velocity_rad_s=reading.velocity_rad_s,
        torque_nm=reading.torque_nm,
        command_rad=command.angle_rad,
        command_velocity_rad_s=command.velocity_rad_s,
        clamped=command.clamped,
        speed_factor=min(state.speed[0], state.speed[1], state.speed[3]),
        blend=state.blend,
        fault=reading.fault,
        interaction_nm=reading.interaction_nm,
        share=command.share,
        assistance=state.help.mode,
        level=state.help.level,
        compliant=state.gate.state in STANDING and min(command.share) < 1.0,
    )


def _number(value: float) -> float:
    return value if isfinite(value) else 0.0


def _point(place: list[float]) -> Point | None:
    return (place[0], place[1], place[2]) if all(map(isfinite, place)) else None


def _points(places: Floats) -> tuple[Point | None, ...]:
    return tuple(map(_point, places.tolist()))


def _four(places: Floats) -> Points:
    a, b, c, d = ((x, y, z) for x, y, z in places.tolist())
    return a, b, c, d
