"""Where a sensor stands and what its clock says, against the reference sensor."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cache

import numpy as np

from fusion.align.loops import turned
from fusion.messages import AlignedSample, Floats, SkeletonSample


@dataclass(frozen=True, slots=True)
class SensorAlignment:
    """Mounting and clock of one sensor: ``p_room = R p_sensor + T``, ``t_reference = t_sensor - offset``."""

    rotation_sensor_to_reference: Floats  # (3, 3)
    translation_m: Floats  # (3,)
    clock_offset_s: float
    residual_m: float
    """Median distance of the sensor's joints to the reference's."""
    frames: int
    """Frames seen by both that it rests on."""
    rotation_std_rad: float
    """One standard deviation of the rotation, all axes together."""
    position_std_m: float
    """One standard deviation of where it puts the body's middle."""

    def in_reference(self, positions_in_sensor: Floats) -> Floats:
        """Positions (..., 3) in the reference sensor's frame."""
        positions: Floats = positions_in_sensor @ self.rotation_sensor_to_reference.T + self.translation_m
        return positions

    def apply(self, sample: SkeletonSample, t_s: float) -> AlignedSample:
        """The sample in the room's frame, at `t_s` on the reference's clock."""
        return AlignedSample(
            sample.sensor,
            t_s,
            sample.t_received_s,
            turned(sample.positions_in_sensor, self.rotation_sensor_to_reference, self.translation_m),
            sample.state,
            self.translation_m,
            self.rotation_sensor_to_reference,
        )


@cache
def reference_alignment() -> SensorAlignment:
    """The reference sensor's alignment with itself."""
    return SensorAlignment(np.eye(3), np.zeros(3), 0.0, 0.0, 0, 0.0, 0.0)
