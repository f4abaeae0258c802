"""One instant of the 3-D view as arrays, whether it comes from the live tick or from a recording."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from fusion.skeleton import JOINT_COUNT
from server.api.view3d_shapes import Array, as_array
from server.messages import ArmView, LiveTick, SensorView

NOWHERE = np.full((JOINT_COUNT, 3), np.nan, np.float32)
NO_ARM = np.full((4, 3), np.nan, np.float32)
NO_PLACE = np.full(3, np.nan, np.float32)


@dataclass(frozen=True, slots=True)
class SensorPicture:
    """What one sensor sees, and where it stands; NaN where that is not known. In the room, metres."""

    sensor: str
    joints: Array  # (25, 3)
    position: Array  # (3,)


@dataclass(frozen=True, slots=True)
class Picture:
    """Everything that is drawn. In the room, metres; NaN where something is missing."""

    sensors: tuple[SensorPicture, ...]
    body: Array  # (25, 3)
    mirrored: Array  # (4, 3) shoulder, elbow, wrist, hand
    exo: Array  # (4, 3)
    shape_m2: tuple[tuple[float, ...], ...] = ()
    """Per joint of the body (xx, xy, xz, yy, yz, zz) of the set that holds it; empty where it is not told."""


def picture_of(tick: LiveTick) -> Picture:
    """A tick as it is drawn."""
    return Picture(
        sensors=tuple(_sensor(view) for view in tick.sensors),
        body=NOWHERE if tick.body is None else as_array(tick.body.joints_in_room),
        mirrored=_arm(tick.target),
        exo=_arm(tick.affected),
        shape_m2=() if tick.body is None else tick.body.shape_m2,
    )


def _sensor(view: SensorView) -> SensorPicture:
    joints = as_array(view.joints_in_room) if view.joints_in_room else NOWHERE
    place = NO_PLACE if view.position_in_room is None else np.array(view.position_in_room, np.float32)
    return SensorPicture(view.sensor, joints, place)


def _arm(arm: ArmView | None) -> Array:
    return NO_ARM if arm is None or not arm.valid or arm.points_in_room is None else as_array(arm.points_in_room)
