"""A hand seen by two sensors whose noise keeps its bound, followed by the literal filter and by ours."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Final

import numpy as np

from fusion.estimation import METHODS
from fusion.experiments.measures.literal_esmf import LiteralState, Sensor, predicted, started, updated
from fusion.messages import AlignedSample, Floats
from fusion.skeleton import INDEX, JOINT_COUNT, Side, TrackingState
from fusion.virtual_patient.patient import VirtualPatient
from fusion.virtual_patient.sensor import SensorPose
from fusion.virtual_patient.trial import exercises

HAND: Final = INDEX["WristRight"]
RATE_HZ: Final = 30.0
CORRELATION: Final = 0.9
"""From frame to frame, as in the simulation of Table 1."""
SIZE: Final = 0.23
"""Standard deviation of the noise in units of its bound: 45.6 mm in ±200 mm [Du2016, Table 1]."""


@dataclass(frozen=True, slots=True)
class Followed:
    """One filter's course, N measurements."""

    t_s: Floats  # (N,)
    half_axis_m: Floats  # (N,) the set's longest, in position; +inf once it is not a number any more
    error_m: Floats  # (N,) of its centre
    refused: Floats  # (N,) 1 where the measurement was refused


@dataclass(frozen=True, slots=True)
class Hand:
    """Measurements of all joints by two sensors in turn."""

    t_s: Floats  # (N,)
    truth: Floats  # (N, 25, 3) m in the room
    measured: Floats  # (N, 25, 3) m in the room
    sensors: tuple[Sensor, Sensor]


def hand(seed: int, length_s: float, bound_m: float) -> Hand:
    """A patient who exercises; each sensor errs within ±`bound_m` along its own axes."""
    rng = np.random.default_rng(seed)
    patient, goals = VirtualPatient(Side.RIGHT, seed), exercises(seed)
    poses = (SensorPose.around(0.0), SensorPose.around(np.pi / 2))
    sensors = tuple(Sensor(p.position_in_world, p.rotation_sensor_to_world, bound_m) for p in poses)
    until_s, goal = next(goals)
    noise = [rng.normal(size=(JOINT_COUNT, 3)) for _ in sensors]
    t_s, truth, measured = [], [], []
    for k in range(round(2 * RATE_HZ * length_s)):
        while patient.t_s > until_s:
            stays_s, goal = next(goals)
            until_s += stays_s
        which = k % 2
        joints = patient.step(1 / (2 * RATE_HZ), goal)
        noise[which] = CORRELATION * noise[which] + np.sqrt(1 - CORRELATION**2) * rng.normal(size=(JOINT_COUNT, 3))
        error = np.clip(SIZE * bound_m * noise[which], -bound_m, bound_m)
        t_s.append(patient.t_s)
        truth.append(joints)
        measured.append(joints + error @ sensors[which].rotation.T)
    return Hand(np.array(t_s), np.array(truth), np.array(measured), (sensors[0], sensors[1]))


def follow_literally(seen: Hand, mended_gain: bool) -> Followed:
    """The filter as printed, or with its gain mended alone."""
    state = started(seen.measured[0, HAND], seen.sensors[0].bound_m)
    rows = []
    with np.errstate(all="ignore"):  # that it runs out of numbers is what is to be seen
        for k in range(1, len(seen.t_s)):
            sensor = seen.sensors[k % 2]
            state = predicted(state, float(seen.t_s[k] - seen.t_s[k - 1]))
            state, taken = _updated(state, sensor, sensor.measure(seen.measured[k, HAND]), mended_gain)
            rows.append((seen.t_s[k], _half_axis(state), _off(state, seen.truth[k, HAND]), 0.0 if taken else 1.0))
    return Followed(*np.array(rows).T)


def follow(seen: Hand, method: str) -> Followed:
    """One of our methods on the same measurements, at the same instants."""
    estimator = METHODS[method]()
    rows = []
    for k, (t_s, measured, truth) in enumerate(zip(seen.t_s, seen.measured, seen.truth, strict=True)):
        sensor = seen.sensors[k % 2]
        state = np.full(JOINT_COUNT, TrackingState.TRACKED, dtype=np.uint8)
        name = f"sensor-{k % 2 + 1}"
        refused = estimator.update(
            AlignedSample(name, float(t_s), float(t_s), measured, state, sensor.position, sensor.rotation)
        )
        told = estimator.frame(float(t_s))
        off = float(np.linalg.norm(told.positions_in_room[HAND] - truth[HAND]))
        rows.append((t_s, told.bound_m[HAND], off, float(any(each.joint == HAND for each in refused))))
    return Followed(*np.array(rows).T)


def _updated(state: LiteralState, sensor: Sensor, measured: Floats, mended_gain: bool) -> tuple[LiteralState, bool]:
    if not np.isfinite(state.shape).all():
        return state, False
    return updated(state, sensor, measured, mended_gain)


def _half_axis(state: LiteralState) -> float:
    if not np.isfinite(state.shape).all():
        return np.inf
    return float(np.sqrt(max(np.linalg.eigvalsh(state.shape[:3, :3])[-1], 0.0)))


def _off(state: LiteralState, truth: Floats) -> float:
    return float(np.linalg.norm(state.centre[:3] - truth))
