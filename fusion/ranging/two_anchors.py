"""What is left when only two anchors are in sight: two circles, and a prediction that chooses [Shi, fig. 2]."""

from __future__ import annotations

import numpy as np

from fusion.messages import Floats


def intersect(anchors: Floats, ranges_m: Floats, height_m: float) -> Floats:
    """The points of the plane z = height at the two ranges, (2, 3); both equal where the circles only touch or miss.

    In the plane ρ_i² = r_i² − (h − z_i)²; along the line between the anchors, d apart,
    a = (ρ_1² − ρ_2² + d²) / 2d, and to either side b = √max(ρ_1² − a², 0).

    Args:
        anchors: (2, 3) m.
        ranges_m: (2,) m.
        height_m: the tag's height.
    """
    flat_squared = np.maximum(ranges_m**2 - (height_m - anchors[:, 2]) ** 2, 0.0)
    between = anchors[1, :2] - anchors[0, :2]
    apart_m = float(np.hypot(*between))
    along = between / apart_m
    a = (flat_squared[0] - flat_squared[1] + apart_m**2) / (2 * apart_m)
    b = np.sqrt(max(flat_squared[0] - a**2, 0.0))
    foot, aside = anchors[0, :2] + a * along, b * np.array([-along[1], along[0]])
    return np.array([[*(foot + aside), height_m], [*(foot - aside), height_m]])


def choose(candidates: Floats, predicted: Floats, last: Floats, near_m: float, reach_m: float) -> Floats | None:
    """The position with two anchors [Shi]: the intersection by the prediction, else the last position.

    The inertial prediction counts if it is near the last position and within the two anchors' reach, that is, near one
    of the intersections; then that intersection is the position. Otherwise None: keep the last position.

    Args:
        candidates: (2, 3) from `intersect`.
        predicted: (3,) the inertial prediction.
        last: (3,) the last position.
        near_m: how far the inertial prediction may be from the last position.
        reach_m: how far it may be from the nearer intersection.
    """
    away_m = np.linalg.norm(candidates - predicted, axis=1)
    if np.linalg.norm(predicted - last) > near_m or away_m.min() > reach_m:
        return None
    return np.asarray(candidates[int(away_m.argmin())])
