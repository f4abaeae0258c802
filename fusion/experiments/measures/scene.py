"""A recording made ready to be fused by hand: aligned once, its samples in order, its grid."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping, Sequence
from copy import deepcopy
from dataclasses import dataclass, replace
from typing import Final

import numpy as np

from fusion.align.alignment import SensorAlignment
from fusion.align.whole import align_streams
from fusion.errors import RecordingError
from fusion.messages import Floats, FusedFrame, SkeletonSample, States
from fusion.offline import GRID_HZ
from fusion.pipeline import Pipeline, PipelineSettings
from fusion.recording.recording import Recording, SkeletonStream
from fusion.skeleton import JOINT_COUNT, Side

WhatIf = Callable[[SkeletonSample, float], SkeletonSample | None]
"""What another course of things makes of a sample at an instant of the reference's clock; None = it never came."""
LONGEST_AGE_S: Final = 0.1


@dataclass(frozen=True, slots=True)
class Scene:
    """One person seen by aligned sensors."""

    name: str
    healthy_side: Side
    reference: str
    alignments: dict[str, SensorAlignment]
    t_s: Floats  # (T,) a 30 Hz grid on the reference's clock
    due: tuple[tuple[float, SkeletonSample], ...]
    """Samples of every aligned sensor by the reference's clock."""


@dataclass(frozen=True, slots=True)
class Told:
    """What a method told at some instants of the grid."""

    t_s: Floats  # (T,)
    positions: Floats  # (T, 25, 3) m; NaN before anything was seen
    bound_m: Floats  # (T, 25)
    state: States  # (T, 25)


def scene_of(recording: Recording, known: Mapping[str, SensorAlignment] | None = None) -> Scene:
    """Align the recording's sensors and put the samples of each one's most seen body in order.

    Args:
        recording: of at least two sensors.
        known: the alignments, where somebody knows them; else they are found from the whole recording.

    Raises:
        RecordingError: fewer than two sensors can be aligned.
    """
    streams = [stream for stream in recording.skeleton_streams if stream.samples]
    reference = next(stream for stream in streams if stream.primary)
    found = dict(known or align_streams(streams, reference.sensor).alignments)
    if len(found) < 2:
        raise RecordingError(f"recording '{recording.name}' has {len(found)} sensors that can be aligned", "two")
    due = [
        (sample.t_s - found[stream.sensor].clock_offset_s, sample)
        for stream in streams
        if stream.sensor in found
        for sample in _one_body(stream)
    ]
    first, last = reference.samples[0].t_s, reference.samples[-1].t_s
    grid = first + np.arange(int((last - first) * GRID_HZ + 1e-6) + 1) / GRID_HZ
    side = recording.healthy_side or Side.RIGHT
    return Scene(recording.name, side, reference.sensor, found, grid, tuple(sorted(due, key=lambda item: item[0])))


def only(scene: Scene, sensor: str) -> Scene:
    """The scene as this sensor alone sees it."""
    return replace(scene, due=tuple(item for item in scene.due if item[1].sensor == sensor))


def told(
    scene: Scene, method: str, forks: Sequence[tuple[int, WhatIf]] = (), length: int = 0
) -> tuple[Told, tuple[Told, ...]]:
    """Fuse the scene; beside it, what would have been told had things gone otherwise.

    Args:
        scene: what was seen.
        method: a name in `fusion.estimation.METHODS`.
        forks: the index in the grid from which on a what-if holds.
        length: for how many instants each is followed.

    Returns:
        The whole course (T instants), and one of `length` instants for every fork, in their order.
    """
    pipeline = Pipeline(PipelineSettings(scene.healthy_side, method, scene.reference, scene.alignments))
    first = next((s for _, s in scene.due if s.sensor == scene.reference), scene.due[0][1])
    pipeline.follow(first.sensor, first.body)
    rows: list[FusedFrame | None] = []
    others: dict[int, Told] = {}
    at = 0
    for k, t_s in enumerate(scene.t_s.tolist()):
        for i, (start, what_if) in enumerate(forks):
            if start == k:
                course = _course(deepcopy(pipeline), scene, at, scene.t_s[k : k + length], what_if)
                others[i] = _stacked(scene.t_s[k : k + length], list(course))
        at = _feed(pipeline, scene, at, t_s)
        rows.append(_body(pipeline, t_s))
    return _stacked(scene.t_s, rows), tuple(others[i] for i in range(len(forks)))


def seen_alone(scene: Scene, sensor: str) -> tuple[Floats, Floats]:
    """One sensor's latest sample at every instant of the grid, as somebody with this sensor alone would have it.

    Returns:
        Positions (T, 25, 3) m in the reference's frame, NaN where the sample is older than three frames; its age (T,).
    """
    own = [(t_s, sample) for t_s, sample in scene.due if sample.sensor == sensor]
    taken_s = np.array([t_s for t_s, _ in own])
    latest = np.searchsorted(taken_s, scene.t_s, side="right") - 1
    age_s = np.where(latest >= 0, scene.t_s - taken_s[latest], np.inf)
    positions = scene.alignments[sensor].in_reference(np.array([sample.positions_in_sensor for _, sample in own]))
    given = np.array([sample.state for _, sample in own]) > 0
    said = np.where(given[..., None], positions, np.nan)[latest]
    said[age_s > LONGEST_AGE_S] = np.nan
    return said, age_s


def _one_body(stream: SkeletonStream) -> list[SkeletonSample]:
    bodies = [sample.body for sample in stream.samples]
    most = max(sorted(set(bodies)), key=bodies.count)
    return [sample for sample in stream.samples if sample.body == most]


def _course(pipeline: Pipeline, scene: Scene, at: int, grid: Floats, what_if: WhatIf) -> Iterator[FusedFrame | None]:
    for t_s in grid.tolist():
        at = _feed(pipeline, scene, at, t_s, what_if)
        yield _body(pipeline, t_s)


def _feed(pipeline: Pipeline, scene: Scene, at: int, t_s: float, what_if: WhatIf | None = None) -> int:
    """Give the pipeline what is due from index `at` on; returns the next index."""
    while at < len(scene.due) and scene.due[at][0] <= t_s:
        due_s, sample = scene.due[at]
        taken = what_if(sample, due_s) if what_if else sample
        if taken is not None:
            pipeline.take(taken)
        at += 1
    return at


def _body(pipeline: Pipeline, t_s: float) -> FusedFrame | None:
    return pipeline.step(t_s).fused or pipeline.fused_at(t_s)


def _stacked(t_s: Floats, bodies: Sequence[FusedFrame | None]) -> Told:
    positions, bound_m = np.full((len(t_s), JOINT_COUNT, 3), np.nan), np.full((len(t_s), JOINT_COUNT), np.inf)
    state = np.zeros((len(t_s), JOINT_COUNT), dtype=np.uint8)
    for k, body in enumerate(bodies):
        if body is not None:
            positions[k], bound_m[k], state[k] = body.positions_in_room, body.bound_m, body.state
    return Told(t_s, positions, bound_m, state)
