"""The one estimator with each of its sensors taken away in turn, on a simulated patient."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Sequence
from dataclasses import dataclass
from typing import Final

import numpy as np

from fusion.align.whole import align_streams
from fusion.errors import RecordingError
from fusion.estimation import METHODS
from fusion.evaluation.scores import Errors, errors_of, joined, truth_at
from fusion.joined.estimator import Joined
from fusion.joined.evidence import Evidence
from fusion.joined.feed import OtherSample, samples_of
from fusion.messages import AlignedSample, Floats, FusedFrame, SegmentSample, States
from fusion.recording.recording import Recording, TruthStream
from fusion.skeleton import INDEX, Side, arm
from fusion.virtual_patient.sensor import TABLE1_CENTRED
from fusion.virtual_patient.tag import TagErrors
from fusion.virtual_patient.trial import virtual_recording
from fusion.virtual_patient.worn import ON_SKIN

Spans = tuple[tuple[float, float], ...]
LEARN_S: Final = 30.0
"""Everything is there for so long before anything is taken away."""
GRID_HZ: Final = 30.0
SETTLED_S: Final = 0.5
"""A gap is judged from so long after it began: before, everything is as it was."""
GAP_EVERY_S: Final = 15.0
STROLL_M: Final = 0.12
JUDGED: Final = ("pelvis", "shoulder", "elbow", "wrist")
ARM: Final = JUDGED[1:]


@dataclass(frozen=True, slots=True)
class Loss:
    """What is taken away after the first half minute."""

    name: str
    cameras: tuple[int, ...] = ()
    inertial: bool = False
    tag: bool = False
    anatomy: bool = False
    gap_s: float | None = None
    """How long at a time; None = for good."""


BOTH: Final = (0, 1)
FOR_GOOD: Final = (
    Loss("nothing"),
    Loss("camera 1", (0,)),
    Loss("camera 2", (1,)),
    Loss("inertial sensors", inertial=True),
    Loss("tag", tag=True),
    Loss("anatomy", anatomy=True),
    Loss("all but the cameras", inertial=True, tag=True, anatomy=True),
)
LOSSES: Final = (
    *FOR_GOOD,
    Loss("both cameras for 5 s", BOTH, gap_s=5.0),
    Loss("the same and the tag", BOTH, tag=True, gap_s=5.0),
    Loss("the same and the inertial sensors", BOTH, inertial=True, gap_s=5.0),
    Loss("the same and inertial sensors and anatomy", BOTH, inertial=True, anatomy=True, gap_s=5.0),
    Loss("the same and all else", BOTH, True, True, True, gap_s=5.0),
    Loss("both cameras for 20 s", BOTH, gap_s=20.0),
    Loss("both and the tag for 20 s", BOTH, tag=True, gap_s=20.0),
    Loss("both and the inertial sensors for 20 s", BOTH, inertial=True, gap_s=20.0),
)


@dataclass(frozen=True, slots=True)
class Patient:
    """A simulated patient's samples in the room, and the truth."""

    cameras: tuple[tuple[AlignedSample, ...], ...]
    """By camera."""
    others: tuple[OtherSample, ...]
    truth: TruthStream
    end_s: float
    side: Side


@dataclass(frozen=True, slots=True)
class Told:
    """What was told of one patient, at T instants."""

    t_s: Floats  # (T,)
    positions: Floats  # (T, 25, 3) m
    bound_m: Floats  # (T, 25)
    state: States  # (T, 25)
    truth: Floats  # (T, 25, 3) m
    gaps: Spans
    """When something was gone."""


@dataclass(frozen=True, slots=True)
class Judged:
    """The errors while something was gone."""

    by_joint: dict[str, Errors]
    from_shoulder_m: Floats  # (N,) errors of elbow and wrist as seen from the shoulder

    @property
    def arm(self) -> Errors:
        """Shoulder, elbow and wrist together."""
        return joined([self.by_joint[name] for name in ARM])


def patient(seed: int, length_s: float) -> Patient:
    """Two cameras with the errors of [Du2016] Table 1, mounting and clocks estimated; inertial sensors; a tag."""
    worn, tag = ON_SKIN, TagErrors()
    recording = virtual_recording(seed, length_s, noise=TABLE1_CENTRED, stroll_m=STROLL_M, worn=worn, tag=tag)
    others = tuple(sample for _, samples in samples_of(recording).used for sample in samples)
    truth = recording.truth
    if truth is None or recording.healthy_side is None:
        raise RecordingError("a simulated patient without truth", "truth and a healthy side")
    return Patient(_in_room(recording), others, truth, length_s - 1.0, recording.healthy_side)


def _in_room(recording: Recording) -> tuple[tuple[AlignedSample, ...], ...]:
    streams = recording.skeleton_streams
    found = align_streams(streams, streams[0].sensor).alignments
    return tuple(
        tuple(found[s.sensor].apply(sample, sample.t_s - found[s.sensor].clock_offset_s) for sample in s.samples)
        for s in streams
    )


def gaps(loss: Loss, end_s: float) -> Spans:
    """When the loss is."""
    if loss.gap_s is None:
        return ((LEARN_S, end_s),)
    starts = np.arange(LEARN_S, end_s - loss.gap_s, loss.gap_s + GAP_EVERY_S)
    return tuple((start, start + loss.gap_s) for start in starts.tolist())


def told(who: Patient, loss: Loss) -> Told:
    """Run the one estimator, causally, at 30 Hz."""
    spans = gaps(loss, who.end_s)
    evidence = Evidence(sample for sample in who.others if not (_is_lost(sample, loss) and _within(sample.t_s, spans)))
    estimator = Joined(METHODS["set-membership"], evidence, not loss.anatomy)
    t_s = np.arange(LEARN_S / 2, who.end_s, 1 / GRID_HZ)
    frames = list(_frames(estimator, _seen(who, loss, spans), t_s.tolist()))
    return Told(
        t_s,
        np.array([frame.positions_in_room for frame in frames]),
        np.array([frame.bound_m for frame in frames]),
        np.array([frame.state for frame in frames]),
        truth_at(who.truth, t_s),
        spans,
    )


def judged(found: Told, side: Side) -> Judged:
    """The errors in the gaps."""
    counts = np.array([_within(t_s, tuple((a + SETTLED_S, b) for a, b in found.gaps)) for t_s in found.t_s.tolist()])
    joints = dict(zip(JUDGED, (INDEX["SpineBase"], *arm(side)[:3]), strict=True))
    by_joint = {
        name: errors_of(found.truth[:, j], found.positions[:, j], found.bound_m[:, j], found.state[:, j], counts)
        for name, j in joints.items()
    }
    shoulder, *rest = (joints[name] for name in ARM)
    from_shoulder = (found.positions - found.truth)[counts]
    off = from_shoulder[:, rest] - from_shoulder[:, [shoulder]]
    return Judged(by_joint, np.linalg.norm(off, axis=2).ravel())


def together(parts: Sequence[Judged]) -> Judged:
    """Several patients as one."""
    by_joint = {name: joined([part.by_joint[name] for part in parts]) for name in JUDGED}
    return Judged(by_joint, np.concatenate([part.from_shoulder_m for part in parts]))


def _is_lost(sample: OtherSample, loss: Loss) -> bool:
    return loss.inertial if isinstance(sample, SegmentSample) else loss.tag


def _within(t_s: float, spans: Spans) -> bool:
    return any(start <= t_s < end for start, end in spans)


def _seen(who: Patient, loss: Loss, spans: Spans) -> list[AlignedSample]:
    """What the cameras that are not covered see, in time order."""
    kept = (
        sample
        for number, samples in enumerate(who.cameras)
        for sample in samples
        if not (number in loss.cameras and _within(sample.t_s, spans))
    )
    return sorted(kept, key=lambda sample: sample.t_s)


def _frames(estimator: Joined, samples: list[AlignedSample], instants_s: Iterable[float]) -> Iterator[FusedFrame]:
    at = 0
    for t_s in instants_s:
        while at < len(samples) and samples[at].t_s <= t_s:
            estimator.update(samples[at])
            at += 1
        yield estimator.frame(t_s)
