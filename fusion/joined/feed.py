"""The inertial and range streams of a recording as samples for the one estimator; what cannot be used, and why.

Streams must be on the reference sensor's clock. Inertial sensors need no calibration pose, and the anchors' frame need
not be known: both are learnt beside the cameras. Everything here is causal.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass
from functools import partial

import numpy as np

from fusion.errors import InputError
from fusion.inertial.orientation import Inertial, orient, together
from fusion.joined.evidence import Evidence
from fusion.joined.sites import BONES_AT
from fusion.messages import PositionSample, SegmentSample
from fusion.ranging.calibration import uncalibrated
from fusion.ranging.locate import locate
from fusion.ranging.ranges import gathered
from fusion.recording.recording import ImuStream, RangeStream, Recording

OtherSample = SegmentSample | PositionSample


@dataclass(frozen=True, slots=True)
class OtherSamples:
    """What a recording has besides skeletons."""

    used: tuple[tuple[str, Sequence[OtherSample]], ...]
    """By site or tag."""
    unusable: dict[str, str]
    """Streams that are left out, with the reason in a sentence or two."""

    def evidence(self) -> Evidence:
        """A log of all of them."""
        return Evidence(sample for _, samples in self.used for sample in samples)


def samples_of(recording: Recording) -> OtherSamples:
    """Read the recording's inertial and range streams.

    Usable: an imu stream with a site of `fusion.joined.sites.BONES_AT`; the first tag of a range stream, worn at the
    waist, whose four or more anchors do not lie in one plane.
    """
    used: list[tuple[str, Sequence[OtherSample]]] = []
    unusable: dict[str, str] = {}
    for name, source in _sources(recording):
        try:
            used.append((name, _while_seen(name, source(), recording)))
        except InputError as error:
            unusable[name] = str(error)
    return OtherSamples(tuple(used), unusable)


def _while_seen(name: str, samples: Sequence[OtherSample], recording: Recording) -> Sequence[OtherSample]:
    """The samples, if any were taken while cameras looked: a clock of its own cannot be told from another day."""
    frames = next((stream.samples for stream in recording.skeleton_streams if stream.primary and stream.samples), ())
    if frames and not any(frames[0].t_s <= sample.t_s <= frames[-1].t_s for sample in samples):
        what = f"'{name}' has no sample between the first and the last frame of '{frames[0].sensor}'"
        raise InputError(what, "times on the reference sensor's clock", "mend t_s")
    return samples


Source = Callable[[], Sequence[OtherSample]]


def _sources(recording: Recording) -> Iterator[tuple[str, Source]]:
    for stream in recording.imu_streams:
        yield stream.site, partial(_segments, stream)
    for ranges in recording.range_streams:
        for number, tag in enumerate(ranges.tags):
            yield tag, partial(_positions, ranges, number)


def _segments(stream: ImuStream) -> list[SegmentSample]:
    """Orientations by VQF as they would come live."""
    if stream.site not in BONES_AT:
        raise InputError(f"no bone is known to turn with the site '{stream.site}'", f"one of {', '.join(BONES_AT)}")
    (even,) = together([Inertial(stream.site, stream.t_s, stream.gyro_rad_s, stream.accel_m_s2)])
    oriented = orient(even, causal=True)
    rotations = oriented.sensor_to_earth.as_matrix()
    return [SegmentSample(stream.site, t, q) for t, q in zip(oriented.t_s.tolist(), rotations, strict=True)]


def _positions(stream: RangeStream, tag: int) -> list[PositionSample]:
    """Positions of one tag by the filter of `locate`, nothing learnt of the links."""
    if tag:
        raise InputError(f"'{stream.tags[tag]}' is the stream's second tag", "one tag, at the waist")
    mine = stream.tag == tag
    ranges = gathered(
        stream.anchor_positions, 1, stream.t_s[mine], stream.anchor[mine], stream.tag[mine], stream.range_m[mine]
    )
    track = locate(ranges, uncalibrated(ranges))
    rows = zip(ranges.t_s.tolist(), track.positions[:, 0], ranges.range_m[:, :, 0], strict=True)
    return [
        PositionSample(stream.tags[tag], t, position, stream.anchor_positions, range_m)
        for t, position, range_m in rows
        if np.isfinite(position).all()
    ]
