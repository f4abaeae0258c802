"""When the pipeline gets the samples of a recording: by their aligned time, or as they came.

Live, a sender's clock is compared with the clock of reception, so one that is minutes off costs nothing; a sender whose
frames come late costs their lateness. A log keeps when each frame was received. An interchange folder does not, and its
stamps cannot tell a clock that is off from frames that come late. There the senders are taken for equally quick: every
frame arrives when it was taken.
"""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass, replace

from fusion.align.whole import Aligned
from fusion.messages import SkeletonSample
from fusion.recording.recording import SkeletonStream


@dataclass(frozen=True, slots=True)
class Due:
    """A sample and when the pipeline gets it, on the reference's clock."""

    t_s: float
    sample: SkeletonSample


def when_taken(streams: Iterable[SkeletonStream], origin: SkeletonStream, clocks: Aligned) -> list[Due]:
    """Every sample when it was taken.

    Args:
        streams: of a recording.
        origin: the reference's.
        clocks: of whose alignment only the clock offsets are used.
    """
    offsets_s = ((stream, _offset_s(stream, origin, clocks)) for stream in streams)
    return _in_order(Due(sample.t_s - offset_s, sample) for stream, offset_s in offsets_s for sample in stream.samples)


def as_if_equally_quick(streams: Iterable[SkeletonStream], origin: SkeletonStream, clocks: Aligned) -> list[Due]:
    """Every sample received when it was taken, its stamp still of its own sensor's clock; see `when_taken`."""
    return [_received(due.sample, due.t_s) for due in when_taken(streams, origin, clocks)]


def as_received(streams: Iterable[SkeletonStream], origin: SkeletonStream) -> list[Due]:
    """Every sample when it was received; the reference's quickest frame counts as received when it was taken.

    Args:
        streams: with the times at which their samples were really received.
        origin: the reference's.
    """
    least_s = min(sample.t_received_s - sample.t_s for sample in origin.samples)
    return _in_order(_received(sample, sample.t_received_s - least_s) for s in streams for sample in s.samples)


def _received(sample: SkeletonSample, t_s: float) -> Due:
    return Due(t_s, replace(sample, t_received_s=t_s))


def _in_order(due: Iterable[Due]) -> list[Due]:
    return sorted(due, key=lambda item: item.t_s)


def _offset_s(stream: SkeletonStream, origin: SkeletonStream, clocks: Aligned) -> float:
    """Of the stream's clock against the reference's; as if both had begun together where nothing else tells."""
    found = clocks.alignments.get(stream.sensor)
    if found is not None:
        return found.clock_offset_s
    a, b = origin.samples, stream.samples
    apart = b[0].t_s > a[-1].t_s or b[-1].t_s < a[0].t_s
    return b[0].t_s - a[0].t_s if apart else 0.0
