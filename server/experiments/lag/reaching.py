"""A patient who reaches from pose to pose at a peak of 1.5 rad/s before two sensors, as a recording with truth."""

from __future__ import annotations

from dataclasses import dataclass
from math import pi
from pathlib import Path
from typing import Final

import numpy as np
from scipy.spatial.transform import Rotation

from fusion.messages import Floats, SkeletonSample, TrunkFrame
from fusion.recording.recording import Recording, SkeletonStream, TruthStream
from fusion.skeleton import INDEX, JOINTS, Side
from fusion.virtual_patient.anatomy import (
    UP,
    Anatomy,
    ArmPose,
    Posture,
    legs_from_pelvis,
    pelvis_height_m,
    resting,
    trunk_and_arms,
)
from fusion.virtual_patient.movement import PEAK_OVER_MEAN, least_jerk
from fusion.virtual_patient.sensor import NoiseLevel
from fusion.virtual_patient.sway import Sway
from fusion.virtual_patient.trial import sensors_for
from server.experiments.cranked.station import DT_S

PEAK_RAD_S: Final = 1.5
REST_S: Final = (0.5, 2.0)
LOWEST_RAD: Final = np.array([0.2, 0.45, -0.3, 0.5])
HIGHEST_RAD: Final = np.array([1.4, 1.5, 0.8, 2.0])
"""Plane, elevation, rotation and elbow between which the arm reaches: clear of where an angle means nothing."""
SWAY_RAD: Final = np.array([0.020, 0.025, 0.012])
SIDE: Final = Side.RIGHT
APART_RAD: Final = pi / 2


@dataclass(frozen=True, slots=True)
class Reaching:
    """What the sensors saw, and how the arm was."""

    recording: Recording
    truth_rad: Floats  # (T, 4) at every tick, the first one a tick after the beginning


def reaching(seed: int, length_s: float, noise: NoiseLevel) -> Reaching:
    """Least-jerk reaches with rests between.

    Args:
        seed: of everything random.
        length_s: how long.
        noise: of both sensors.
    """
    truth_rad, sway = _reaches(seed, round(length_s / DT_S)), Sway(SWAY_RAD, np.random.default_rng(seed))
    sensors = sensors_for(SIDE, seed, noise, 0.0, APART_RAD)
    seen: dict[str, list[SkeletonSample]] = {sensor.name: [] for sensor in sensors}
    lived = []
    t_s = np.linspace(DT_S, len(truth_rad) * DT_S, len(truth_rad))
    for now_s, pose in zip(t_s.tolist(), truth_rad, strict=True):
        sway.step(DT_S)
        lived.append(_body(pose, sway.angles_rad))
        for sensor in sensors:
            sample = sensor.see(lived[-1], now_s)
            if sample is not None:
                seen[sensor.name].append(sample)
    streams = tuple(SkeletonStream(s.name, s is sensors[0], "sensor", tuple(seen[s.name])) for s in sensors)
    truth = TruthStream(t_s, JOINTS, sensors[0].pose.to_sensor(np.array(lived)), sensors[0].name)
    name = f"reaching-{seed}"
    return Reaching(Recording(name, "Reaches before two sensors", SIDE, streams, truth, (), Path(name)), truth_rad)


def _reaches(seed: int, ticks: int) -> Floats:
    """(T, 4) rad."""
    rng = np.random.default_rng(seed)
    here, parts, count = rng.uniform(LOWEST_RAD, HIGHEST_RAD), [], 0
    while count < ticks:
        there = rng.uniform(LOWEST_RAD, HIGHEST_RAD)
        length_s = PEAK_OVER_MEAN * float(np.abs(there - here).max()) / PEAK_RAD_S
        times = np.arange(0.0, length_s + rng.uniform(*REST_S), DT_S)
        share = np.array([least_jerk(t_s / length_s) for t_s in times.tolist()])
        parts.append(here + share[:, None] * (there - here))
        here, count = there, count + len(times)
    return np.concatenate(parts)[:ticks]


def _body(pose: Floats, sway_rad: Floats) -> Floats:
    """(25, 3) m in the world: somebody who sits above its origin."""
    anatomy, posture = Anatomy(), Posture.SITTING
    pitch, yaw, roll = sway_rad
    rotation = np.asarray(Rotation.from_euler("YXZ", [yaw, pitch, roll]).as_matrix())
    trunk = TrunkFrame(pelvis_height_m(anatomy, posture) * UP + anatomy.spine_m * (rotation @ UP), rotation)
    arms = {SIDE: ArmPose(*pose.tolist()), SIDE.other: resting(posture)}
    positions: Floats = trunk.origin_in_room + trunk_and_arms(anatomy, arms) @ trunk.rotation_trunk_to_room.T
    for joint, place in legs_from_pelvis(anatomy, posture).items():
        positions[joint] = positions[INDEX["SpineBase"]] + place
    return positions
