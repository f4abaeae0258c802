"""The method of [Shi]: least squares, two-anchor fallback, inertial join."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Final

import numpy as np
from numpy.typing import NDArray

from fusion.messages import Floats
from fusion.ranging.inertial import Inertial, carried_on, joined, reset_if_worse
from fusion.ranging.two_anchors import choose, intersect

FLAT: Final = 0.4
"""Sine of the angle between two sights below which they cross too flatly to be used."""
SIGMAS: Final = 3.0
"""A range that is longer than the prediction by so many deviations has no line of sight."""


@dataclass(frozen=True, slots=True)
class PaperState:
    """What one epoch leaves to the next."""

    inertial: Inertial
    position: Floats  # (3,) m, the joined position


def standing(position: Floats) -> PaperState:
    """The start: at rest at a known place."""
    return PaperState(Inertial(position, np.zeros(3)), position)


def stepped(
    state: PaperState, anchors: Floats, range_m: Floats, sigma_m: float, acceleration: Floats, dt_s: float
) -> PaperState:
    """One epoch of three ranges (3,) and the acceleration (3,) since the last, in the room and freed of gravity.

    Line of sight to all: least squares. To two: their circles, chosen by the inertial prediction, else the last
    position. To fewer: the inertial prediction alone. Then the join by variances and, where σ_U < σ_I, the reset.
    """
    inertial = carried_on(state.inertial, acceleration, dt_s)
    sight = in_sight(anchors, range_m, inertial, sigma_m)
    if sight.sum() < 2:
        return PaperState(inertial, inertial.position)
    radio = _radio_position(anchors[sight], range_m[sight], inertial.position, state.position, sigma_m)
    if radio is None:
        return PaperState(inertial, state.position)
    position = joined(radio, sigma_m, inertial)
    # One direction of a flat crossing is the prediction itself: to reset by it would call the drift measured.
    flat = sight.sum() == 2 and _in_line(anchors[sight], inertial.position)
    return PaperState(inertial if flat else reset_if_worse(inertial, sigma_m, position), position)


def in_sight(anchors: Floats, range_m: Floats, inertial: Inertial, sigma_m: float) -> NDArray[np.bool_]:
    """Which anchors (A,) measure no more than the way to the prediction and 3 √(σ_U² + σ_I²): people only lengthen."""
    expected = np.linalg.norm(inertial.position - anchors, axis=1)
    return np.asarray(range_m - expected < SIGMAS * np.hypot(sigma_m, inertial.sigma_m))


def _radio_position(anchors: Floats, range_m: Floats, predicted: Floats, last: Floats, sigma_m: float) -> Floats | None:
    if len(anchors) > 2 or _in_line(anchors, predicted):
        return least_squares_position(anchors, range_m, predicted)
    near_m = 2 * SIGMAS * sigma_m
    return choose(intersect(anchors, range_m, float(last[2])), predicted, last, near_m, near_m)


def _in_line(anchors: Floats, position: Floats) -> bool:
    """Whether two anchors and the position stand nearly in one line.

    There the circles hardly cross, and their crossings jump aside by √(2 r σ); least squares from the prediction leaves
    that direction as predicted.
    """
    (x1, y1), (x2, y2) = anchors[:, :2] - position[:2]
    return bool(abs(x1 * y2 - x2 * y1) < FLAT * np.hypot(x1, y1) * np.hypot(x2, y2))


def least_squares_position(anchors: Floats, range_m: Floats, start: Floats) -> Floats:
    """Gauss-Newton in the plane of the start: p += U⁺ (r − |p − a|); a direction that nothing sees stays as it is."""
    position = np.array(start)
    for _ in range(8):
        away = position - anchors
        distance = np.linalg.norm(away, axis=1)
        position[:2] += np.linalg.pinv(away[:, :2] / distance[:, None], rcond=FLAT) @ (range_m - distance)
    return position
