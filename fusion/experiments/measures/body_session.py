"""A body's course as if it were a session: what its joints alone say, measured in the very way of a session."""

from __future__ import annotations

from itertools import accumulate
from math import nan
from typing import Final

import numpy as np

from fusion.evaluation.angle_scores import true_angles
from fusion.evaluation.runs import SETTLE_S
from fusion.kinematics.angles import swing_from_direction
from fusion.kinematics.body_frame import TOP, trunk_frame
from fusion.kinematics.shoulder import shoulder_height_m, smoothed_m
from fusion.messages import Floats
from fusion.metrics.record import ENGAGED, JOINTS, SessionRecord
from fusion.skeleton import Side, arm

DRIVE_LAG_S: Final = 0.15
"""The affected arm does what the healthy one truly did so long before: a drive without fault."""
Row = tuple[float, ...]
UNKNOWN: Final[Row] = (nan,) * (len(JOINTS) + 3 + 1)


def body_session(t_s: Floats, positions: Floats, affected_rad: Floats, side: Side) -> SessionRecord:
    """A session that was engaged from the third second on.

    The hand is the wrist, since the recordings' truth knows no hand.

    Args:
        t_s: (T,) rising.
        positions: (T, 25, 3) m.
        affected_rad: (T, 4) the other arm.
        side: of the healthy arm.
    """
    rows = np.array([_row(joints, side) for joints in positions])
    first = int(np.searchsorted(t_s, t_s[0] + SETTLE_S))
    height_m, top = _smoothed(t_s, rows[:, -1]), positions[:, TOP]
    return SessionRecord(
        t_s=t_s[first:],
        state=np.full(len(t_s) - first, ENGAGED),
        healthy_side=side,
        healthy_rad=rows[first:, : len(JOINTS)],
        healthy_valid=np.isfinite(rows[first:]).all(axis=1),
        affected_rad=affected_rad[first:],
        hand_in_trunk=rows[first:, len(JOINTS) : len(JOINTS) + 3],
        trunk_displacement_m=np.linalg.norm(top[first:] - top[first], axis=1),
        sensors=(),
        hits=0,
        misses=0,
        shoulder_hitch_m=height_m[first:] - height_m[first],
    )


def angles_rad(positions: Floats, side: Side) -> Floats:
    """(T, 4) of an arm; NaN where it is not known."""
    return np.array([_row(joints, side)[: len(JOINTS)] for joints in positions])


def delayed(t_s: Floats, angles: Floats) -> Floats:
    """(T, 4) what a drive without fault does with angles."""
    return np.column_stack([np.interp(t_s - DRIVE_LAG_S, t_s, column) for column in angles.T])


def _smoothed(t_s: Floats, height_m: Floats) -> Floats:
    steps = zip(np.diff(t_s, prepend=t_s[0]), height_m, strict=True)
    told = accumulate(steps, lambda before, step: smoothed_m(before, step[1], step[0]), initial=nan)
    return np.array(list(told)[1:])


def _row(joints: Floats, side: Side) -> Row:
    """Plane, elevation, rotation and elbow, the wrist in the trunk, and the shoulder's height."""
    trunk, angles = trunk_frame(joints), true_angles(joints, side)
    if trunk is None or angles is None:
        return UNKNOWN
    plane, elevation = swing_from_direction(angles.direction_in_limb)
    wrist = (joints[arm(side)[2]] - trunk.origin_in_room) @ trunk.rotation_trunk_to_room
    pose = (plane, elevation, angles.twist_rad, angles.elbow_flexion_rad)
    return (*pose, *wrist.tolist(), shoulder_height_m(joints, trunk, side))
