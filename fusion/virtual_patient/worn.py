"""Inertial sensors worn by the virtual patient, and the errors of a real one.

What a sensor measures follows from where its segment was at the steps before and after. The sensors' errors are those
of `fusion.inertial.simulation`; each sits turned anyhow on its segment, near the middle, on skin that gives way.
"""

from __future__ import annotations

from dataclasses import dataclass
from math import pi
from typing import Final

import numpy as np
from scipy.spatial.transform import Rotation

from fusion.inertial.simulation import GRAVITY_M_S2, SensorErrors
from fusion.kinematics.angles import direction_from_swing, forearm_from_twist
from fusion.messages import Floats, TrunkFrame
from fusion.recording.recording import ImuStream
from fusion.skeleton import INDEX, Side, arm
from fusion.virtual_patient.anatomy import UP, ArmPose

ON_SKIN: Final = SensorErrors(skin_rad=float(np.radians(3.0)))
"""The sensor of BROAD, worn: skin and straps let it turn by 3° (one sigma, per axis)."""
_SKIN_M: Final = 0.04
"""How far from the segment's axis a sensor may sit."""


@dataclass(frozen=True, slots=True)
class SegmentPoses:
    """Where the segments were at one instant, in the world."""

    rotations: Floats  # (S, 3, 3) segment to world, y along the segment towards the trunk
    middles: Floats  # (S, 3) m


def sites_on(side: Side) -> tuple[str, ...]:
    """The upper back, and the three segments of one arm."""
    return ("upper-back", *(f"{segment}-{side.value}" for segment in ("upper-arm", "forearm", "hand")))


def segment_poses(positions: Floats, trunk: TrunkFrame, pose: ArmPose, side: Side) -> SegmentPoses:
    """The segments that `sites_on` names, from the joints (25, 3) in the world and the angles behind them."""
    rotation = trunk.rotation_trunk_to_room
    upper, forearm, hinge = (rotation @ axis for axis in _arm_axes(pose, side))
    rotations = np.stack([rotation, _frame(hinge, -upper), _frame(hinge, -forearm), _frame(hinge, -forearm)])
    ends = positions[[INDEX["SpineMid"], *arm(side)[:3]]], positions[[INDEX["SpineShoulder"], *arm(side)[1:]]]
    return SegmentPoses(rotations, (ends[0] + ends[1]) / 2)


def _arm_axes(pose: ArmPose, side: Side) -> tuple[Floats, Floats, Floats]:
    """Upper arm, forearm and the elbow's hinge in the trunk frame, unit vectors.

    The hinge comes from where the forearm would point at a right angle, so that it is known of a straight arm too.
    """
    signs = np.array([1.0 if side is Side.RIGHT else -1.0, 1.0, 1.0])
    upper = direction_from_swing(pose.plane_rad, pose.elevation_rad)
    forearm = forearm_from_twist(upper, pose.rotation_rad, pose.elbow_rad) * signs
    across = forearm_from_twist(upper, pose.rotation_rad, pi / 2) * signs
    return upper * signs, forearm, np.cross(upper * signs, across)


def _frame(x: Floats, y: Floats) -> Floats:
    """The rotation with these columns; x and y are at a right angle."""
    return np.column_stack([x, y, np.cross(x, y)])


def worn_streams(
    poses: list[SegmentPoses], t_s: Floats, side: Side, errors: SensorErrors, seed: int
) -> tuple[ImuStream, ...]:
    """What the sensors measured, one stream per site.

    Args:
        poses: at every instant, an even step apart.
        t_s: (T,) those instants.
        side: of the arm that wears them.
        errors: of each sensor.
        seed: of mounting and errors.
    """
    rotations = np.stack([pose.rotations for pose in poses], axis=1)  # (S, T, 3, 3)
    middles = np.stack([pose.middles for pose in poses], axis=1)  # (S, T, 3)
    streams = []
    for number, site in enumerate(sites_on(side)):
        rng = np.random.default_rng([seed, number])
        turned = Rotation.from_matrix(rotations[number]) * _giving_way(rng, t_s, errors.skin_rad)
        aside = rng.uniform(-_SKIN_M, _SKIN_M, 3) * (1 - UP)
        sensor_to_world = turned * Rotation.random(rng=rng)
        streams.append(_measured(rng, site, t_s, sensor_to_world, middles[number] + turned.apply(aside), errors))
    return tuple(streams)


def _giving_way(rng: np.random.Generator, t_s: Floats, size_rad: float) -> Rotation:
    """How far a sensor turns on its skin, about three axes, as slow waves."""
    rate, phase = 2 * pi * rng.uniform(0.2, 0.8, 3), rng.uniform(0, 2 * pi, 3)
    return Rotation.from_rotvec(np.sqrt(2) * size_rad * np.sin(t_s[:, None] * rate + phase))


def _measured(
    rng: np.random.Generator, site: str, t_s: Floats, sensor_to_world: Rotation, places: Floats, errors: SensorErrors
) -> ImuStream:
    """Angular velocity and specific force by central differences, without the first and the last instant."""
    step_s = float(t_s[1] - t_s[0])
    gyro = (sensor_to_world[:-2].inv() * sensor_to_world[2:]).as_rotvec() / (2 * step_s)
    accel_in_world = np.diff(places, 2, axis=0) / step_s**2 + GRAVITY_M_S2 * UP
    accel = sensor_to_world[1:-1].inv().apply(accel_in_world)
    gyro += rng.normal(0, errors.gyro_bias_rad_s, 3) + rng.normal(0, errors.gyro_noise_rad_s, gyro.shape)
    accel += rng.normal(0, errors.accel_bias_m_s2, 3) + rng.normal(0, errors.accel_noise_m_s2, accel.shape)
    return ImuStream(site, t_s[1:-1], gyro, accel)
