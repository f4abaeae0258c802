"""A whole recording through the very same pipeline as live, as fast as it goes.

Alignment and clock offsets come first, from the whole recording; then the samples are taken in time order and the body
is told causally on a steady grid. `causal` shows what happened live instead: samples as they came, alignment learnt on
the way.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping
from dataclasses import dataclass, field, replace
from time import perf_counter

import numpy as np

from fusion.align.alignment import SensorAlignment
from fusion.align.bodies import trunk_centre
from fusion.align.whole import Aligned, align_streams
from fusion.arrival import Due, as_if_equally_quick, as_received, when_taken
from fusion.errors import InputError, RecordingError
from fusion.joined.evidence import Evidence
from fusion.messages import Floats, FusedFrame, JointAngles, MirrorTarget, SkeletonSample, States
from fusion.pipeline import Pipeline, PipelineSettings
from fusion.recording.recording import Recording, SkeletonStream
from fusion.skeleton import JOINT_COUNT, Side

GRID_HZ = 30.0
JOINING = "set-membership"
"""The method that other sensors than cameras are joined with; the papers' know cameras only."""
START_S = 0.3
Progress = Callable[[float], None]
"""Told the share done, 0 to 1."""


@dataclass(frozen=True, slots=True)
class SensorReport:
    """What became of one sensor."""

    sensor: str
    is_reference: bool
    alignment: SensorAlignment | None
    """None where it could not be aligned."""
    frames: int
    refusals: dict[str, int]
    """Frames or joints not used, by reason."""
    warnings: tuple[str, ...]


@dataclass(frozen=True, slots=True)
class OtherSensors:
    """What became of inertial sensors and of a tag."""

    used: tuple[str, ...] = ()
    """Sites and tags."""
    unusable: Mapping[str, str] = field(default_factory=dict)
    """By site or tag, with the reason."""


@dataclass(frozen=True, slots=True)
class Timings:
    """How long it took, in seconds."""

    recording_s: float
    align_s: float
    fuse_s: float

    @property
    def times_real_time(self) -> float:
        """How much faster than the recording itself."""
        return self.recording_s / max(self.align_s + self.fuse_s, 1e-9)


@dataclass(frozen=True, slots=True)
class FusedRecording:
    """The fused body of a recording in the reference sensor's frame and clock; T instants, 25 joints.

    A joint never seen in the recording is NaN throughout; any other has a position in every row (before it was first
    seen: that first position, with state 0 and an infinite bound).
    """

    name: str
    method: str
    causal: bool
    reference: str
    healthy_side: Side
    t_s: Floats  # (T,)
    positions: Floats  # (T, 25, 3) m
    bound_m: Floats  # (T, 25)
    state: States  # (T, 25)
    healthy: tuple[JointAngles | None, ...]  # T
    target: tuple[MirrorTarget | None, ...]  # T
    sensors: tuple[SensorReport, ...]
    timings: Timings
    others: OtherSensors = OtherSensors()


def fuse_recording(
    recording: Recording,
    method: str,
    reference: str | None = None,
    causal: bool = False,
    only_sensor: str | None = None,
    progress: Progress | None = None,
) -> FusedRecording:
    """Fuse a recording.

    Args:
        recording: with at least one skeleton stream.
        method: a name in `fusion.estimation.METHODS`.
        reference: the sensor whose frame and clock count; None takes the recording's primary.
        causal: learn alignment on the way instead of from the whole recording.
        only_sensor: use this sensor's samples alone (alignment still comes from the whole recording).
        progress: told the share done from time to time.

    Raises:
        InputError: unknown method or sensor, or nothing to fuse.
    """
    streams = _streams(recording)
    chosen = _named(recording, reference or next(name for name, stream in streams.items() if stream.primary))
    if only_sensor is not None:
        _named(recording, only_sensor)
    started = perf_counter()
    live = causal and only_sensor is None
    whole = None if live and recording.arrivals_known else align_streams(list(streams.values()), chosen)
    known = None if live else whole
    aligned = perf_counter()
    side = recording.healthy_side or Side.RIGHT
    evidence, others = _others(recording) if method == JOINING and only_sensor is None else (None, OtherSensors())
    pipeline = Pipeline(PipelineSettings(side, method, chosen, known.alignments if known else None, evidence))
    used = _usable(recording, [stream for name, stream in streams.items() if only_sensor in (None, name)], known)
    first = next((stream for stream in used if stream.sensor == chosen), used[0])
    pipeline.follow(first.sensor, _nearest_at_start(first))
    grid = _grid(streams[chosen])
    told = list(_run(pipeline, _due(used, streams[chosen], whole, live), grid, progress))
    timings = Timings(float(grid[-1] - grid[0]), aligned - started, perf_counter() - aligned)
    positions, bound_m, state = _stacked([frame for frame, _, _ in told])
    return FusedRecording(
        recording.name,
        method,
        causal,
        chosen,
        side,
        grid,
        positions,
        bound_m,
        state,
        tuple(healthy for _, healthy, _ in told),
        tuple(target for _, _, target in told),
        _reports(pipeline, streams, known, chosen, float(grid[-1])),
        timings,
        others,
    )


def _others(recording: Recording) -> tuple[Evidence | None, OtherSensors]:
    """Inertial sensors and a tag, where the recording has any."""
    if not (recording.imu_streams or recording.range_streams):
        return None, OtherSensors()
    from fusion.joined.feed import samples_of  # loads orientation filters, which most recordings do without

    found = samples_of(recording)
    evidence = found.evidence() if found.used else None
    return evidence, OtherSensors(tuple(name for name, _ in found.used), found.unusable)


def _usable(recording: Recording, streams: list[SkeletonStream], known: Aligned | None) -> list[SkeletonStream]:
    """The streams without a fault."""
    faults = known.faults if known else {}
    usable = [stream for stream in streams if stream.sensor not in faults]
    if not usable:
        why = "; ".join(sentence for stream in streams for sentence in faults[stream.sensor])
        raise RecordingError(
            f"recording '{recording.name}': no sensor can be used ({why})", "a sensor that shows a person as they are"
        )
    return usable


def _streams(recording: Recording) -> dict[str, SkeletonStream]:
    streams = {stream.sensor: stream for stream in recording.skeleton_streams if stream.samples}
    if not streams:
        raise RecordingError(
            f"recording '{recording.name}' has no skeleton frames", "a skeleton stream", "choose another recording"
        )
    if not any(stream.primary for stream in streams.values()):
        first = next(iter(streams))
        streams[first] = replace(streams[first], primary=True)
    return streams


def _named(recording: Recording, sensor: str) -> str:
    names = [stream.sensor for stream in recording.skeleton_streams if stream.samples]
    if sensor not in names:
        raise InputError(f"recording '{recording.name}' has no sensor '{sensor}'", f"one of {', '.join(names)}")
    return sensor


def _nearest_at_start(stream: SkeletonStream) -> str:
    """The body nearest to the lens when the stream begins: nobody is there to say who the patient is."""
    start_s = stream.samples[0].t_s
    first = [sample for sample in stream.samples if sample.t_s < start_s + START_S]

    def distance(sample: SkeletonSample) -> float:
        away = float(np.linalg.norm(trunk_centre(sample.positions_in_sensor, sample.state)))
        return away if np.isfinite(away) else np.inf

    return min(first, key=distance).body


def _grid(stream: SkeletonStream) -> Floats:
    """30 Hz from the stream's first to its last frame."""
    first, last = stream.samples[0].t_s, stream.samples[-1].t_s
    return first + np.arange(int((last - first) * GRID_HZ + 1e-6) + 1) / GRID_HZ


def _due(used: list[SkeletonStream], origin: SkeletonStream, whole: Aligned | None, live: bool) -> list[Due]:
    """Samples by aligned time; live, by arrival, which the clocks of the whole recording tell where it does not say."""
    if whole is None:
        return as_received(used, origin)
    return (as_if_equally_quick if live else when_taken)(used, origin, whole)


_Told = tuple[FusedFrame | None, JointAngles | None, MirrorTarget | None]


def _run(pipeline: Pipeline, due: list[Due], grid: Floats, progress: Progress | None) -> Iterator[_Told]:
    """Feed what is due at every instant of the grid and ask for the body."""
    at = 0
    for k, t_s in enumerate(grid.tolist()):
        while at < len(due) and due[at].t_s <= t_s:
            pipeline.take(due[at].sample)
            at += 1
        frame = pipeline.step(t_s - pipeline.lead_s, of_sensors=False)
        yield frame.fused or pipeline.fused_at(t_s - pipeline.lead_s), frame.healthy, frame.target
        if progress is not None and k % 30 == 0:
            progress(k / len(grid))
    if progress is not None:
        progress(1.0)


def _stacked(frames: list[FusedFrame | None]) -> tuple[Floats, Floats, States]:
    """Arrays over the grid; what is not known yet gets the first position known, as lost."""
    count = len(frames)
    positions = np.full((count, JOINT_COUNT, 3), np.nan)
    bound_m = np.full((count, JOINT_COUNT), np.inf)
    state = np.zeros((count, JOINT_COUNT), dtype=np.uint8)
    for k, frame in enumerate(frames):
        if frame is not None:
            positions[k], bound_m[k], state[k] = frame.positions_in_room, frame.bound_m, frame.state
    known = np.isfinite(positions).all(axis=2)
    for joint in np.nonzero(known.any(axis=0))[0]:
        _hold(positions[:, joint], known[:, joint])
    return positions, bound_m, state


def _hold(positions: Floats, known: Floats) -> None:
    """Fill rows (T, 3) in place: before the first known one with it, later gaps with the last known one."""
    last = np.maximum.accumulate(np.where(known, np.arange(len(known)), -1))
    source = np.where(last < 0, int(np.argmax(known)), last)
    positions[:] = positions[source]


def _reports(
    pipeline: Pipeline, streams: dict[str, SkeletonStream], known: Aligned | None, reference: str, end_s: float
) -> tuple[SensorReport, ...]:
    refusals, quality = pipeline.refusals(), {sensor.sensor: sensor for sensor in pipeline.sensors(end_s)}
    found = {
        name: replace(alignment, clock_offset_s=quality[name].clock_offset_s)
        for name, alignment in pipeline.alignments().items()
    }
    alignments = {**found, **known.alignments} if known else found
    return tuple(
        SensorReport(
            sensor=name,
            is_reference=name == reference,
            alignment=alignments.get(name),
            frames=len(stream.samples),
            refusals=refusals.get(name, {}),
            warnings=known.faults.get(name, ()) if known else quality[name].warnings,
        )
        for name, stream in streams.items()
    )
