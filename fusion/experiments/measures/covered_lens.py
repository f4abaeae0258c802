"""A recording in which somebody holds a hand before a sensor's lens: the skeleton it goes on to tell is nonsense."""

from __future__ import annotations

from dataclasses import replace
from typing import Final

import numpy as np

from fusion.messages import SkeletonSample
from fusion.recording.recording import Recording, SkeletonStream, Trouble
from fusion.skeleton import JOINT_COUNT, JOINTS, TrackingState

WANDERS_M: Final = 0.4
"""How far such a joint is carried off, each its own way, within a second [Du2016, Fig. 16]."""
WANDERING: Final = np.array([name.startswith(("Elbow", "Wrist", "Hand", "Thumb")) for name in JOINTS])


def covered(recording: Recording, events: tuple[Trouble, ...], seed: int) -> Recording:
    """The recording with the lens of each event's sensor covered meanwhile.

    The covered sensor goes on telling a body where it last saw it, inferred; elbows, wrists and hands wander off.

    Args:
        recording: whose clocks agree.
        events: when which lens is covered.
        seed: of the wandering.
    """
    rng = np.random.default_rng(seed)
    streams = list(recording.skeleton_streams)
    for event in events:
        away = rng.normal(size=(JOINT_COUNT, 3))
        away *= (WANDERING * WANDERS_M / np.linalg.norm(away, axis=1))[:, None]
        streams = [_covered(stream, event, away) if stream.sensor == event.sensor else stream for stream in streams]
    return replace(recording, skeleton_streams=tuple(streams), events=(*recording.events, *events))


def _covered(stream: SkeletonStream, event: Trouble, away: np.ndarray) -> SkeletonStream:
    last = next(s for s in reversed(stream.samples) if s.t_s < event.from_s)

    def told(sample: SkeletonSample) -> SkeletonSample:
        if not event.from_s <= sample.t_s <= event.to_s:
            return sample
        share = np.sin(np.pi / 2 * np.clip(sample.t_s - event.from_s, 0, 1))
        inferred = np.where(last.state == TrackingState.LOST, TrackingState.LOST, TrackingState.INFERRED)
        positions = last.positions_in_sensor + share * away
        return replace(sample, positions_in_sensor=positions, state=inferred.astype(np.uint8))

    return replace(stream, samples=tuple(told(sample) for sample in stream.samples))
