"""A simulated patient who turns from one sensor to the other, and what each sensor says of every joint's state."""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path
from typing import Final

import numpy as np

from fusion.align.alignment import SensorAlignment, reference_alignment
from fusion.experiments.measures.scene import Scene, scene_of
from fusion.messages import Floats, SkeletonSample, States
from fusion.recording.recording import Recording, SkeletonStream, TruthStream
from fusion.skeleton import JOINTS, Side
from fusion.virtual_patient.anatomy import Posture
from fusion.virtual_patient.patient import VirtualPatient
from fusion.virtual_patient.sensor import DEMO, SensorPose, VirtualSensor
from fusion.virtual_patient.trial import exercises

STEP_S: Final = 0.01
DISTANCE_M: Final = 2.0
HEIGHT_M: Final = 0.7
"""[Yao]: sensors at right angles, 0.70 m high, 2 m from the middle."""


@dataclass(frozen=True, slots=True)
class Turned:
    """The patient exercises and faces one way all the while."""

    facing_deg: float
    """0 = towards the first sensor, 90 = towards the second."""
    recording: Recording
    scene: Scene
    """Mounting and clocks known: a calibration of its own gives them in the paper."""


def turned(seed: int, facing_deg: float, length_s: float) -> Turned:
    """A standing patient who faces so and exercises, the arm hanging every other time; two sensors at a right angle."""
    facing_rad = float(np.radians(facing_deg))
    poses = [SensorPose.around(k * np.pi / 2 - facing_rad, DISTANCE_M, HEIGHT_M) for k in (0, 1)]
    sensors = [VirtualSensor(f"kinect-{k + 1}", pose, seed + k, noise=DEMO) for k, pose in enumerate(poses)]
    patient, goals = VirtualPatient(Side.RIGHT, seed, posture=Posture.STANDING), exercises(seed)
    seen: list[list[SkeletonSample]] = [[], []]
    t_s, lived, until_s, goal, rests = [], [], 0.0, None, True
    while patient.t_s < length_s:
        if patient.t_s >= until_s:
            stays_s, wanted = next(goals)
            rests = not rests
            until_s, goal = patient.t_s + stays_s, None if rests else wanted
        joints = patient.step(STEP_S, goal)
        t_s.append(patient.t_s)
        lived.append(joints)
        for sensor, samples in zip(sensors, seen, strict=True):
            sample = sensor.see(joints, patient.t_s)
            if sample is not None:
                samples.append(sample)
    first, second = poses
    truth = TruthStream(np.array(t_s), JOINTS, first.to_sensor(np.array(lived)), "kinect-1")
    streams = tuple(
        SkeletonStream(sensor.name, k == 0, "sensor", tuple(samples))
        for k, (sensor, samples) in enumerate(zip(sensors, seen, strict=True))
    )
    recording = Recording("turned", "A virtual patient who turns", Side.RIGHT, streams, truth, (), Path("turned"))
    known = {"kinect-1": reference_alignment(), "kinect-2": second_to_first(first, second)}
    return Turned(facing_deg, recording, scene_of(recording, known))


def second_to_first(first: SensorPose, second: SensorPose) -> SensorAlignment:
    """The true alignment of the second sensor, clocks alike."""
    to_first = first.rotation_sensor_to_world.T
    rotation: Floats = to_first @ second.rotation_sensor_to_world
    translation: Floats = to_first @ (second.position_in_world - first.position_in_world)
    return SensorAlignment(rotation, translation, 0.0, 0.0, 0, 0.0, 0.0)


def states_alone(scene: Scene, sensor: str, within_s: float) -> States:
    """(T, 25) what the sensor's latest sample says of every joint; 0 where it is older than `within_s`."""
    own = [(t_s, sample) for t_s, sample in scene.due if sample.sensor == sensor]
    latest = np.searchsorted(np.array([t_s for t_s, _ in own]), scene.t_s, side="right") - 1
    age_s = scene.t_s - np.array([t_s for t_s, _ in own])[latest]
    states = np.array([sample.state for _, sample in own])[latest]
    fresh = (latest >= 0) & (age_s <= within_s)
    return np.where(fresh[:, None], states, 0).astype(np.uint8)
