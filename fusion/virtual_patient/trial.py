"""A recording of the virtual patient with the truth beside it, for tests and studies."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from math import pi
from pathlib import Path
from typing import Final

import numpy as np

from fusion.inertial.simulation import SensorErrors
from fusion.messages import Floats, SkeletonSample
from fusion.recording.reader import Recording, SkeletonStream, TruthStream
from fusion.skeleton import JOINTS, Side
from fusion.virtual_patient.anatomy import ArmPose
from fusion.virtual_patient.patient import PoseGoal, VirtualPatient
from fusion.virtual_patient.reaching import RANGES_RAD
from fusion.virtual_patient.sensor import DEMO, NoiseLevel, SensorPose, VirtualSensor
from fusion.virtual_patient.tag import TagErrors, tag_ranges
from fusion.virtual_patient.worn import SegmentPoses, segment_poses, worn_streams

_STEP_S: Final = 0.01
_GOAL_S: Final = (1.5, 4.0)
"""How long the patient stays with one goal."""
_REST_SHARE: Final = 0.15


def exercises(seed: int) -> Iterator[tuple[float, PoseGoal | None]]:
    """Goals for ever, each with its duration in seconds; None = a rest."""
    rng = np.random.default_rng(seed)
    low, high = RANGES_RAD[:, 0], RANGES_RAD[:, 1]
    while True:
        pose = ArmPose(*(low + rng.uniform(0.1, 0.9, 4) * (high - low)).tolist())
        goal = None if rng.uniform() < _REST_SHARE else PoseGoal(pose)
        yield float(rng.uniform(*_GOAL_S)), goal


def sensors_for(
    healthy_side: Side, seed: int, noise: NoiseLevel = DEMO, clock_offset_s: float = 0.0, apart_rad: float = pi / 2
) -> tuple[VirtualSensor, VirtualSensor]:
    """The usual pair: the reference ahead of the patient, the second towards the healthy side.

    Args:
        healthy_side: where the second one stands.
        seed: of both.
        noise: of both.
        clock_offset_s: the second one's clock minus the first one's.
        apart_rad: angle between them; a few degrees off a round number, as people mount them.
    """
    sign = 1.0 if healthy_side is Side.RIGHT else -1.0
    second = SensorPose.around(sign * apart_rad, distance_m=1.9, height_m=0.9, tilt_rad=0.02)
    return (
        VirtualSensor("virtual-1", SensorPose.around(0.0), seed, noise=noise),
        VirtualSensor("virtual-2", second, seed + 1, noise=noise, clock_offset_s=clock_offset_s, body="2"),
    )


def virtual_recording(
    seed: int,
    length_s: float,
    *,
    healthy_side: Side = Side.RIGHT,
    noise: NoiseLevel = DEMO,
    clock_offset_s: float = 0.137,
    apart_rad: float = 1.5,
    ability: float = 1.0,
    stroll_m: float = 0.0,
    worn: SensorErrors | None = None,
    tag: TagErrors | None = None,
) -> Recording:
    """A patient who exercises before two sensors; truth at 100 Hz in the first sensor's frame and clock.

    Args:
        seed: of everything random.
        length_s: how long.
        healthy_side: the arm that exercises.
        noise: of both sensors.
        clock_offset_s: the second sensor's clock minus the first one's.
        apart_rad: angle between the sensors.
        ability: (0, 1]; lower is slower.
        stroll_m: how far the patient shifts about.
        worn: errors of inertial sensors on upper back, upper arm, forearm and hand; None = none are worn.
        tag: errors of a radio tag's ranges; None = there is no tag.
    """
    patient = VirtualPatient(healthy_side, seed, ability=ability, stroll_m=stroll_m)
    sensors = sensors_for(healthy_side, seed, noise, clock_offset_s, apart_rad)
    seen: dict[str, list[SkeletonSample]] = {sensor.name: [] for sensor in sensors}
    moments: list[_Moment] = []
    for positions in _lived(patient, length_s, seed):
        poses = segment_poses(positions, patient.trunk, patient.healthy_pose, healthy_side)
        moments.append(_Moment(patient.t_s, positions, poses))
        for sensor in sensors:
            sample = sensor.see(positions, patient.t_s)
            if sample is not None:
                seen[sensor.name].append(sample)
    streams = tuple(SkeletonStream(s.name, s is sensors[0], "sensor", tuple(seen[s.name])) for s in sensors)
    t_s, lived = np.array([moment.t_s for moment in moments]), np.array([moment.positions for moment in moments])
    poses_lived = [moment.poses for moment in moments]
    backs = np.array([pose.rotations[0][:, 2] for pose in poses_lived])
    return Recording(
        f"virtual-{seed}",
        "A virtual patient before two virtual sensors",
        healthy_side,
        streams,
        TruthStream(t_s, JOINTS, sensors[0].pose.to_sensor(lived), sensors[0].name),
        (),
        Path(f"virtual-{seed}"),
        imu_streams=() if worn is None else worn_streams(poses_lived, t_s, healthy_side, worn, seed),
        range_streams=() if tag is None else (tag_ranges(lived, backs, t_s, tag, seed),),
    )


@dataclass(frozen=True, slots=True)
class _Moment:
    """The patient at one instant, in the world."""

    t_s: float
    positions: Floats  # (25, 3) m
    poses: SegmentPoses


def _lived(patient: VirtualPatient, length_s: float, seed: int) -> Iterator[Floats]:
    """The patient's joints, step by step."""
    until_s = 0.0
    goals, goal = exercises(seed), None
    while patient.t_s < length_s:
        if patient.t_s >= until_s:
            stay_s, goal = next(goals)
            until_s = patient.t_s + stay_s
        yield patient.step(_STEP_S, goal)
