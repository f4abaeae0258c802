"""What the affected arm did itself: its own torque, range and work beside the drive's, so that recovery shows."""

from __future__ import annotations

from typing import Final

import numpy as np

from fusion.messages import Flags, Floats
from fusion.metrics.metric import CARRIED_WEIGHT, ESTIMATED_TORQUE, Metric
from fusion.metrics.range_of_movement import ENOUGH, RangeNames, joint_range, told
from fusion.metrics.record import JOINTS, DriveTrack, SessionRecord
from fusion.metrics.uncertainty import batch_sem

MOVING_RAD_S: Final = 0.05
"""A slower joint has no direction that an effort could go along with."""
PEAK_PERCENT: Final = 95.0
MODES: Final = ("passive", "assisted", "free")
FREE: Final = "free"
OWN_RANGE: Final[RangeNames] = ("own_range_lowest", "own_range_highest", "own_range")
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
        found += joint_range(OWN_RANGE, sample, joint, record.healthy_side.other, None)
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
        side = record.healthy_side.other
        found += [
            Metric(name, of(along_nm), "N m", joint, side, ESTIMATED_TORQUE, batch_sem(along_nm, of))
            for name, of in (("own_effort", _mean), ("own_effort_p95", _peak))
        ]
    return found


def _mean(sample: Floats) -> float:
    return float(sample.mean())


def _peak(sample: Floats) -> float:
    return float(np.percentile(sample, PEAK_PERCENT))


def _work(record: SessionRecord, drive: DriveTrack) -> list[Metric]:
    """Positive work of arm and drive, all joints together, and the arm's part of it."""
    works_j = np.column_stack(
        [_positive_work_j(record, torque, drive.velocity_rad_s) for torque in (drive.interaction_nm, drive.torque_nm)]
    )  # (T, 2)
    own_j, drive_j = works_j.sum(axis=0).tolist()
    side = record.healthy_side.other
    found = [
        Metric("own_work", own_j, "J", side=side, caveat_key=ESTIMATED_TORQUE),
        Metric("drive_work", drive_j, "J", caveat_key=CARRIED_WEIGHT),
    ]
    share = _own_share(works_j)
    if share is not None:
        sem = batch_sem(works_j[record.engaged], _own_share)
        found.append(Metric("own_work_share", share, "1", side=side, caveat_key=CARRIED_WEIGHT, sem=sem))
    return found


def _own_share(works_j: Floats) -> float | None:
    """Of (N, 2) work of the arm and of the drive."""
    own_j, drive_j = works_j.sum(axis=0).tolist()
    return own_j / (own_j + drive_j) if own_j + drive_j > 0.0 else None


def _positive_work_j(record: SessionRecord, torque_nm: Floats, velocity_rad_s: Floats) -> Floats:
    """(T,) per tick."""
    power_w = np.maximum(torque_nm * velocity_rad_s, 0.0).sum(axis=1)
    work_j: Floats = power_w * np.where(record.engaged, record.spans_s, 0.0)
    return work_j


def soft_holds(record: SessionRecord, drive: DriveTrack) -> int:
    """How often the arm was held softly, for resistance or pain."""
    soft: Flags = (record.state == "hold") & (drive.share.max(axis=1) < 1.0)
    edges = np.flatnonzero(np.diff(np.concatenate([[0], soft.astype(int), [0]])))
    starts, ends = edges[::2], edges[1::2]
    return int(np.count_nonzero(record.t_s[ends - 1] - record.t_s[starts] >= SOFT_HOLD_S))
