"""An estimator that takes samples in any order: late ones are put in their place by rewinding a short while.

Rewinding changes the past; what is told of the present moves on from what was told before (`fusion.steady`).
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from math import isfinite

from fusion.estimation.estimator import Estimator
from fusion.messages import AlignedSample, FusedFrame, Refusal
from fusion.steady import follow

WINDOW_S = 0.4
"""How late a sample may come and still count; two senders' delays differ by less."""


@dataclass(frozen=True, slots=True)
class _Step:
    """A sample taken, and what the estimator knew before it."""

    sample: AlignedSample
    before: object


class RewindingEstimator:
    """Gives an `Estimator` its samples in time order, whatever order they arrive in.

    Args:
        make: makes the estimator, once now and once for every fresh start.
    """

    def __init__(self, make: Callable[[], Estimator]) -> None:
        self._make = make
        self.restart()

    def restart(self) -> None:
        """Forget everything, as for another person."""
        self._estimator = self._make()
        self._steps: list[_Step] = []
        self._told: FusedFrame | None = None

    @property
    def newest_s(self) -> float | None:
        """Time of the newest sample; None before the first."""
        return self._steps[-1].sample.t_s if self._steps else None

    def take(self, sample: AlignedSample) -> tuple[Refusal, ...] | None:
        """Take a sample at its own time; its refused joints, or None where it came too late, or of no instant."""
        if not isfinite(sample.t_s):
            return None
        if self._steps and sample.t_s < self._steps[-1].sample.t_s - WINDOW_S:
            return None
        place = len(self._steps)
        while place and self._steps[place - 1].sample.t_s > sample.t_s:
            place -= 1
        later = [step.sample for step in self._steps[place:]]
        if later:
            self._estimator.restore(self._steps[place].before)
            del self._steps[place:]
        refusals = self._update(sample)
        for again in later:
            self._update(again)
        self._trim()
        return refusals

    def frame(self, t_s: float) -> FusedFrame:
        """The body at `t_s`, not before the newest sample nor the last time asked for; no joint steps from there."""
        last_s = self._told.t_s if self._told else t_s
        self._told = follow(self._told, self._estimator.frame(max(t_s, last_s)))
        return self._told

    def _update(self, sample: AlignedSample) -> tuple[Refusal, ...]:
        self._steps.append(_Step(sample, self._estimator.snapshot()))
        return self._estimator.update(sample)

    def _trim(self) -> None:
        oldest = self._steps[-1].sample.t_s - WINDOW_S
        too_old = next(k for k, step in enumerate(self._steps) if step.sample.t_s > oldest)
        del self._steps[:too_old]
