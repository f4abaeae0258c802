"""A whole tick as live: decoded samples of both sensors in, mirror target out, alignment learnt on the way."""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from heapq import merge
from time import perf_counter_ns
from typing import Final

import numpy as np

from fusion.benchmarks.rounds import Timing
from fusion.messages import SkeletonSample
from fusion.pipeline import Pipeline, PipelineSettings
from fusion.skeleton import Side
from fusion.virtual_patient.trial import virtual_recording

FRAMES_PER_S: Final = 30
SETTLING_S: Final = 4.0
"""Until alignment and lengths are known; these ticks are not counted."""


def tick(length_s: float, seed: int = 3) -> Timing:
    """Time of every tick that takes a sample of both sensors, in a recording of the virtual patient.

    A tick in which alignment is learnt anew (a few a second) counts as any other and shows in the 99th percentile.
    """
    recording = virtual_recording(seed, length_s, clock_offset_s=0.0)
    pipeline = Pipeline(PipelineSettings(Side.RIGHT))
    frames = [stream.samples for stream in recording.skeleton_streams]
    spent = np.array([_spent_us(pipeline, ready) for ready in _ticks(merge(*frames, key=lambda s: s.t_received_s))])
    return Timing(spent[round(SETTLING_S * FRAMES_PER_S) :])


def _ticks(samples: Iterable[SkeletonSample]) -> Iterator[list[SkeletonSample]]:
    """Samples as they came, cut where the second sensor's is in; a tick in which one dropped its frame is left out."""
    waiting: list[SkeletonSample] = []
    for sample in samples:
        if waiting and sample.sensor != waiting[-1].sensor:
            yield [waiting[-1], sample]
            waiting = []
        else:
            waiting = [sample]


def _spent_us(pipeline: Pipeline, pair: list[SkeletonSample]) -> float:
    began = perf_counter_ns()
    for sample in pair:
        pipeline.take(sample)
    pipeline.step(max(sample.t_received_s for sample in pair))
    return (perf_counter_ns() - began) / 1e3
