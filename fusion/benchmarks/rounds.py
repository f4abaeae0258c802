"""Timing on a shared machine: all candidates take turns in every round, so whatever disturbs one disturbs all."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass
from time import perf_counter_ns

import numpy as np

from fusion.messages import Floats


@dataclass(frozen=True, slots=True)
class Candidate:
    """One piece of work, and how often it is done in a round."""

    work: Callable[[], object]
    times: int = 1


@dataclass(frozen=True, slots=True)
class Timing:
    """Microseconds for one piece of work, as often as it was done."""

    per_piece_us: Floats  # (pieces,)

    @property
    def median_us(self) -> float:
        """What one piece takes as a rule."""
        return float(np.median(self.per_piece_us))

    @property
    def p99_us(self) -> float:
        """What one in a hundred exceeds."""
        return float(np.percentile(self.per_piece_us, 99))

    @property
    def least_us(self) -> float:
        """The quickest tenth: nearest to what a quiet machine would show."""
        return float(np.percentile(self.per_piece_us, 10))


def take_turns(candidates: Mapping[str, Candidate], rounds: int) -> dict[str, Timing]:
    """Do each candidate's work in turn, `rounds` times; one round more is done first and thrown away."""
    taken: dict[str, list[Floats]] = {name: [] for name in candidates}
    for number in range(rounds + 1):
        for name, candidate in candidates.items():
            pieces_us = _timed(candidate)
            if number > 0:
                taken[name].append(pieces_us)
    return {name: Timing(np.concatenate(parts)) for name, parts in taken.items()}


def _timed(candidate: Candidate) -> Floats:
    pieces = np.empty(candidate.times)
    for k in range(candidate.times):
        began = perf_counter_ns()
        candidate.work()
        pieces[k] = (perf_counter_ns() - began) / 1e3
    return pieces
