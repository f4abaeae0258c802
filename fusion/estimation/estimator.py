"""What every estimator does: take aligned samples in time order, say where the body is at any later instant."""

from __future__ import annotations

from abc import ABC, abstractmethod
from typing import ClassVar

from fusion.messages import AlignedSample, FusedFrame, Refusal


class Estimator(ABC):
    """Joins aligned samples of one person into one body.

    Samples come in time order; one that is a little older than the state is taken as well as it can be, one that
    is far too old is ignored. A silent sensor is simply absent. Whatever an estimator knows is one immutable
    value, so `snapshot` and `restore` cost nothing and the pipeline may rewind to take a late sample in its place.
    """

    name: ClassVar[str]

    @abstractmethod
    def update(self, sample: AlignedSample) -> tuple[Refusal, ...]:
        """Take one sample at its own time; returns the joints of it that were refused, and why."""

    @abstractmethod
    def frame(self, t_s: float) -> FusedFrame:
        """The body at `t_s` from what has been taken so far; the state stays as it is.

        A joint never seen has NaN positions, an infinite bound and state 0. `refusals` are those of the latest
        sample of each sensor, while that sample is fresh.
        """

    @abstractmethod
    def snapshot(self) -> object:
        """Everything the estimator knows, as one immutable value."""

    @abstractmethod
    def restore(self, snapshot: object) -> None:
        """Go back to what `snapshot` returned earlier."""
