"""What one sample says of each joint: where, how surely, and whether it says anything at all."""

from __future__ import annotations

from math import isfinite
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from fusion.compiled import kernel
from fusion.estimation.vectors import Vector, put, row
from fusion.messages import AlignedSample, Floats, States
from fusion.skeleton import TrackingState

Flags = NDArray[np.bool_]
TRACKED, LOST = TrackingState.TRACKED, TrackingState.LOST


class Sight(NamedTuple):
    """A sample's arrays as kernels take them: our own, in one layout, whatever was handed in."""

    positions_in_room: Floats  # (J, 3) m
    state: States  # (J,)
    lens_in_room: Floats  # (3,)
    rotation_sensor_to_room: Floats  # (3, 3)


class Measurement(NamedTuple):
    """The joints that a sample can speak for; the others hold zeros, so that no NaN enters any sum."""

    positions: Floats  # (J, 3) m in room, 0 where not given
    given: Flags  # (J,)
    tracked: Flags  # (J,) given and tracked; given but not tracked means inferred


class Heard(NamedTuple):
    """What one sample says of one joint."""

    position: Vector  # m in room
    tracked: bool
    wandering: bool  # it hangs on a bone whose length is wrong
    hidden: bool  # the trunk stands between it and the lens
    from_spine: Vector  # m, from where the same sensor sees the spine, in room
    spine_seen: bool


def sight(sample: AlignedSample, joints: int) -> Sight:
    """Copies, so that no kernel is compiled anew for an array that is read-only or lies otherwise in memory.

    Raises:
        ValueError: the sample is not one of `joints` joints; a kernel would read beyond its end.
    """
    if sample.positions_in_room.shape != (joints, 3) or sample.state.shape != (joints,):
        raise ValueError(f"a sample of {sample.positions_in_room.shape} and {sample.state.shape} for {joints} joints")
    return Sight(
        np.array(sample.positions_in_room, np.float64, order="C"),
        np.array(sample.state, np.uint8),
        np.array(sample.lens_in_room, np.float64),
        np.array(sample.rotation_sensor_to_room, np.float64, order="C"),
    )


@kernel
def read(seen: Sight) -> Measurement:
    """Leave out what is not tracked at all and what is not a number."""
    positions = np.zeros_like(seen.positions_in_room)
    given = np.zeros(len(positions), np.bool_)
    for j in range(len(positions)):
        place = row(seen.positions_in_room, j)
        given[j] = seen.state[j] != LOST and isfinite(place[0]) and isfinite(place[1]) and isfinite(place[2])
        if given[j]:
            put(positions, j, place)
    return Measurement(positions, given, given & (seen.state == TRACKED))
