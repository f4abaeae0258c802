"""From the datagram that tells of a reach's middle to the motor that passes it, through the whole station."""

from __future__ import annotations

from collections.abc import Callable
from typing import Final

import numpy as np

from fusion.messages import Floats
from server.experiments.cranked.following import Course, played
from server.experiments.lag.reaching import Reaching

LEARN_S: Final = 6.0
LEAST_WAY_RAD: Final = 0.4
"""Shorter movements of a joint are not judged."""
LONGEST_S: Final = 0.6
JOINTS: Final = {"upper arm": 1, "elbow": 3}


def response_ms(scene: Reaching, progress: Callable[[float], None]) -> Floats:
    """(N,) delays of every reach of upper arm and elbow that the exoskeleton followed.

    Begins at the first datagram sent after the arm passed the middle of its way; ends when the simulated drive's
    measured joint passes it.

    Raises:
        MachineError: the exoskeleton could not be started.
    """
    course = played(scene.recording, LEARN_S, progress=progress)
    samples = [sample for stream in scene.recording.skeleton_streams for sample in stream.samples]
    sent_s = np.sort([sample.t_received_s for sample in samples])
    sent_s = sent_s - sent_s[0]
    found = [each for joint in JOINTS.values() for each in _of_joint(course, joint, sent_s)]
    return 1e3 * np.array(found)


def _of_joint(course: Course, joint: int, sent_s: Floats) -> list[float]:
    truth, measured = course.truth_rad[:, joint], course.measured_rad[:, joint]
    delays = []
    for start, end in _reaches(truth):
        middle = (truth[start] + truth[end]) / 2
        passed = _passes(truth, middle, start, end)
        late = min(passed + round(LONGEST_S / _tick_s(course)), len(truth) - 1)
        arrived = _passes(measured, middle, passed - 1, late)
        if arrived < late and course.following[start : late + 1].all():
            told_s = sent_s[np.searchsorted(sent_s, course.t_s[passed])]
            delays.append(float(course.t_s[arrived] - told_s))
    return delays


def _tick_s(course: Course) -> float:
    return float(course.t_s[1] - course.t_s[0])


def _reaches(truth: Floats) -> list[tuple[int, int]]:
    """First and last tick of every long movement of one joint."""
    moving = np.abs(np.gradient(truth)) > 1e-5
    edges = np.flatnonzero(np.diff(np.concatenate([[False], moving, [False]]).astype(int)))
    pairs = zip(edges[::2].tolist(), (edges[1::2] - 1).tolist(), strict=True)
    return [(a, b) for a, b in pairs if abs(truth[b] - truth[a]) > LEAST_WAY_RAD]


def _passes(angle: Floats, middle: float, start: int, end: int) -> int:
    """The first tick in start..end on the other side of the middle than `start`; `end` where there is none."""
    side = np.sign(angle[start : end + 1] - middle)
    crossed = np.flatnonzero(side != side[0])
    return start + int(crossed[0]) if len(crossed) else end
