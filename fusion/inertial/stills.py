"""Whether an arm that came back to a pose has its elbow angle back, as far as gravity can tell that it came back.

A sensor at rest feels only gravity: where two still instants' gravity directions agree in a segment's sensor, the
segment leans as it did before (its heading may differ). Where they disagree, so may the elbow.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Final

import numpy as np
from numpy.typing import NDArray

from fusion.errors import InputError
from fusion.geometry import Floats
from fusion.inertial.arm import ArmSensors, InertialArm
from fusion.inertial.orientation import Oriented

STILL_RAD_S: Final = 0.1
AGREE_RAD: Final = np.radians(5.0)
EVERY_S: Final = 0.1


@dataclass(frozen=True, slots=True)
class Return:
    """Two intervals' still instants, each of one beside each of the other; angles in radians."""

    pairs: int
    agreeing: int
    """Pairs whose gravity agrees within 5° in upper arm and forearm."""
    nearest_upper_rad: float
    nearest_forearm_rad: float
    """How far gravity turned in the pair that comes nearest (by the larger of the two)."""
    elbow_rad: tuple[float, float]
    """The elbow's median flexion in either interval."""
    largest_apart_rad: float
    """Of the elbow, over the agreeing pairs; NaN where there are none."""


def compared(
    sensors: ArmSensors, arm: InertialArm, first_s: tuple[float, float], second_s: tuple[float, float]
) -> Return:
    """Compare the still instants of two intervals.

    Raises:
        InputError: the arm is never still in one of them.
    """
    segments = (sensors.upper_arm, sensors.forearm)
    one, other = (_still(segments, *interval) for interval in (first_s, second_s))
    upper, fore = (_apart(segment, one, other) for segment in segments)
    bent = arm.angles.elbow_flexion_rad
    elbow = np.abs(bent[one][:, None] - bent[other])
    larger = np.maximum(upper, fore)
    agree = larger < AGREE_RAD
    nearest = np.unravel_index(int(larger.argmin()), larger.shape)
    medians = (float(np.median(bent[one])), float(np.median(bent[other])))
    largest = float(elbow[agree].max()) if agree.any() else float("nan")
    return Return(agree.size, int(agree.sum()), float(upper[nearest]), float(fore[nearest]), medians, largest)


def _still(segments: tuple[Oriented, ...], from_s: float, to_s: float) -> NDArray[np.int64]:
    t_s = segments[0].t_s
    rate = np.max([np.linalg.norm(segment.rate_rad_s, axis=1) for segment in segments], axis=0)
    found = np.flatnonzero((t_s >= from_s) & (t_s <= to_s) & (rate < STILL_RAD_S))
    if not len(found):
        what = f"the arm is never still from {from_s:g} to {to_s:g} s"
        raise InputError(what, f"below {STILL_RAD_S} rad/s for a moment", "name other intervals to --compare")
    return found[:: max(1, round(EVERY_S / float(t_s[1] - t_s[0])))]


def _apart(segment: Oriented, one: NDArray[np.int64], other: NDArray[np.int64]) -> Floats:
    """How far gravity turned in the sensor, (N, M) rad."""
    first, second = (segment.up[at] / np.linalg.norm(segment.up[at], axis=1, keepdims=True) for at in (one, other))
    angle: Floats = np.arccos(np.clip(first @ second.T, -1.0, 1.0))
    return angle
