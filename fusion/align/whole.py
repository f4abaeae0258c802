"""Alignment of every stream of a whole recording against the reference's."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, field
from itertools import product
from typing import Protocol

import numpy as np

from fusion.align.alignment import SensorAlignment, reference_alignment
from fusion.align.plausible import Fault, feet_fault, handedness_fault, unit_fault
from fusion.align.space_time import COARSE_FRAMES, FEWEST_FRAMES, fit_space_time
from fusion.align.track import BodyTrack, pair
from fusion.messages import SkeletonSample

JUDGED_FRAMES = 90
FAULTS_TOLD_BY = 300
"""Frames, evenly, that show whether a sender can be right."""


class Stream(Protocol):
    """What is needed of a recorded stream."""

    @property
    def sensor(self) -> str:
        """The sensor's name."""
        ...

    @property
    def samples(self) -> tuple[SkeletonSample, ...]:
        """Everything it saw, in time order."""
        ...


@dataclass(frozen=True, slots=True)
class Aligned:
    """What a whole recording says of its sensors."""

    alignments: dict[str, SensorAlignment] = field(default_factory=dict)
    """By sensor, the reference included; a sensor that shares no body with the reference is missing."""
    faults: dict[str, tuple[str, ...]] = field(default_factory=dict)
    """Why a sensor must not be used."""


def align_streams(streams: Sequence[Stream], reference: str) -> Aligned:
    """Align every stream with the reference's.

    Where several people were seen, every body of one sensor is held against every body of the other; the pair that
    agrees best tells where the sensor stands, as all bodies share its mounting.

    Args:
        streams: one per sensor.
        reference: the reference's name.
    """
    bodies = {stream.sensor: _bodies(stream) for stream in streams}
    result = Aligned({reference: reference_alignment()}, {})
    for sensor, tracks in bodies.items():
        fault = _own_fault(tracks)
        found, pairing_fault = _best(bodies[reference], tracks) if sensor != reference else (None, None)
        if fault or pairing_fault:
            result.faults[sensor] = (f"{sensor}: {fault or pairing_fault}",)
        elif found is not None:
            result.alignments[sensor] = found
    return result


def _bodies(stream: Stream) -> list[BodyTrack]:
    """A track for every body seen long enough."""
    by_body: dict[str, list[SkeletonSample]] = {}
    for sample in stream.samples:
        by_body.setdefault(sample.body, []).append(sample)
    return [BodyTrack.of(samples) for samples in by_body.values() if len(samples) >= FEWEST_FRAMES]


def _own_fault(tracks: list[BodyTrack]) -> Fault | None:
    few = (track.thinned(FAULTS_TOLD_BY) for track in tracks)
    found = (unit_fault(track.positions, track.state) or feet_fault(track) for track in few)
    return next((fault for fault in found if fault is not None), None)


def _best(references: list[BodyTrack], tracks: list[BodyTrack]) -> tuple[SensorAlignment | None, Fault | None]:
    """The alignment of the pair of bodies that agrees best, and what is wrong with that pair's handedness."""
    candidates = list(product(references, tracks))
    chosen = candidates[0] if len(candidates) == 1 else min(candidates, key=_unlikeness, default=None)
    found = fit_space_time(*chosen) if chosen else None
    if chosen is None or found is None:
        return None, None
    return found, handedness_fault(pair(*chosen, found.clock_offset_s, JUDGED_FRAMES))


def _unlikeness(bodies: tuple[BodyTrack, BodyTrack]) -> float:
    """How badly two bodies agree at a first look; fewer common frames make a small residual less telling."""
    found = fit_space_time(*bodies, most=COARSE_FRAMES)
    return np.inf if found is None else found.residual_m / float(np.sqrt(found.frames))
