"""Alignment of every stream of a whole recording against the reference's."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, field
from itertools import product
from typing import Protocol

import numpy as np

from fusion.align.alignment import SensorAlignment, reference_alignment
from fusion.align.plausible import Fault, feet_fault, handedness_fault, unit_fault
from fusion.align.space_time import FEWEST_FRAMES, fit_space_time
from fusion.align.track import BodyTrack, pair
from fusion.messages import SkeletonSample

JUDGED_FRAMES = 90


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
    found = (unit_fault(track.positions, track.state) or feet_fault(track) for track in tracks)
    return next((fault for fault in found if fault is not None), None)


def _best(references: list[BodyTrack], tracks: list[BodyTrack]) -> tuple[SensorAlignment | None, Fault | None]:
    """The alignment of the pair of bodies that agrees best, and what is wrong with that pair's handedness."""
    tried = [(fit_space_time(a, b), a, b) for a, b in product(references, tracks)]
    able = [(found, a, b) for found, a, b in tried if found is not None]
    if not able:
        return None, None
    found, a, b = min(able, key=lambda one: one[0].residual_m / float(np.sqrt(one[0].frames)))
    return found, handedness_fault(pair(a, b, found.clock_offset_s, JUDGED_FRAMES))
