"""Streams of inertial sensors and of true orientations: their columns, read from a table and laid out as rows."""

from __future__ import annotations

from pathlib import Path

import numpy as np

from fusion.errors import RecordingError
from fusion.messages import Floats
from fusion.recording.recording import ImuStream, OrientationTruth
from fusion.recording.table import Table, read_table

T = ("t_s",)
ORIENTATION = ("qw", "qx", "qy", "qz")
GYRO = ("gx_rad_s", "gy_rad_s", "gz_rad_s")
ACCEL = ("ax_m_s2", "ay_m_s2", "az_m_s2")
MAGNET = ("mx_uT", "my_uT", "mz_uT")
ORIENTATION_TRUTH_COLUMNS = (*T, *ORIENTATION, "moving")


def read_imu(path: Path, site: str) -> ImuStream:
    """Read what one inertial sensor measured.

    Raises:
        RecordingError: a column is missing, a number is none, or time does not go forward; names the line.
    """
    table = read_table(path, (*T, *GYRO, *ACCEL), (ORIENTATION, MAGNET))
    return ImuStream(
        site,
        _rising_times(table),
        _finite(table, GYRO),
        _finite(table, ACCEL),
        _finite(table, MAGNET) if MAGNET[0] in table.columns else None,
        _finite(table, ORIENTATION) if ORIENTATION[0] in table.columns else None,
    )


def read_orientation_truth(path: Path) -> OrientationTruth:
    """Read how a sensor was really turned; NaN where nobody knows.

    Raises:
        RecordingError: as `read_imu`.
    """
    table = read_table(path, ORIENTATION_TRUTH_COLUMNS)
    quaternion = np.stack([table.numbers(name) for name in ORIENTATION], axis=-1)
    return OrientationTruth(_rising_times(table), quaternion, table.numbers("moving") == 1)


def _rising_times(table: Table) -> Floats:
    t_s = table.numbers("t_s")
    later = np.isfinite(t_s)
    later[1:] &= np.diff(t_s) > 0
    table.require(later, lambda row: f"t_s is '{table.field('t_s', row)}'", "a later time than in the line before")
    return t_s


def _finite(table: Table, names: tuple[str, ...]) -> Floats:  # (T, len(names))
    numbers = np.stack([table.numbers(name) for name in names], axis=-1)
    table.require(
        np.isfinite(numbers.sum(axis=-1)), lambda _: f"{','.join(names)} is not finite", "a number in every column"
    )
    return numbers


# ---------------------------------------------------------------- rows of numbers, for either form of a recording


def imu_columns(stream: ImuStream) -> tuple[str, ...]:
    """The first line of the stream's table."""
    orientation = ORIENTATION if stream.orientation is not None else ()
    return (*T, *orientation, *GYRO, *ACCEL, *(MAGNET if stream.magnet_ut is not None else ()))


def imu_table(stream: ImuStream) -> Floats:
    """The numbers under `imu_columns`, (T, columns)."""
    orientation = [] if stream.orientation is None else [stream.orientation]
    magnet = [] if stream.magnet_ut is None else [stream.magnet_ut]
    return np.column_stack([stream.t_s, *orientation, stream.gyro_rad_s, stream.accel_m_s2, *magnet])


def imu_block(stream: ImuStream) -> Floats:
    """All columns in a fixed order, NaN where the sensor has none: time, gyro, acceleration, magnet, orientation."""
    nothing = np.full((len(stream.t_s), 4), np.nan)
    magnet = nothing[:, :3] if stream.magnet_ut is None else stream.magnet_ut
    orientation = nothing if stream.orientation is None else stream.orientation
    return np.column_stack([stream.t_s, stream.gyro_rad_s, stream.accel_m_s2, magnet, orientation])


def imu_from_block(site: str, block: Floats) -> ImuStream:
    """The inverse of `imu_block`."""
    magnet, orientation = block[:, 7:10], block[:, 10:14]
    return ImuStream(
        site,
        block[:, 0],
        block[:, 1:4],
        block[:, 4:7],
        None if np.isnan(magnet).all() else magnet,
        None if np.isnan(orientation).all() else orientation,
    )


def orientation_truth_table(truth: OrientationTruth) -> Floats:
    """The numbers under `ORIENTATION_TRUTH_COLUMNS`, (T, 6)."""
    return np.column_stack([truth.t_s, truth.orientation, truth.moving])


def orientation_truth_from_table(table: Floats) -> OrientationTruth:
    """The inverse of `orientation_truth_table`."""
    return OrientationTruth(table[:, 0], table[:, 1:5], table[:, 5] == 1)


def refuse_twins(path: Path, sites: list[str]) -> None:
    """Raise RecordingError where two sensors claim one site, or one names none."""
    for site in sites:
        if not site or sites.count(site) > 1:
            problem = f"the site '{site}' is named twice" if site else "an imu stream names no site"
            raise RecordingError(f"{path}: {problem}", "a site of its own per imu stream", "mend the file")
