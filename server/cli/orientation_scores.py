"""`mirrorlimb evaluate` on a recording with true orientations: how far the filter is from them."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import asdict, dataclass
from typing import Any

import numpy as np
from rich.box import SIMPLE_HEAD
from rich.table import Table

from fusion.errors import RecordingError
from fusion.inertial.orientation import Inertial, OrientationError, orient, orient_to_north, orientation_error
from fusion.recording.reader import OrientationTruth, Recording


@dataclass(frozen=True, slots=True)
class OrientationScore:
    """One recording's orientation error with magnetometer (where there is one) and without."""

    recording: str
    ways: dict[str, OrientationError]


def score_orientation(recording: Recording, truth: OrientationTruth) -> OrientationScore:
    """Run the orientation filter causally and judge it on the samples with moving = 1.

    Raises:
        RecordingError: there is not exactly one inertial stream, or it has other times than the truth.
    """
    if len(recording.imu_streams) != 1 or not np.array_equal(recording.imu_streams[0].t_s, truth.t_s):
        what = f"'{recording.name}' has truth for one sensor, and {len(recording.imu_streams)} imu streams"
        raise RecordingError(what, "one imu stream with the truth's times", "mend the recording")
    (stream,) = recording.imu_streams
    imu = Inertial(stream.site, stream.t_s, stream.gyro_rad_s, stream.accel_m_s2, stream.magnet_ut)
    found = {"without magnetometer": orient(imu, causal=True).sensor_to_earth}
    if imu.magnet_ut is not None:
        found["with magnetometer"] = orient_to_north(imu)
    errors = {way: orientation_error(one, truth.orientation, truth.moving) for way, one in found.items()}
    return OrientationScore(recording.name, errors)


def orientation_table(score: OrientationScore) -> Table:
    """The figures for the terminal, in degrees."""
    heading = f"{score.recording}: orientation, live\nroot mean square over the samples with moving = 1"
    table = Table(title=heading, caption="degrees; turned: less one constant turn about up", box=SIMPLE_HEAD)
    for name in ("filter", "total", "turned", "inclination", "the turn", "samples"):
        table.add_column(name, justify="left" if name == "filter" else "right", no_wrap=True)
    for way, error in score.ways.items():
        angles = (error.total_rad, error.heading_free_rad, error.inclination_rad, error.heading_offset_rad)
        table.add_row(way, *(f"{np.degrees(angle):.2f}" for angle in angles), str(error.samples))
    return table


def orientations_as_json(scores: Sequence[OrientationScore]) -> list[dict[str, Any]]:
    """The figures as they stand, in radians."""
    return [{"recording": s.recording, "ways": {way: asdict(e) for way, e in s.ways.items()}} for s in scores]
