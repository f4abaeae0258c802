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
PASSIVE: Final = "passive"
LONGEST_TICK_S: Final = 0.5
"""A longer hole between ticks is time about which nothing is known, and counts for no state."""
SENDS_HZ: Final = 5.0
"""A sensor that sent fewer frames on average took no part."""
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
class DriveTrack:
    """The drive, and the affected arm in it, over the session's ticks; joints in the columns."""

    velocity_rad_s: Floats  # (T, 4) measured
    torque_nm: Floats  # (T, 4) of the drive, with what carries the arm
    interaction_nm: Floats  # (T, 4) of the arm beyond its expected weight and inertia, + towards larger angles
    share: Floats  # (T, 4) 0..1 of the drive's stiffness that helps
    assistance: NDArray[np.str_]  # (T,) passive, assisted, free
    level: Floats  # (T,) 0..1, the most help while assisted

    @property
    def measures_interaction(self) -> bool:
        """Whether the drive tells what the arm does; one that cannot gives nothing but zeros."""
        return bool(self.interaction_nm.any())


@dataclass(frozen=True, slots=True)
class Attempt:
    """One attempt in a game that succeeded or failed; None where nothing is known. The shown hand's figures."""

    game: str
    success: bool
    level: float
    """0..1, how hard it was."""
    duration_s: float
    """From the moment it was shown to its end."""
    reaction_s: float | None = None
    """From the moment it was shown until the hand set out."""
    movement_s: float | None = None
    """From there to the end."""
    path_ratio: float | None = None
    error_m: float | None = None
    """Distance from the ideal, as the game defines it."""
    hold_m: float | None = None
    """Root mean square of the hand about its mean while it was to be still."""


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
    pain_calls: int = 0
    """How often somebody said that it hurts."""
    drive: DriveTrack | None = None
    """None in recordings from before it was told: the exoskeleton alone moved the arm."""
    shoulder_hitch_m: Floats | None = None
    """(T,) rise of the healthy shoulder since the session was enabled; None in recordings from before it was told."""
    attempts: tuple[Attempt, ...] = ()
    """Of all games, in order; none in recordings from before they were logged."""

    @property
    def engaged(self) -> Flags:
        """(T,) whether the exoskeleton followed."""
        return np.asarray(self.state == ENGAGED)

    @property
    def spans_s(self) -> Floats:
        """(T,) how long each tick's state lasted; of the last one, and of one before a hole, nothing is known."""
        spans = np.diff(self.t_s, append=self.t_s[-1:])
        return np.where(spans <= LONGEST_TICK_S, spans, 0.0)

    @property
    def sees_with_one(self) -> bool:
        """Whether one sensor alone sent anything to speak of."""
        return sum(bool(np.nan_to_num(one.frames_per_s).mean() >= SENDS_HZ) for one in self.sensors) == 1

    @property
    def is_driven(self) -> bool:
        """Whether the exoskeleton alone moved the arm in some part of the session."""
        return self.drive is None or bool((self.engaged & (self.drive.assistance == PASSIVE)).any())
