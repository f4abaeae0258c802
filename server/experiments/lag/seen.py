"""What of a reaching arm's angles is known at every tick: by the sensors' mean, and by the estimator."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Final

import numpy as np

from fusion.align.alignment import reference_alignment
from fusion.estimation import METHODS
from fusion.experiments.measures.turning import second_to_first
from fusion.kinematics.angles import ARM_JOINTS, OUTWARD, arm_pose, swing_from_direction
from fusion.kinematics.body_frame import trunk_frame
from fusion.kinematics.follower import ArmFollower
from fusion.messages import AlignedSample, Floats
from fusion.rewind import RewindingEstimator
from fusion.virtual_patient.trial import sensors_for
from server.config import StationConfig
from server.experiments.cranked.station import DT_S
from server.experiments.lag.reaching import APART_RAD, SIDE, Reaching

UNKNOWN: Final = (float("nan"),) * 4


@dataclass(frozen=True, slots=True)
class Seen:
    """Angles (T, 4) of the arm, tick by tick."""

    truth_rad: Floats
    sensors_rad: Floats
    """Of the mean of both sensors' newest joints."""
    estimated_rad: Floats
    """Of the estimator's joints, as the mirror gives them on."""


def seen(scene: Reaching) -> Seen:
    """Give the samples to the default estimator as they come; who the patient is and where sensors stand is known."""
    estimator, follower = RewindingEstimator(METHODS[StationConfig().method]), ArmFollower(SIDE)
    due = _aligned(scene)
    latest: dict[str, AlignedSample] = {}
    sensors, estimated = [], []
    for tick in range(len(scene.truth_rad)):
        t_s = (tick + 1) * DT_S
        while due and due[0].t_s <= t_s:
            latest[due[0].sensor] = due[0]
            estimator.take(due.pop(0))
        sensors.append(_mean_angles(tuple(latest.values())))
        estimated.append(_estimated(estimator, follower, tuple(latest.values()), t_s))
    return Seen(scene.truth_rad, _known(sensors), _known(estimated))


def _aligned(scene: Reaching) -> list[AlignedSample]:
    first, second = sensors_for(SIDE, 0, apart_rad=APART_RAD)
    known = {first.name: reference_alignment(), second.name: second_to_first(first.pose, second.pose)}
    streams = scene.recording.skeleton_streams
    samples = [known[s.sensor].apply(each, each.t_s) for s in streams for each in s.samples]
    return sorted(samples, key=lambda sample: sample.t_s)


def _mean_angles(latest: Sequence[AlignedSample]) -> tuple[float, ...]:
    if len(latest) < 2:
        return UNKNOWN
    positions = np.mean([sample.positions_in_room for sample in latest], axis=0)
    trunk = trunk_frame(positions)
    if trunk is None:
        return UNKNOWN
    pose = arm_pose(positions, trunk.rotation_trunk_to_room, OUTWARD[SIDE], ARM_JOINTS[SIDE])
    return pose.plane, pose.elevation, pose.twist, pose.flexion


def _estimated(
    estimator: RewindingEstimator, follower: ArmFollower, latest: tuple[AlignedSample, ...], t_s: float
) -> tuple[float, ...]:
    if estimator.newest_s is None:
        return UNKNOWN
    target = follower.follow(estimator.frame(t_s), latest).target
    if target is None or not target.valid:
        return UNKNOWN
    return *swing_from_direction(target.direction_in_limb), target.twist_rad, target.elbow_rad


def _known(angles: Sequence[tuple[float, ...]]) -> Floats:
    """(T, 4): what is not known stays what it was, the first unknown ones what comes first."""
    found = np.array(angles)
    for column in found.T:
        known = np.flatnonzero(np.isfinite(column))
        column[:] = column[known[np.maximum(np.searchsorted(known, np.arange(len(column)), side="right") - 1, 0)]]
    return found
