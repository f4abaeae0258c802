"""Where a joint's centre is in the sensors on both sides of it, from movement alone.

Both segments share the joint's acceleration. With a the specific force in a sensor and r the way from it to the
centre, a + ω × (ω × r) + ω̇ × r is the force at the centre, of the same size from both sides; at a shoulder that keeps
still it is gravity's. Least squares over a recording give r, whatever the headings (T. Seel, T. Schauer, J. Raisch:
Joint axis and position estimation from inertial measurement data by exploiting kinematic constraints. IEEE CCA 2012).
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from typing import Final

import numpy as np
from scipy.optimize import least_squares
from scipy.signal import butter, sosfiltfilt

from fusion.geometry import Floats, skew
from fusion.inertial.orientation import GRAVITY_M_S2, Oriented

CUTOFF_HZ: Final = 6.0
EVERY_S: Final = 0.05
NOISE_M_S2: Final = 0.3
STARTS_M: Final = (0.0, 0.1, -0.1)


@dataclass(frozen=True, slots=True)
class Centre:
    """A joint's centre."""

    in_parent_m: Floats  # (3,) from the sensor, in its axes
    in_child_m: Floats  # (3,)
    left_m_s2: float
    """Root mean square of what the fit leaves."""


def shared_centre(parent: Oriented, child: Oriented) -> Centre:
    """The centre of the joint between two segments on one clock."""
    (one, turns_one), (other, turns_other) = _forces(parent), _forces(child)

    def left(r: Floats) -> Floats:
        return _size(one + turns_one @ r[:3]) - _size(other + turns_other @ r[3:])

    found, left_m_s2 = _best(left, 6)
    return Centre(found[:3], found[3:], left_m_s2)


def still_centre(child: Oriented) -> Centre:
    """The centre of a joint that keeps its place, as a shoulder does while somebody sits; the parent is the room."""
    force, turns = _forces(child)
    found, left_m_s2 = _best(lambda r: _size(force + turns @ r) - GRAVITY_M_S2, 3)
    return Centre(np.zeros(3), found, left_m_s2)


def _forces(segment: Oriented) -> tuple[Floats, Floats]:
    """Specific force (N, 3) and [ω]×² + [ω̇]× (N, 3, 3), smoothed."""
    step_s = float(segment.t_s[1] - segment.t_s[0])
    low_pass = butter(2, min(CUTOFF_HZ * 2 * step_s, 0.9), output="sos")
    rate, force = (sosfiltfilt(low_pass, values, axis=0) for values in (segment.rate_rad_s, segment.up))
    turning = skew(rate) @ skew(rate) + skew(np.gradient(rate, step_s, axis=0))
    every = slice(None, None, max(1, round(EVERY_S / step_s)))
    return force[every], turning[every]


def _size(vectors: Floats) -> Floats:
    length: Floats = np.linalg.norm(vectors, axis=1)
    return length


def _best(left: Callable[[Floats], Floats], unknowns: int) -> tuple[Floats, float]:
    fits = [least_squares(left, np.full(unknowns, s), loss="soft_l1", f_scale=NOISE_M_S2) for s in STARTS_M]
    best: Floats = min(fits, key=lambda fit: float(fit.cost)).x
    return best, float(np.sqrt(np.mean(left(best) ** 2)))
