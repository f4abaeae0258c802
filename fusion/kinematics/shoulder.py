"""How high a shoulder stands above the pelvis, without what raising the arm brings with it."""

from __future__ import annotations

from math import exp, isfinite
from typing import Final

import numpy as np

from fusion.kinematics.body_frame import PELVIS
from fusion.messages import Floats, TrunkFrame
from fusion.skeleton import Side, arm

NATURAL_RISE_M: Final = 0.03
"""A shoulder that nobody hitches rises with its arm by this × (1 − cos elevation): the least-squares fit over the true
motions of seven recordings (docs/metrics.md)."""

SMOOTHED_S: Final = 0.3
"""Time constant: a hitch lasts as long as a reach, the sensors' noise mostly shorter."""


def smoothed_m(before_m: float, seen_m: float, dt_s: float) -> float:
    """A height after another one was seen; NaN says nothing, on either side."""
    if not isfinite(seen_m):
        return before_m
    return before_m + (1.0 - exp(-dt_s / SMOOTHED_S)) * (seen_m - before_m) if isfinite(before_m) else seen_m


def shoulder_height_m(positions_in_room: Floats, trunk: TrunkFrame, side: Side) -> float:
    """Along the spine, so that leaning changes nothing; only its changes mean something. NaN where a joint is missing.

    Args:
        positions_in_room: (25, 3) m.
        trunk: of the same body.
        side: of the shoulder.
    """
    up = trunk.rotation_trunk_to_room[:, 1]
    shoulder, elbow = positions_in_room[list(arm(side)[:2])]
    upper_arm = elbow - shoulder
    hanging = float(-upper_arm @ up / max(float(np.linalg.norm(upper_arm)), 1e-6))  # cosine of the elevation
    return float((shoulder - positions_in_room[PELVIS]) @ up) - NATURAL_RISE_M * (1.0 - hanging)
