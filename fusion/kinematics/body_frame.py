"""The trunk's frame, found from the shoulders and the spine."""

from __future__ import annotations

from typing import Final

import numpy as np

from fusion.messages import Floats, TrunkFrame
from fusion.skeleton import INDEX

SMALLEST_M: Final = 0.05
"""A shoulder line or spine shorter than this says nothing about a direction."""


def trunk_frame(positions_in_room: Floats) -> TrunkFrame | None:
    """The trunk frame of methods §1: x to the patient's right, y up the spine, z from chest to back.

    y is the spine; x is the shoulder line freed of its part along y; z = x × y, so that facing = y × (right − left).
    One missing shoulder is rebuilt from the other through SpineShoulder; with both gone the hips give the line.
    The frame follows the trunk, not the room, because patients lean and turn.

    Args:
        positions_in_room: (25, 3) m, NaN where a joint is missing.

    Returns:
        The frame, or None where the joints do not determine one.
    """
    joints = _Joints(positions_in_room)
    origin, line, spine = joints.origin(), joints.shoulder_line(), joints.spine()
    y = spine / np.linalg.norm(spine)
    across = line - (line @ y) * y
    width = float(np.linalg.norm(across))
    if np.isnan(origin).any() or not (width > SMALLEST_M and np.linalg.norm(spine) > SMALLEST_M):
        return None
    x = across / width
    return TrunkFrame(origin, np.column_stack([x, y, np.cross(x, y)]))


class _Joints:
    """Joints by name, each falling back on its neighbours; NaN where nothing helps."""

    def __init__(self, positions: Floats) -> None:
        self._positions = positions

    def at(self, name: str) -> Floats:
        place: Floats = self._positions[INDEX[name]]
        return place

    def shoulder_line(self) -> Floats:
        """From the left to the right shoulder, or hip."""
        return _first(
            self.at("ShoulderRight") - self.at("ShoulderLeft"),
            2.0 * (self.at("ShoulderRight") - self.at("SpineShoulder")),
            2.0 * (self.at("SpineShoulder") - self.at("ShoulderLeft")),
            self.at("HipRight") - self.at("HipLeft"),
        )

    def origin(self) -> Floats:
        """Mid-point of the shoulders."""
        return _first(0.5 * (self.at("ShoulderLeft") + self.at("ShoulderRight")), self.at("SpineShoulder"))

    def spine(self) -> Floats:
        """From the pelvis up; the long base first, because it is the steadier direction."""
        top = _first(self.at("SpineShoulder"), self.origin(), self.at("Neck"))
        pelvis = _first(self.at("SpineBase"), 0.5 * (self.at("HipLeft") + self.at("HipRight")), self.at("SpineMid"))
        return top - pelvis


def _first(*candidates: Floats) -> Floats:
    """The first candidate without a gap, else the last."""
    return next((c for c in candidates if not np.isnan(c).any()), candidates[-1])
