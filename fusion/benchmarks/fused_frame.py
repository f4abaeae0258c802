"""A fused frame, 25 joints of two sensors: every method of ours beside the same samples in FilterPy and Stone Soup."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence
from itertools import islice
from typing import Final

from fusion.benchmarks.filterpy_filter import FilterPyBody
from fusion.benchmarks.rounds import Candidate, Timing, take_turns
from fusion.benchmarks.scene import frames
from fusion.benchmarks.stonesoup_filter import StoneSoupBody
from fusion.estimation import METHODS
from fusion.estimation.estimator import Estimator
from fusion.messages import AlignedSample, FusedFrame
from fusion.skeleton import JOINT_COUNT

SENSORS: Final = 2
OURS: Final = 20
"""Frames in a round; the baselines are so much slower that fewer do."""
Samples = tuple[AlignedSample, ...]


def compare(rounds: int) -> dict[str, Timing]:
    """Timings by name, our methods first."""
    enough = list(islice(frames(JOINT_COUNT, SENSORS), (rounds + 1) * OURS))
    candidates = {name: Candidate(over(enough, fused_by(method())), OURS) for name, method in METHODS.items()}
    candidates["FilterPy"] = Candidate(over(enough, FilterPyBody(JOINT_COUNT).take), 2)
    candidates["Stone Soup"] = Candidate(over(enough, StoneSoupBody(JOINT_COUNT).take), 1)
    return take_turns(candidates, rounds)


def fused_by(estimator: Estimator) -> Callable[[Samples], FusedFrame]:
    """One frame: every sensor's sample taken, then the body told."""

    def fuse(samples: Samples) -> FusedFrame:
        for sample in samples:
            estimator.update(sample)
        return estimator.frame(samples[-1].t_s)

    return fuse


def over(enough: Sequence[Samples], work: Callable[[Samples], object]) -> Callable[[], object]:
    """The work on the next frame, at each call."""
    following: Iterator[Samples] = iter(enough)
    return lambda: work(next(following))
