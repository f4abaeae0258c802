"""What a filter reaches that is told which measurements are wrong: the truth itself does the gating."""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from fusion.align.alignment import SensorAlignment
from fusion.align.whole import align_streams
from fusion.errors import RecordingError
from fusion.evaluation.scores import truth_at
from fusion.messages import Floats, SkeletonSample
from fusion.recording.recording import Recording, SkeletonStream, TruthStream
from fusion.skeleton import TrackingState


def without_wrong_joints(recording: Recording, limit_m: float) -> Recording:
    """The recording in which every joint that is further from the truth than `limit_m` is lost.

    Raises:
        RecordingError: there is no truth.
    """
    if recording.truth is None:
        raise RecordingError(f"recording '{recording.name}' has no truth", "a stream of kind 'truth'")
    truth = recording.truth
    primary = next(stream.sensor for stream in recording.skeleton_streams if stream.primary)
    alignments = align_streams(recording.skeleton_streams, primary).alignments
    streams = tuple(_told(stream, alignments[stream.sensor], truth, limit_m) for stream in recording.skeleton_streams)
    return replace(recording, skeleton_streams=streams)


def _told(stream: SkeletonStream, alignment: SensorAlignment, truth: TruthStream, limit_m: float) -> SkeletonStream:
    t_s = np.array([sample.t_s for sample in stream.samples]) - alignment.clock_offset_s
    true = truth_at(truth, t_s)
    samples = (
        _without(sample, alignment.in_reference(sample.positions_in_sensor), at, limit_m)
        for sample, at in zip(stream.samples, true, strict=True)
    )
    return replace(stream, samples=tuple(samples))


def _without(sample: SkeletonSample, positions: Floats, truth: Floats, limit_m: float) -> SkeletonSample:
    wrong = np.linalg.norm(positions - truth, axis=1) > limit_m  # unknown truth: not wrong
    if not wrong.any():
        return sample
    return replace(sample, state=np.where(wrong, TrackingState.LOST, sample.state).astype(np.uint8))
