"""The trunk's frame, found from the shoulders and the spine."""

from __future__ import annotations

from math import isnan
from typing import Final

import numpy as np

from fusion.compiled import kernel
from fusion.kinematics.vectors import Vector, between, cross, dot, known_or, length, row, step, sum_of, unit
from fusion.messages import Floats, TrunkFrame
from fusion.skeleton import INDEX

SMALLEST_M: Final = 0.05
"""A shoulder line or spine shorter than this says nothing about a direction."""
PELVIS, SPINE, NECK, TOP = (INDEX[name] for name in ("SpineBase", "SpineMid", "Neck", "SpineShoulder"))
SHOULDER_LEFT, SHOULDER_RIGHT = INDEX["ShoulderLeft"], INDEX["ShoulderRight"]
HIP_LEFT, HIP_RIGHT = INDEX["HipLeft"], INDEX["HipRight"]


def trunk_frame(positions_in_room: Floats) -> TrunkFrame | None:
    """The trunk frame [Du2016 §1.2]: x to the patient's right, y up the spine, z from chest to back.

    y is the spine; x is the shoulder line freed of its part along y; z = x × y, so that facing = y × (right − left).
    One missing shoulder is rebuilt from the other through SpineShoulder; with both gone the hips give the line.
    The frame follows the trunk, not the room, because patients lean and turn.

    Args:
        positions_in_room: (25, 3) m, NaN where a joint is missing.

    Returns:
        The frame, or None where the joints do not determine one.
    """
    origin, rotation = np.empty(3), np.empty((3, 3))
    return TrunkFrame(origin, rotation) if _found(positions_in_room, origin, rotation) else None


@kernel
def _found(positions: Floats, origin: Floats, rotation: Floats) -> bool:
    """Write the frame; False where there is none."""
    middle, line, spine = _middle(positions), _shoulder_line(positions), _spine(positions)
    y = unit(spine)
    across = sum_of(line, y, -dot(line, y))
    if isnan(dot(middle, middle)) or not (length(across) > SMALLEST_M and length(spine) > SMALLEST_M):
        return False
    x = unit(across)
    z = cross(x, y)
    for k in range(3):
        origin[k], rotation[k, 0], rotation[k, 1], rotation[k, 2] = middle[k], x[k], y[k], z[k]
    return True


@kernel
def _shoulder_line(positions: Floats) -> Vector:
    """From the left to the right shoulder; else twice one half of it; else from hip to hip."""
    whole, hips = step(positions, SHOULDER_LEFT, SHOULDER_RIGHT, 1.0), step(positions, HIP_LEFT, HIP_RIGHT, 1.0)
    right, left = step(positions, TOP, SHOULDER_RIGHT, 2.0), step(positions, SHOULDER_LEFT, TOP, 2.0)
    return known_or(whole, known_or(right, known_or(left, hips)))


@kernel
def _middle(positions: Floats) -> Vector:
    """Mid-point of the shoulders, or the spine between them."""
    return known_or(between(positions, SHOULDER_LEFT, SHOULDER_RIGHT), row(positions, TOP))


@kernel
def _spine(positions: Floats) -> Vector:
    """From the pelvis up; the long base first, because it is the steadier direction."""
    top = known_or(row(positions, TOP), known_or(_middle(positions), row(positions, NECK)))
    hips = between(positions, HIP_LEFT, HIP_RIGHT)
    pelvis = known_or(row(positions, PELVIS), known_or(hips, row(positions, SPINE)))
    return sum_of(top, pelvis, -1.0)
