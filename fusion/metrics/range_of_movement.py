"""How far each joint moved: robust ranges for the healthy and the affected arm."""

from __future__ import annotations

from math import pi, radians
from typing import Final

import numpy as np

from fusion.messages import Flags, Floats
from fusion.metrics.metric import ONE_SENSOR, PASSIVE_DRIVE, Metric
from fusion.metrics.record import JOINTS, SessionRecord
from fusion.metrics.uncertainty import batch_sem
from fusion.skeleton import Side

LOWEST_PERCENT, HIGHEST_PERCENT = 2.0, 98.0
"""Ends of the range; what lies outside is as likely the sensor as the arm."""
ENOUGH: Final = 50
"""Ticks below which no range is given."""
TOLD_RAD: Final = radians(30.0)
"""The plane needs so much elevation, the rotation so much elbow bend, or they are noise."""
RangeNames = tuple[str, str, str]
RANGE: Final[RangeNames] = ("range_lowest", "range_highest", "range_of_movement")


def range_metrics(record: SessionRecord) -> list[Metric]:
    """Lowest and highest angle and the range between them, per joint and arm, while the arm was driven."""
    affected_caveat = PASSIVE_DRIVE if record.is_driven else None
    healthy_caveat = ONE_SENSOR if record.sees_with_one else None
    healthy = _arm(record.healthy_rad, record.engaged & record.healthy_valid, record.healthy_side, healthy_caveat)
    affected = _arm(record.affected_rad, record.engaged, record.healthy_side.other, affected_caveat)
    return healthy + affected


def _arm(angles_rad: Floats, usable: Flags, side: Side, caveat: str | None) -> list[Metric]:
    found: list[Metric] = []
    for column, joint in enumerate(JOINTS):
        sample = angles_rad[usable & told(angles_rad, joint), column]
        if len(sample) < ENOUGH:
            continue
        found += joint_range(RANGE, sample, joint, side, caveat)
    return found


def joint_range(names: RangeNames, sample_rad: Floats, joint: str, side: Side, caveat: str | None) -> list[Metric]:
    """Lowest, highest and the range between them of one joint, each with its standard error."""
    return [
        Metric(name, of(sample_rad), "rad", joint, side, caveat, batch_sem(sample_rad, of))
        for name, of in zip(names, (_lowest, _highest, _width), strict=True)
    ]


def _lowest(sample_rad: Floats) -> float:
    return angle_range(sample_rad)[0]


def _highest(sample_rad: Floats) -> float:
    return angle_range(sample_rad)[1]


def _width(sample_rad: Floats) -> float:
    low, high = angle_range(sample_rad)
    return high - low


def told(angles_rad: Floats, joint: str) -> Flags:
    """(T,) where an angle is finite and means something."""
    means = np.isfinite(angles_rad).all(axis=1)
    teller = {"plane": "elevation", "rotation": "elbow"}.get(joint)
    if teller is not None:
        angle = angles_rad[:, JOINTS.index(teller)]
        means = means & (np.minimum(angle, pi - angle) > TOLD_RAD)
    return np.asarray(means)


def angle_range(sample_rad: Floats) -> tuple[float, float]:
    """2nd and 98th percentile about the circular mean, so that a turn through ±180° is no jump."""
    centre = float(np.angle(np.exp(1j * sample_rad).mean()))
    about = (sample_rad - centre + pi) % (2.0 * pi) - pi
    low, high = np.percentile(about, [LOWEST_PERCENT, HIGHEST_PERCENT])
    return centre + float(low), centre + float(high)
