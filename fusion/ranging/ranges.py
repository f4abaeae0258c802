"""Ranges of several tags to several anchors, instant by instant."""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray

from fusion.messages import Floats


@dataclass(frozen=True, slots=True)
class Ranges:
    """E instants, A anchors, K tags."""

    anchors: Floats  # (A, 3) m, z up
    t_s: Floats  # (E,) rising
    range_m: Floats  # (E, A, K), NaN where nothing was measured

    def between(self, from_s: float, to_s: float) -> Ranges:
        """The instants from a time to another."""
        inside = (self.t_s >= from_s) & (self.t_s <= to_s)
        return replace(self, t_s=self.t_s[inside], range_m=self.range_m[inside])

    def to_anchors(self, chosen: list[int]) -> Ranges:
        """The ranges to some of the anchors."""
        return replace(self, anchors=self.anchors[chosen], range_m=self.range_m[:, chosen])

    def of_tags(self, chosen: list[int]) -> Ranges:
        """The ranges of some of the tags."""
        return replace(self, range_m=self.range_m[:, :, chosen])


def gathered(
    anchors: Floats, tags: int, t_s: Floats, anchor: NDArray[np.int64], tag: NDArray[np.int64], range_m: Floats
) -> Ranges:
    """Single ranges (R,) by instant; of two of one link at one instant the last counts."""
    instants, row = np.unique(t_s, return_inverse=True)
    table = np.full((len(instants), len(anchors), tags), np.nan)
    table[row, anchor, tag] = range_m
    return Ranges(anchors, instants, table)


def interpolated(t_s: Floats, positions: Floats, at_s: Floats) -> Floats:
    """Positions (T, K, 3) at other instants, (N, K, 3); NaN outside and where the truth is."""
    flat = positions.reshape(len(t_s), -1)
    columns = [np.interp(at_s, t_s, column, left=np.nan, right=np.nan) for column in flat.T]
    return np.stack(columns, axis=-1).reshape(len(at_s), *positions.shape[1:])
