"""Patients before two sensors whose lenses are covered in turn, followed by the simulated exoskeleton."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from typing import Final

import numpy as np

from fusion.errors import MachineError
from fusion.experiments.experiment import Setup
from fusion.experiments.measures.covered_lens import covered
from fusion.messages import Flags
from fusion.recording.recording import Recording, Trouble
from fusion.virtual_patient.sensor import NoiseLevel
from fusion.virtual_patient.trial import virtual_recording
from server.experiments.cranked.following import Course, on_one_clock, played
from server.experiments.cranked.judged import Span, within

SENSORS: Final = ("virtual-1", "virtual-2")
LEARN_S: Final = 6.0
"""The station watches the patient, so that it knows where the sensors stand."""
SETTLED_S: Final = 4.0
"""Then it is started, and blends in."""
BOTH_S: Final = 1.5
TRIED_S: Final = 6.0
"""The therapist tries for so long to start."""
ROUNDS: Final = 2
"""A recording with truth lasts some 13 s: it is played over and over, the first time for the station to learn."""
SEAM_S: Final = 4.0
"""Where it begins anew the patient is elsewhere at once; so much is not judged."""
CLEAR, FIRST, SECOND, BOTH = "nothing covered", "sensor 1 covered", "sensor 2 covered", "both covered"
Progress = Callable[[float], None]


@dataclass(frozen=True, slots=True)
class Run:
    """One course, and when what was covered."""

    name: str
    course: Course
    phases: Mapping[str, tuple[Span, ...]]
    uncovered: Course | None = None
    """The very same, had nothing been covered."""

    def rows(self, phase: str) -> Flags:
        """The instants of a phase."""
        return within(self.course.t_s, self.phases[phase])

    @property
    def judged(self) -> Flags:
        """The instants of every phase in which a sensor was left, the exoskeleton following."""
        known = within(self.course.t_s, [span for name in (CLEAR, FIRST, SECOND) for span in self.phases[name]])
        return known & self.course.following


def timeline(setup: Setup) -> tuple[dict[str, tuple[Span, ...]], float]:
    """When what is covered, and how long it lasts."""
    apart_s, covered_s = setup.long(4.0, 2.0), setup.long(7.0, 2.5)
    first = LEARN_S + SETTLED_S + apart_s
    second = first + covered_s + apart_s
    both = second + covered_s + apart_s
    end = both + BOTH_S + SETTLED_S + apart_s
    clear = ((first - apart_s, first), (second - apart_s, second), (both - apart_s, both), (end - apart_s, end))
    phases = {CLEAR: clear, FIRST: ((first, first + covered_s),), SECOND: ((second, second + covered_s),)}
    return {**phases, BOTH: ((both, both + BOTH_S),)}, end


def virtual_run(seed: int, setup: Setup, progress: Progress) -> Run:
    """A virtual patient before good sensors."""
    phases, end_s = timeline(setup)
    recording = virtual_recording(seed, end_s, clock_offset_s=0.0, apart_rad=np.pi / 2)
    lenses = ((FIRST, SENSORS[:1]), (SECOND, SENSORS[1:]), (BOTH, SENSORS))
    events = tuple(
        Trouble(sensor, "covered", *span) for phase, sensors in lenses for sensor in sensors for span in phases[phase]
    )
    with_trouble = covered(recording, events, seed)
    course = played(with_trouble, LEARN_S, 1, lambda share: progress(share / 2))
    uncovered = played(recording, LEARN_S, 1, lambda share: progress((1 + share) / 2))
    return Run(f"patient {seed}", course, phases, uncovered)


def hinders_start(seed: int, noise: NoiseLevel) -> str:
    """Why the exoskeleton cannot be started before sensors of this noise, in plain words; "" = it can."""
    recording = virtual_recording(seed, LEARN_S + TRIED_S, noise=noise, clock_offset_s=0.0, apart_rad=np.pi / 2)
    try:
        played(recording, LEARN_S)
    except MachineError as refused:
        return refused.what
    return ""


def recorded_run(recording: Recording, progress: Progress) -> Run:
    """A recording with truth, played over and over; what was planted in it is known."""
    course = played(on_one_clock(recording), LEARN_S, ROUNDS, progress)
    return Run(recording.name, course, _planted(recording, course))


def _planted(recording: Recording, course: Course) -> dict[str, tuple[Span, ...]]:
    """The recording's planted trouble in every round but the first; the rest is clear, but for the seams."""
    first_s = min(stream.samples[0].t_s for stream in recording.skeleton_streams)
    round_s = float(course.t_s[-1]) / ROUNDS
    starts = [k * round_s for k in range(1, ROUNDS)]
    names = [stream.sensor for stream in recording.skeleton_streams]
    spans: dict[str, list[Span]] = {CLEAR: [], FIRST: [], SECOND: [], BOTH: []}
    for start in starts:
        for event in recording.events:
            span = (start + event.from_s - first_s, start + event.to_s - first_s)
            if span[0] > start + SEAM_S:
                spans[(FIRST, SECOND)[names.index(event.sensor)]].append(span)
        spans[CLEAR] += _between(start + SEAM_S, start + round_s, sorted(spans[FIRST] + spans[SECOND]))
    return {name: tuple(found) for name, found in spans.items()}


def _between(start: float, end: float, taken: Sequence[Span]) -> list[Span]:
    edges = [start, *(edge for span in taken if start < span[1] <= end for edge in span), end]
    return [(a, b) for a, b in zip(edges[::2], edges[1::2], strict=True) if b > a]
