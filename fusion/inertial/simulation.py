"""A simulated arm with three inertial sensors, whose errors are those of a real one.

Angles are sums of sines, so that place and turn are known at any instant; what a sensor would measure follows from
differences over a millisecond. The sensors' errors are what the sensor of BROAD shows at rest (Laidig et al., Data
6(7):72, 2021).
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Final

import numpy as np
from scipy.spatial.transform import Rotation

from fusion.geometry import Floats
from fusion.inertial.arm import SEGMENTS
from fusion.inertial.chain import ArmAngles, Y, home, joint_positions, segment_motions
from fusion.inertial.lie import moved
from fusion.inertial.orientation import Inertial
from fusion.messages import ArmLengths

GRAVITY_M_S2: Final = 9.81
POSE_S: Final = 4.0
"""The arm hangs still so long before it moves."""
BEGIN_S: Final = 2.0
"""And then takes so long to get going."""
INSTANT_S: Final = 1e-3
LENGTHS: Final = ArmLengths(0.30, 0.26, 0.08)


@dataclass(frozen=True, slots=True)
class SensorErrors:
    """One sigma of each error; biases are drawn once per sensor and axis."""

    gyro_noise_rad_s: float = 0.0018
    gyro_bias_rad_s: float = 0.0025
    accel_noise_m_s2: float = 0.055
    accel_bias_m_s2: float = 0.025
    skin_rad: float = 0.0
    """How far skin and straps let the sensor turn on its segment (the sensor of BROAD sat on a rigid board)."""
    pose_rad: float = 0.0
    """How far the arm's angles are from hanging in the calibration pose; the elbow's always bent."""


@dataclass(frozen=True, slots=True)
class SimulatedArm:
    """The truth, and what the three sensors made of it."""

    t_s: Floats  # (T,)
    angles: ArmAngles
    positions: Floats  # (T, 4, 3) m in the arm's frame
    lengths: ArmLengths
    sensors: tuple[Inertial, Inertial, Inertial]  # upper arm, forearm, hand


def simulate_arm(
    seed: int,
    duration_s: float = 60.0,
    rate_hz: float = 100.0,
    errors: SensorErrors | None = None,
    lengths: ArmLengths = LENGTHS,
) -> SimulatedArm:
    """An arm that hangs still, then reaches about.

    Args:
        seed: decides movement, mounting and errors.
        duration_s: how long, with the pose.
        rate_hz: the sensors' rate.
        errors: what the sensors do wrong; the default is a real sensor's.
        lengths: the arm's.
    """
    rng = np.random.default_rng(seed)
    t_s = np.arange(round(duration_s * rate_hz)) / rate_hz
    errors = errors or SensorErrors()
    movement = _Movement.drawn(rng, errors.pose_rad)
    before, now, after = (movement.at(t_s + step) for step in (-INSTANT_S, 0.0, INSTANT_S))
    moments = [segment_motions(angles, lengths) for angles in (before, now, after)]
    sensors = []
    for number, site in enumerate(SEGMENTS):
        turn, at_m = _mounting(rng, lengths, number)
        wobble = _wobble(rng, t_s, errors.skin_rad)
        ideal = _measured((moments[0][number], moments[1][number], moments[2][number]), turn, at_m, wobble)
        sensors.append(_spoilt(rng, site, t_s, ideal, errors))
    return SimulatedArm(t_s, now, joint_positions(now, lengths), lengths, (sensors[0], sensors[1], sensors[2]))


@dataclass(frozen=True, slots=True)
class _Movement:
    """Seven angles as sums of three sines each, around a middle."""

    rest_rad: Floats  # (7,)
    middle_rad: Floats  # (7,)
    size_rad: Floats  # (7, 3)
    rate_rad_s: Floats  # (7, 3)
    phase_rad: Floats  # (7, 3)

    @classmethod
    def drawn(cls, rng: np.random.Generator, pose_rad: float) -> _Movement:
        # Shoulder (turning vector: forward and up about x, twist about y, sideways about z), elbow, pronation, wrist.
        middle = np.radians([35.0, 0.0, 10.0, 60.0, 10.0, 0.0, 0.0])
        reach = np.radians([30.0, 25.0, 20.0, 50.0, 60.0, 30.0, 15.0])
        share = rng.dirichlet(np.full(3, 3.0), 7)
        rate = 2 * np.pi * rng.uniform(0.1, 0.6, (7, 3))
        rest = rng.normal(0, pose_rad, 7) * [1, 0, 1, 1, 0, 0, 0]
        rest[3] = abs(rest[3])
        return cls(rest, middle, reach[:, None] * share, rate, rng.uniform(0, 2 * np.pi, (7, 3)))

    def at(self, t_s: Floats) -> ArmAngles:
        waves = np.sin(t_s[:, None, None] * self.rate_rad_s + self.phase_rad)
        begun = _begun(t_s)[:, None]
        moving = self.middle_rad + np.sum(self.size_rad * waves, axis=-1)
        angles = (1 - begun) * self.rest_rad + begun * moving
        return ArmAngles(angles[:, :3], *angles[:, 3:].T)


def _begun(t_s: Floats) -> Floats:
    """0 during the pose, then smoothly 1 (speed and acceleration without a step)."""
    share = np.clip((t_s - POSE_S) / BEGIN_S, 0.0, 1.0)
    begun: Floats = share**3 * (10 - 15 * share + 6 * share**2)
    return begun


def _mounting(rng: np.random.Generator, lengths: ArmLengths, number: int) -> tuple[Rotation, Floats]:
    """How a sensor sits on its segment: turned anyhow, near the middle, on the skin."""
    joints = home(lengths)
    skin = rng.uniform(-0.04, 0.04, 3) * np.array([1.0, 0.0, 1.0])
    middle: Floats = joints[number : number + 2].mean(axis=0)
    return Rotation.random(rng=rng), middle + skin


def _wobble(rng: np.random.Generator, t_s: Floats, size_rad: float) -> tuple[Rotation, Rotation, Rotation]:
    """A sensor's turn on its segment an instant before, at and after each time."""
    rate, phase = 2 * np.pi * rng.uniform(0.2, 0.8, 3), rng.uniform(0, 2 * np.pi, 3)

    def at(moment_s: Floats) -> Rotation:
        waves = np.sqrt(2) * size_rad * np.sin(moment_s[:, None] * rate + phase)
        return Rotation.from_rotvec(_begun(moment_s)[:, None] * waves)

    return at(t_s - INSTANT_S), at(t_s), at(t_s + INSTANT_S)


def _measured(
    motions: tuple[Floats, Floats, Floats],
    turn: Rotation,
    at_m: Floats,
    wobble: tuple[Rotation, Rotation, Rotation],
) -> tuple[Floats, Floats]:
    """Angular velocity and specific force in the sensor, from the segment at three instants, each (T, 4, 4)."""
    back, sensor_to_arm, ahead = (
        Rotation.from_matrix(motion[:, :3, :3]) * wobbling * turn
        for motion, wobbling in zip(motions, wobble, strict=True)
    )
    before, now, after = (moved(motion, at_m) for motion in motions)
    gyro = (back.inv() * ahead).as_rotvec() / (2 * INSTANT_S)
    accel = (before - 2 * now + after) / INSTANT_S**2
    return gyro, sensor_to_arm.inv().apply(accel + GRAVITY_M_S2 * Y)


def _spoilt(
    rng: np.random.Generator, site: str, t_s: Floats, ideal: tuple[Floats, Floats], errors: SensorErrors
) -> Inertial:
    gyro, accel = ideal
    gyro_error = rng.normal(0, errors.gyro_bias_rad_s, 3) + rng.normal(0, errors.gyro_noise_rad_s, gyro.shape)
    accel_error = rng.normal(0, errors.accel_bias_m_s2, 3) + rng.normal(0, errors.accel_noise_m_s2, accel.shape)
    return Inertial(site, t_s, gyro + gyro_error, accel + accel_error)
