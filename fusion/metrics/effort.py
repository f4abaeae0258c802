"""What the affected arm did itself: its own torque, range and work beside the drive's, so that recovery shows."""

from __future__ import annotations

from typing import Final

import numpy as np

from fusion.messages import Flags, Floats
from fusion.metrics.metric import CARRIED_WEIGHT, ESTIMATED_TORQUE, Metric
from fusion.metrics.range_of_movement import ENOUGH, angle_range, told
from fusion.metrics.record import JOINTS, DriveTrack, SessionRecord

MOVING_RAD_S: Final = 0.05
"""A slower joint has no direction that an effort could go along with."""
PEAK_PERCENT: Final = 95.0
MODES: Final = ("passive", "assisted", "free")
FREE: Final = "free"
SOFT_HOLD_S: Final = 0.5
"""A hold that has not become firm by then is meant to be soft."""


def effort_metrics(record: SessionRecord) -> list[Metric]:
    """Own effort, range and work, help and soft holds; nothing from recordings that do not tell them."""
    drive = record.drive
    if drive is None:
        return []
    return [
        *_minutes(record, drive),
        *_help(record, drive),
        *_own_range(record, drive),
        *(_own_effort(record, drive) if drive.measures_interaction else ()),
        *(_work(record, drive) if drive.measures_interaction else ()),
        Metric("soft_holds", float(soft_holds(record, drive)), "1"),
        Metric("pain_calls", float(record.pain_calls), "1"),
    ]


def _minutes(record: SessionRecord, drive: DriveTrack) -> list[Metric]:
    """Time engaged in each way of helping that occurred."""
    spans_s = np.where(record.engaged, record.spans_s, 0.0)
    times = [(mode, float(spans_s[drive.assistance == mode].sum())) for mode in MODES]
    return [Metric(f"minutes_{mode}", seconds / 60.0, "min") for mode, seconds in times if seconds > 0.0]


def _help(record: SessionRecord, drive: DriveTrack) -> list[Metric]:
    """Mean share of the drive's stiffness while engaged, and the mean of the most that was allowed while assisted."""
    assisted = record.engaged & (drive.assistance == "assisted")
    found = [("help", drive.share[record.engaged]), ("help_allowed", drive.level[assisted])]
    side = record.healthy_side.other
    return [Metric(name, float(values.mean()), "1", side=side) for name, values in found if values.size]


def _own_range(record: SessionRecord, drive: DriveTrack) -> list[Metric]:
    """The range that the arm reached while the drive only carried its weight."""
    free = record.engaged & (drive.assistance == FREE)
    found: list[Metric] = []
    for column, joint in enumerate(JOINTS):
        sample = record.affected_rad[free & told(record.affected_rad, joint), column]
        if len(sample) < ENOUGH:
            continue
        low, high = angle_range(sample)
        named = (("own_range_lowest", low), ("own_range_highest", high), ("own_range", high - low))
        found += [Metric(name, value, "rad", joint, record.healthy_side.other) for name, value in named]
    return found


def _own_effort(record: SessionRecord, drive: DriveTrack) -> list[Metric]:
    """Mean and 95th percentile of the arm's torque in the direction in which the joint moves."""
    found: list[Metric] = []
    for column, joint in enumerate(JOINTS):
        speed = drive.velocity_rad_s[:, column]
        moving = record.engaged & (np.abs(speed) >= MOVING_RAD_S)
        if np.count_nonzero(moving) < ENOUGH:
            continue
        along_nm = np.maximum(drive.interaction_nm[moving, column] * np.sign(speed[moving]), 0.0)
        named = (("own_effort", along_nm.mean()), ("own_effort_p95", np.percentile(along_nm, PEAK_PERCENT)))
        side = record.healthy_side.other
        found += [Metric(name, float(value), "N m", joint, side, ESTIMATED_TORQUE) for name, value in named]
    return found


def _work(record: SessionRecord, drive: DriveTrack) -> list[Metric]:
    """Positive work of arm and drive, all joints together, and the arm's part of it."""
    own_j = _positive_work_j(record, drive.interaction_nm, drive.velocity_rad_s)
    drive_j = _positive_work_j(record, drive.torque_nm, drive.velocity_rad_s)
    side = record.healthy_side.other
    found = [
        Metric("own_work", own_j, "J", side=side, caveat_key=ESTIMATED_TORQUE),
        Metric("drive_work", drive_j, "J", caveat_key=CARRIED_WEIGHT),
    ]
    if own_j + drive_j > 0.0:
        found.append(Metric("own_work_share", own_j / (own_j + drive_j), "1", side=side, caveat_key=CARRIED_WEIGHT))
    return found


def _positive_work_j(record: SessionRecord, torque_nm: Floats, velocity_rad_s: Floats) -> float:
    power_w = np.maximum(torque_nm * velocity_rad_s, 0.0).sum(axis=1)
    return float((power_w * np.where(record.engaged, record.spans_s, 0.0)).sum())


def soft_holds(record: SessionRecord, drive: DriveTrack) -> int:
    """How often the arm was held softly, for resistance or pain."""
    soft: Flags = (record.state == "hold") & (drive.share.max(axis=1) < 1.0)
    edges = np.flatnonzero(np.diff(np.concatenate([[0], soft.astype(int), [0]])))
    starts, ends = edges[::2], edges[1::2]
    return int(np.count_nonzero(record.t_s[ends - 1] - record.t_s[starts] >= SOFT_HOLD_S))
