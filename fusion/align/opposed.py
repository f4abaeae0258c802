"""How often two sensors' shoulder lines are opposed while the patient walks, before and after mending.

A pair: a frame of the reference and the other sensor's nearest in aligned time, within `BESIDE_S`. Opposed: the dot
product of the two lines, left shoulder to right shoulder, in the room's horizontal (x, z) is negative. Walking: the
reference's pelvis goes faster than `WALKING_M_S` over the half second around the frame. A pair is refused if the sided
joints of either frame were left out, and is then not counted as opposed: such lines reach nobody.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from fusion.align.alignment import SensorAlignment
from fusion.align.mend import Mending, SideKeeper
from fusion.align.whole import Stream, align_streams
from fusion.messages import AlignedSample, Floats, SkeletonSample
from fusion.skeleton import INDEX

WALKING_M_S = 0.3
OVER_S = 0.5
BESIDE_S = 0.03
LINE = INDEX["ShoulderLeft"], INDEX["ShoulderRight"]
PELVIS = INDEX["SpineBase"]


@dataclass(frozen=True, slots=True)
class Opposition:
    """Counts of pairs while walking, and of all frames of all sensors, whoever walked."""

    pairs: int
    opposed_before: int
    opposed_after: int
    refused: int
    """Pairs with a frame whose sided joints were left out."""
    frames: int
    frames_mended: int
    frames_refused: int

    def __add__(self, other: Opposition) -> Opposition:
        """The counts of both."""
        return Opposition(*(getattr(self, name) + getattr(other, name) for name in self.__slots__))

    @property
    def shares(self) -> tuple[float, float, float]:
        """Opposed before, opposed after, refused: shares of the pairs."""
        pairs = max(self.pairs, 1)
        return self.opposed_before / pairs, self.opposed_after / pairs, self.refused / pairs


@dataclass(frozen=True, slots=True)
class _Looked:
    """A frame before and after mending."""

    raw: AlignedSample
    mended: AlignedSample
    what: Mending


def opposition(streams: Sequence[Stream], reference: str) -> Opposition:
    """Align two or more streams of a recording, mend every frame in time order, and count.

    Args:
        streams: one per sensor; of several bodies the one seen most is taken.
        reference: the sensor whose frames the others' are held against.
    """
    alignments = align_streams(streams, reference).alignments
    aligned = [sample for stream in streams if stream.sensor in alignments for sample in _aligned(stream, alignments)]
    return opposition_in(aligned, reference)


def opposition_in(frames: Sequence[AlignedSample], reference: str) -> Opposition:
    """Mend aligned frames in time order, and count."""
    sides = SideKeeper()
    looked: dict[str, list[_Looked]] = {}
    for raw in sorted(frames, key=lambda sample: sample.t_s):
        looked.setdefault(raw.sensor, []).append(_Looked(raw, *sides.mend(raw)))
    return _counted(looked.pop(reference), list(looked.values()))


def _aligned(stream: Stream, alignments: dict[str, SensorAlignment]) -> list[AlignedSample]:
    """The body seen most, in the room and on the reference's clock."""
    bodies: dict[str, list[SkeletonSample]] = {}
    for sample in stream.samples:
        bodies.setdefault(sample.body, []).append(sample)
    found = alignments[stream.sensor]
    return [found.apply(sample, sample.t_s - found.clock_offset_s) for sample in max(bodies.values(), key=len)]


def _counted(own: list[_Looked], others: list[list[_Looked]]) -> Opposition:
    walking = [one for one, walks in zip(own, _walks([one.raw for one in own]), strict=True) if walks]
    pairs = [(one, near) for frames in others for one in walking if (near := _nearest(frames, one.raw.t_s))]
    refused = [Mending.SIDES_REFUSED in (one.what, near.what) for one, near in pairs]
    after = [_opposed(one.mended, near.mended) for one, near in pairs]
    everything = [one.what for frames in (own, *others) for one in frames]
    return Opposition(
        pairs=len(pairs),
        opposed_before=sum(_opposed(one.raw, near.raw) for one, near in pairs),
        opposed_after=sum(a and not r for a, r in zip(after, refused, strict=True)),
        refused=sum(refused),
        frames=len(everything),
        frames_mended=everything.count(Mending.SWAPPED_BACK),
        frames_refused=everything.count(Mending.SIDES_REFUSED),
    )


def _walks(frames: list[AlignedSample]) -> list[bool]:
    """Whether the pelvis goes fast enough around each frame."""
    t_s = np.array([frame.t_s for frame in frames])
    place = np.array([frame.positions_in_room[PELVIS][[0, 2]] for frame in frames])
    first = np.searchsorted(t_s, t_s - OVER_S / 2)
    last = np.minimum(np.searchsorted(t_s, t_s + OVER_S / 2), len(t_s) - 1)
    speed = np.linalg.norm(place[last] - place[first], axis=1) / np.maximum(t_s[last] - t_s[first], OVER_S / 2)
    walks: list[bool] = (speed > WALKING_M_S).tolist()
    return walks


def _nearest(frames: list[_Looked], t_s: float) -> _Looked | None:
    nearest = min(frames, key=lambda one: abs(one.raw.t_s - t_s))
    return nearest if abs(nearest.raw.t_s - t_s) < BESIDE_S else None


def _opposed(one: AlignedSample, other: AlignedSample) -> bool:
    return bool(_line(one) @ _line(other) < 0)


def _line(sample: AlignedSample) -> Floats:
    left, right = LINE
    line: Floats = (sample.positions_in_room[right] - sample.positions_in_room[left])[[0, 2]]
    return line
