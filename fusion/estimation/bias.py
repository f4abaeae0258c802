"""What each sensor says differently from the others, joint by joint: learnt while several see it, taken off always.

Seen from the side a shoulder lies elsewhere than seen from the front, by centimetres and for as long as the person
stands so. Nobody can tell which sensor is right, so the mean of all stays where it is: offsets sum to zero. What they
buy is that the point stays where it was when one of the sensors falls silent, and is not pulled to and fro meanwhile.
"""

from __future__ import annotations

from dataclasses import dataclass, replace
from typing import Final

import numpy as np

from fusion.estimation.measurement import Flags
from fusion.messages import Floats
from fusion.skeleton import JOINT_COUNT

FOLLOW_S: Final = 2.0
"""Offsets change as the person turns, and must outlast one movement of the arm; 1 to 4 s serve."""
LARGEST_M: Final = 0.15
"""More than this is a wandering joint and no bias."""


@dataclass(frozen=True, slots=True)
class Bias:
    """Where one sensor sees each joint, less where all do."""

    sensor: str
    offset_m: Floats  # (J, 3) in room
    since_s: float


Biases = tuple[Bias, ...]


def offset_of(biases: Biases, sensor: str) -> Floats:
    """(J, 3) m, what is to be taken off a sensor's positions."""
    return next((bias.offset_m for bias in biases if bias.sensor == sensor), np.zeros((JOINT_COUNT, 3)))


def learn(biases: Biases, sensor: str, t_s: float, difference_m: Floats, joints: Flags) -> Biases:
    """Follow `difference_m` (J, 3), measured less fused, of the `joints` (J,) that another sensor sees as well."""
    own = next((bias for bias in biases if bias.sensor == sensor), None)
    if own is None:
        return (*biases, Bias(sensor, np.zeros((JOINT_COUNT, 3)), t_s))
    share = np.clip((t_s - own.since_s) / FOLLOW_S, 0.0, 0.1)
    step = np.where(joints[:, None], share * (difference_m - own.offset_m), 0.0)
    updated = replace(own, offset_m=own.offset_m + step, since_s=t_s)
    return _centred(tuple(updated if bias is own else bias for bias in biases))


def _centred(biases: Biases) -> Biases:
    """The same differences, none too large, with no offset that all sensors share."""
    offsets = np.array([bias.offset_m for bias in biases])  # (K, J, 3)
    offsets -= offsets.sum(axis=0) / len(biases)
    squares = np.einsum("kji,kji->kj", offsets, offsets)
    if squares.max() > LARGEST_M**2:
        offsets *= (LARGEST_M / np.sqrt(np.maximum(squares, LARGEST_M**2)))[..., None]
    return tuple(replace(bias, offset_m=offset) for bias, offset in zip(biases, offsets, strict=True))
