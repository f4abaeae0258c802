"""From raw inertial measurements to orientation, by VQF.

D. Laidig, T. Seel: VQF: highly accurate IMU orientation estimation with bias estimation and magnetic disturbance
rejection. Information Fusion 91 (2023) 187–204, doi:10.1016/j.inffus.2022.10.014.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Final

import numpy as np
from numpy.typing import NDArray
from scipy.spatial.transform import Rotation
from vqf import VQF, offlineVQF

from fusion.errors import InputError
from fusion.geometry import Floats

GRAVITY_M_S2: Final = 9.81
CARRIED_TAU_S: Final = 12.0
"""Time constant of the tilt for a sensor that is carried about; VQF's own is 3 s."""
LONGEST_GAP_S: Final = 0.2
"""A turn during a longer gap is anybody's guess."""


@dataclass(frozen=True, slots=True)
class Inertial:
    """What one inertial sensor measured, in its own axes."""

    site: str
    t_s: Floats  # (T,) rising; evenly for the filters, which `together` sees to
    gyro_rad_s: Floats  # (T, 3)
    accel_m_s2: Floats  # (T, 3)
    magnet_ut: Floats | None = None  # (T, 3)


@dataclass(frozen=True, slots=True)
class Oriented:
    """A sensor whose orientation is known, up to the heading of its earth frame (z up)."""

    site: str
    t_s: Floats  # (T,)
    rate_rad_s: Floats  # (T, 3) angular velocity in the sensor, gyroscope's bias removed
    up: Floats  # (T, 3) the measured specific force in the sensor, m/s²
    sensor_to_earth: Rotation  # (T,)


@dataclass(frozen=True, slots=True)
class OrientationError:
    """How far orientations are from the truth, root mean square in radians over the samples that count."""

    samples: int
    total_rad: float
    """As it is, earth frames taken as equal: with magnetometer, truth and filter share up and north."""
    inclination_rad: float
    """The part about horizontal axes."""
    heading_free_rad: float
    """The total after one constant turn about up, the best one: what a filter without north can be judged by."""
    heading_offset_rad: float
    """That turn."""


def together(imus: Sequence[Inertial]) -> tuple[Inertial, ...]:
    """Sensors on one even clock: the time that all cover, at the slowest one's rate, linear between samples.

    Raises:
        InputError: a stream has a gap, or they do not overlap by a second.
    """
    for imu in imus:
        _refuse_gaps(imu)
    first, last = max(imu.t_s[0] for imu in imus), min(imu.t_s[-1] for imu in imus)
    step_s = max(_step_s(imu) for imu in imus)
    if last - first < 1.0:
        raise InputError("the imu streams do not overlap in time", "a second at least", "check their t_s")
    clock_s = first + step_s * np.arange(int((last - first) / step_s + 1e-6) + 1)
    return tuple(_at(imu, clock_s) for imu in imus)


def _refuse_gaps(imu: Inertial) -> None:
    if len(imu.t_s) < 2:
        raise InputError(f"the imu stream '{imu.site}' has hardly any samples", "some seconds", "record it again")
    gaps = np.diff(imu.t_s)
    if gaps.max() > LONGEST_GAP_S:
        what = f"the imu stream '{imu.site}' has a gap of {gaps.max():.2f} s after {imu.t_s[gaps.argmax()]:.2f} s"
        raise InputError(what, f"none above {LONGEST_GAP_S} s", "cut the recording there")


def _at(imu: Inertial, clock_s: Floats) -> Inertial:
    def column(values: Floats) -> Floats:
        return np.stack([np.interp(clock_s, imu.t_s, part) for part in values.T], axis=-1)

    magnet = None if imu.magnet_ut is None else column(imu.magnet_ut)
    return Inertial(imu.site, clock_s, column(imu.gyro_rad_s), column(imu.accel_m_s2), magnet)


def carried(imu: Inertial) -> Floats:
    """Acceleration in a level earth frame of its own heading, freed of gravity, causal: (T, 3) m/s².

    Of somebody who walks about: pulling the tilt towards the measured force as fast as a limb's sensor wants it would
    take every start and every bend for a tilt, and lose the acceleration that is sought.
    """
    gyro, accel = np.ascontiguousarray(imu.gyro_rad_s), np.ascontiguousarray(imu.accel_m_s2)
    found = VQF(_step_s(imu), tauAcc=CARRIED_TAU_S).updateBatch(gyro, accel)
    level: Floats = Rotation.from_quat(found["quat6D"], scalar_first=True).apply(accel)
    return level - [0.0, 0.0, GRAVITY_M_S2]


def orient(imu: Inertial, causal: bool = False) -> Oriented:
    """Orientation without magnetometer: exact up and down, a heading of its own that drifts slowly.

    Args:
        imu: what was measured.
        causal: as it would come live; else the filter runs forward and backward over the whole recording.
    """
    step_s = _step_s(imu)
    gyro, accel = np.ascontiguousarray(imu.gyro_rad_s), np.ascontiguousarray(imu.accel_m_s2)
    found = VQF(step_s).updateBatchFullState(gyro, accel) if causal else offlineVQF(gyro, accel, None, step_s)
    rotation = Rotation.from_quat(found["quat6D"], scalar_first=True)
    return Oriented(imu.site, imu.t_s, imu.gyro_rad_s - found["bias"], imu.accel_m_s2, rotation)


def orient_to_north(imu: Inertial) -> Rotation:
    """Orientation with magnetometer, causal, x east, y north, z up: (T,) sensor to earth.

    Raises:
        InputError: the sensor has no magnetometer.
    """
    if imu.magnet_ut is None:
        raise InputError(f"the imu stream '{imu.site}' has no magnetometer", "mx_uT,my_uT,mz_uT", "go without north")
    columns = (imu.gyro_rad_s, imu.accel_m_s2, imu.magnet_ut)
    found = VQF(_step_s(imu)).updateBatch(*(np.ascontiguousarray(column) for column in columns))
    return Rotation.from_quat(found["quat9D"], scalar_first=True)


def orientation_error(found: Rotation, truth: Floats, counts: NDArray[np.bool_]) -> OrientationError:
    """Error of orientations against the truth.

    The error is the turn, seen in the earth frame, that takes the true orientation to the one found; its heading is its
    twist about up and its inclination the rest [Laidig and Seel 2023, §5.2].

    Args:
        found: (T,) sensor to earth.
        truth: (T, 4) quaternions, w first; NaN where unknown.
        counts: (T,) the samples to judge by.

    Raises:
        InputError: nothing is left to judge by.
    """
    use = counts & np.isfinite(truth).all(axis=1)
    if not use.any():
        raise InputError("no true orientation counts", "moving = 1 somewhere", "take another recording")
    error = found[use] * Rotation.from_quat(truth[use], scalar_first=True).inv()
    w, x, y, z = error.as_quat(scalar_first=True).T
    offset = float(np.angle(np.mean((w + 1j * z) ** 2)))
    levelled = Rotation.from_rotvec([0.0, 0.0, -offset]) * error
    inclination = 2 * np.arcsin(np.clip(np.hypot(x, y), 0, 1))
    return OrientationError(
        int(use.sum()),
        _rms(np.asarray(error.magnitude())),
        _rms(inclination),
        _rms(np.asarray(levelled.magnitude())),
        offset,
    )


def _rms(values: Floats) -> float:
    return float(np.sqrt(np.mean(values**2)))


def _step_s(imu: Inertial) -> float:
    return float(imu.t_s[-1] - imu.t_s[0]) / (len(imu.t_s) - 1)
