"""What one sample says of each joint: where, how surely, and whether it says anything at all."""

from __future__ import annotations

from typing import Final, NamedTuple

import numpy as np

from fusion.compiled import kernel
from fusion.estimation.vectors import Vector, put, row
from fusion.messages import AlignedSample, Flags, Floats, States
from fusion.skeleton import TrackingState

FARTHEST_M: Final = 1e3
"""No sensor sees so far, and no sum over what is nearer overflows."""
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
        ValueError: an array is not of the shape that `joints` joints have; a kernel would read beyond its end.
    """
    _expect(joints, "positions array", sample.positions_in_room, (joints, 3))
    _expect(joints, "state", sample.state, (joints,))
    _expect(joints, "lens", sample.lens_in_room, (3,))
    _expect(joints, "rotation", sample.rotation_sensor_to_room, (3, 3))
    return Sight(
        np.array(sample.positions_in_room, np.float64, order="C"),
        np.array(sample.state, np.uint8),
        np.array(sample.lens_in_room, np.float64),
        np.array(sample.rotation_sensor_to_room, np.float64, order="C"),
    )


def _expect(joints: int, name: str, array: Floats | States, shape: tuple[int, ...]) -> None:
    if array.shape != shape:
        raise ValueError(f"a sample of {joints} joints has a {name} of the shape {shape}, not {array.shape}")


@kernel
def read(seen: Sight) -> Measurement:
    """Leave out what is not tracked at all, is not a number, or is farther than anything; without a mounting, all."""
    positions = np.zeros_like(seen.positions_in_room)
    given = np.zeros(len(positions), np.bool_)
    mounted = _is_near(seen.lens_in_room)
    for k in range(3):
        mounted = mounted and _is_near(seen.rotation_sensor_to_room[k])
    for j in range(len(positions)):
        given[j] = mounted and seen.state[j] != LOST and _is_near(seen.positions_in_room[j])
        if given[j]:
            put(positions, j, row(seen.positions_in_room, j))
    return Measurement(positions, given, given & (seen.state == TRACKED))


@kernel
def _is_near(a: Floats) -> bool:
    """Whether three numbers are numbers, and none too large."""
    return bool(abs(a[0]) < FARTHEST_M and abs(a[1]) < FARTHEST_M and abs(a[2]) < FARTHEST_M)
