"""What other sensors than cameras have said, by time: a log that is asked for what was known at an instant.

It only ever grows, and an answer at `t_s` holds nothing newer. So the estimator may be rewound without it, and the
order in which samples of different sensors come in does not matter.
"""

from __future__ import annotations

from bisect import bisect_right, insort
from collections.abc import Iterable
from typing import Final, Generic, TypeVar

from fusion.messages import PositionSample, SegmentSample

FRESH_S: Final = 0.1
"""An older sample says nothing of now: its sensor has fallen silent."""
LATELY_S: Final = 0.3
"""Ranges of so long count together: a pelvis hardly moves meanwhile, and noise does."""

Sample = TypeVar("Sample", SegmentSample, PositionSample)


class _Series(Generic[Sample]):
    """One sensor's samples in time order."""

    def __init__(self) -> None:
        self._samples: list[Sample] = []

    def add(self, sample: Sample) -> None:
        insort(self._samples, sample, key=_time)

    def at(self, t_s: float) -> Sample | None:
        """The newest sample at or before `t_s`; None where it is too old or there is none."""
        place = bisect_right(self._samples, t_s, key=_time)
        if place == 0 or t_s - self._samples[place - 1].t_s > FRESH_S:
            return None
        return self._samples[place - 1]

    def within(self, from_s: float, to_s: float) -> list[Sample]:
        """The samples after `from_s` and not after `to_s`."""
        first = bisect_right(self._samples, from_s, key=_time)
        return self._samples[first : bisect_right(self._samples, to_s, key=_time)]


def _time(sample: SegmentSample | PositionSample) -> float:
    return sample.t_s


class Evidence:
    """The log of inertial sensors by site, and of one tag.

    Args:
        samples: to begin with, as from a recording.
    """

    def __init__(self, samples: Iterable[SegmentSample | PositionSample] = ()) -> None:
        self._segments: dict[str, _Series[SegmentSample]] = {}
        self._tag: _Series[PositionSample] = _Series()
        for sample in samples:
            self.take(sample)

    def take(self, sample: SegmentSample | PositionSample) -> None:
        """Take a sample; any order will do."""
        if isinstance(sample, PositionSample):
            self._tag.add(sample)
        else:
            self._segments.setdefault(sample.site, _Series()).add(sample)

    def segment(self, site: str, t_s: float) -> SegmentSample | None:
        """How a segment was turned at `t_s`."""
        return self._segments[site].at(t_s) if site in self._segments else None

    def tag(self, t_s: float) -> tuple[PositionSample, ...]:
        """What the tag said lately, newest last; nothing where it has fallen silent."""
        if self._tag.at(t_s) is None:
            return ()
        return tuple(self._tag.within(t_s - LATELY_S, t_s))

    def speaks(self, t_s: float) -> bool:
        """Whether any inertial sensor says something of `t_s`."""
        return any(series.at(t_s) is not None for series in self._segments.values())
