"""What a session leaves behind for its metrics: arrays over its ticks."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Final

import numpy as np
from numpy.typing import NDArray

from fusion.messages import Flags, Floats
from fusion.skeleton import Side

JOINTS: Final = ("plane", "elevation", "rotation", "elbow")
"""The columns of the angle arrays: the exoskeleton's joints, in its order."""
ENGAGED: Final = "engaged"
"""The state in which the exoskeleton follows the mirror."""


@dataclass(frozen=True, slots=True)
class SensorTrack:
    """One sensor over the session's ticks; NaN where it was not there."""

    name: str
    frames_per_s: Floats  # (T,)
    residual_m: Floats  # (T,) to the reference sensor after alignment
    age_s: Floats  # (T,) since its last frame


@dataclass(frozen=True, slots=True)
class SessionRecord:
    """A session's ticks as arrays, T of them, at any rate of 20 Hz or more, even or not."""

    t_s: Floats  # (T,) rising
    state: NDArray[np.str_]  # (T,) of the safety gate: off, ready, engaged, hold, fault, stopped
    healthy_side: Side
    healthy_rad: Floats  # (T, 4) plane, elevation, rotation (twist), elbow
    healthy_valid: Flags  # (T,)
    affected_rad: Floats  # (T, 4) as the exoskeleton measured them
    hand_in_trunk: Floats  # (T, 3) m, the healthy hand; NaN where unknown
    trunk_displacement_m: Floats  # (T,) of SpineShoulder since the session was enabled; NaN where unknown
    sensors: tuple[SensorTrack, ...]
    hits: int
    """Targets collected."""
    misses: int
    mode: str = "passive"
    """How the affected arm was moved: passive = by the exoskeleton alone."""

    @property
    def engaged(self) -> Flags:
        """(T,) whether the exoskeleton followed."""
        return np.asarray(self.state == ENGAGED)
