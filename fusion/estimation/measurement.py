"""What one sample says of each joint: where, how surely, and whether it says anything at all."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from fusion.messages import AlignedSample, Floats, States
from fusion.skeleton import TrackingState

Flags = NDArray[np.bool_]


@dataclass(frozen=True, slots=True)
class Measurement:
    """The joints that a sample can speak for; the others hold zeros, so that no NaN enters any sum."""

    positions: Floats  # (J, 3) m in room, 0 where not given
    given: Flags  # (J,)
    tracked: Flags  # (J,) given and tracked; given but not tracked means inferred


def read(sample: AlignedSample) -> Measurement:
    """Leave out what is not tracked at all and what is not a number."""
    given = is_given(sample.positions_in_room, sample.state)
    positions = np.where(given[:, None], sample.positions_in_room, 0.0)
    return Measurement(positions, given, given & (sample.state == TrackingState.TRACKED))


def is_given(positions: Floats, state: States) -> Flags:
    """(J,) whether a joint is tracked or inferred, at a finite place."""
    given: Flags = (state != TrackingState.LOST) & np.isfinite(positions).all(axis=-1)
    return given
