"""The error statistics of [Du2016, Tables 1 and 2]: mean, standard deviation and interval per axis.

The paper's angles are φ = atan2(y, x) *about the optical axis* and θ = asin(z/r), both singular for a person straight
in front of the lens; kept only to make its tables again.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Final

import numpy as np

from fusion.messages import Floats

AXES: Final = ("x", "y", "z", "r", "φ", "θ")
UNITS: Final = ("mm", "mm", "mm", "mm", "rad", "rad")
_SCALE: Final = np.array([1e3, 1e3, 1e3, 1e3, 1.0, 1.0])


@dataclass(frozen=True, slots=True)
class ErrorLaw:
    """Figures by axis, in the order of `AXES`; millimetres for the first four, radians for the last two."""

    mean: tuple[float, ...]
    std: tuple[float, ...]
    largest: tuple[float, ...]
    """The largest error's size."""
    samples: int


TABLE_1: Final = ErrorLaw(
    (-15.4, -36.1, 16.0, 14.3, 0.01, 0.19), (45.6, 38.7, 54.1, 54.5, 0.03, 0.6), (200, 150, 200, 200, 0.1, 1), 0
)
"""[Du2016, Table 1]; its "variance (mm)" can only be a standard deviation, its interval is rounded up."""
TABLE_2: Final = ErrorLaw((0.0, 0.0, 0.0, 0.8, 0.00, 0.02), (36.7, 34.9, 40.6, 38.4, 0.02, 0.60), (), 0)
"""[Du2016, Table 2], after fusion."""


def error_law(measured: Floats, truth: Floats) -> ErrorLaw:
    """Statistics of `measured` less `truth`, both (N, 3) m in the frame of the sensor that the angles are about."""
    known = np.isfinite(measured).all(axis=1) & np.isfinite(truth).all(axis=1)
    errors = (spherical(measured[known]) - spherical(truth[known])) * _SCALE
    errors[:, 4] = (errors[:, 4] + np.pi) % (2 * np.pi) - np.pi
    return ErrorLaw(
        tuple(errors.mean(axis=0).tolist()),
        tuple(errors.std(axis=0).tolist()),
        tuple(np.abs(errors).max(axis=0).tolist()),
        int(known.sum()),
    )


def spherical(positions: Floats) -> Floats:
    """(N, 6) x, y, z, r in metres, φ and θ in radians, of (N, 3)."""
    x, y, z = positions.T
    r = np.linalg.norm(positions, axis=1)
    return np.stack([x, y, z, r, np.arctan2(y, x), np.arcsin(z / r)], axis=1)
