"""Where the healthy arm was told to be, where it was, and when trouble was planted."""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass
from typing import Protocol

import numpy as np

from fusion.align.alignment import SensorAlignment
from fusion.errors import RecordingError
from fusion.evaluation.runs import SETTLE_S
from fusion.evaluation.scores import truth_at
from fusion.messages import Flags, Floats
from fusion.recording.recording import Recording, SkeletonStream, Trouble
from fusion.skeleton import Side, TrackingState, arm


@dataclass(frozen=True, slots=True)
class ArmErrors:
    """Shoulder, elbow and wrist of the healthy arm at T instants after the first two seconds, reference's frame."""

    t_s: Floats  # (T,)
    told: Floats  # (T, 3, 3) m
    truth: Floats  # (T, 3, 3) m
    bound_m: Floats  # (T, 3)
    clear: Flags  # (T,) no trouble was planted here

    @property
    def distance_m(self) -> Floats:
        """(T, 3) m from the told to the true joint."""
        distance: Floats = np.linalg.norm(self.told - self.truth, axis=2)
        return distance


class Course(Protocol):
    """What a method told over T instants of the reference's clock."""

    @property
    def t_s(self) -> Floats:
        """(T,)."""
        ...

    @property
    def positions(self) -> Floats:
        """(T, 25, 3) m."""
        ...

    @property
    def bound_m(self) -> Floats:
        """(T, 25)."""
        ...


def arm_errors(recording: Recording, fused: Course) -> ArmErrors:
    """Compare what was told of a recording with its truth.

    Raises:
        RecordingError: there is no truth.
    """
    if recording.truth is None:
        raise RecordingError(f"recording '{recording.name}' has no truth", "a stream of kind 'truth'")
    joints = list(arm(recording.healthy_side or Side.RIGHT)[:3])
    truth = truth_at(recording.truth, fused.t_s)[:, joints]
    judged = (fused.t_s >= fused.t_s[0] + SETTLE_S) & np.isfinite(truth).all(axis=(1, 2))
    clear = ~during(recording.events, fused.t_s)
    return ArmErrors(
        fused.t_s[judged],
        fused.positions[judged][:, joints],
        truth[judged],
        fused.bound_m[judged][:, joints],
        clear[judged],
    )


def during(events: Iterable[Trouble], t_s: Floats) -> Flags:
    """(T,) whether any event holds at an instant; both on the reference's clock."""
    inside = np.zeros(len(t_s), dtype=np.bool_)
    for event in events:
        inside |= (t_s >= event.from_s) & (t_s <= event.to_s)
    return inside


def sensor_errors(recording: Recording, stream: SkeletonStream, alignment: SensorAlignment) -> tuple[Floats, Floats]:
    """What a sensor said of the healthy arm where it tracked it and no trouble was planted, and the truth.

    Returns:
        Two of (N, 3) m, in that sensor's own frame.
    """
    if recording.truth is None or recording.healthy_side is None:
        raise RecordingError(f"recording '{recording.name}' has no truth", "a stream of kind 'truth'")
    joints = list(arm(recording.healthy_side)[:3])
    t_s = np.array([sample.t_s for sample in stream.samples]) - alignment.clock_offset_s
    said = np.array([sample.positions_in_sensor[joints] for sample in stream.samples])
    tracked = np.array([sample.state[joints] for sample in stream.samples]) == TrackingState.TRACKED
    truth = truth_at(recording.truth, t_s)[:, joints]
    in_sensor = (truth - alignment.translation_m) @ alignment.rotation_sensor_to_reference
    own = [event for event in recording.events if event.sensor == stream.sensor]
    used = tracked & ~during(own, t_s)[:, None] & (t_s >= t_s[0] + SETTLE_S)[:, None]
    return said[used], in_sensor[used]
