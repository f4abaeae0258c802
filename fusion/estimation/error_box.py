"""A sensor's error box in range, azimuth and elevation, turned into three strips along the room's axes."""

from __future__ import annotations

from math import cos, hypot, pi, sin
from typing import Final

from fusion.compiled import kernel
from fusion.estimation.vectors import Vector
from fusion.messages import Floats

NEAREST_M: Final = 0.5
"""No sensor sees a body nearer than this; keeps the angles of a bad point finite."""


@kernel
def half_width_in_room(from_lens: Vector, rotation_sensor_to_room: Floats, half_width: Vector) -> Vector:
    """Half-widths in metres along the room's axes of strips around a measured point that hold its error box.

    Azimuth is atan2(x, z) and elevation asin(y/r) in the sensor's frame. The box is r ± ρ, azimuth ± a, elevation ± b
    with a and b the given metres seen at the range r. Its curvature widens it, along its own three axes, to

        range      r - (r-ρ)(cos a + cos b - 1)
        azimuth    (r+ρ) sin a
        elevation  (r+ρ)(sin b + |sin el| (1 - cos a))

    which depends on the measurement and never on what was predicted.

    Args:
        from_lens: from the lens to the point, in room, m, finite.
        rotation_sensor_to_room: (3, 3) R, whose columns are the sensor's axes in the room.
        half_width: half the box along range, across and up, m.
    """
    x, y, z = _in_sensor(from_lens, rotation_sensor_to_room)
    if hypot(x, z) < NEAREST_M:
        z = NEAREST_M
    flat = hypot(x, z)
    r = hypot(flat, y)
    sin_az, cos_az, sin_el, cos_el = x / flat, z / flat, y / r, flat / r
    range_m, across_m, up_m = _curved(r, flat, sin_el, half_width)
    along = _in_room((cos_el * sin_az, sin_el, cos_el * cos_az), rotation_sensor_to_room)
    across = _in_room((cos_az, 0.0, -sin_az), rotation_sensor_to_room)
    up = _in_room((-sin_el * sin_az, cos_el, -sin_el * cos_az), rotation_sensor_to_room)
    return (
        range_m * abs(along[0]) + across_m * abs(across[0]) + up_m * abs(up[0]),
        range_m * abs(along[1]) + across_m * abs(across[1]) + up_m * abs(up[1]),
        range_m * abs(along[2]) + across_m * abs(across[2]) + up_m * abs(up[2]),
    )


@kernel
def _curved(r: float, flat: float, sin_el: float, half_width: Vector) -> Vector:
    rho, a, b = half_width[0], min(half_width[1] / flat, pi / 2), min(half_width[2] / r, pi / 2)
    return (
        r - max(r - rho, 0.0) * max(cos(a) + cos(b) - 1, 0.0),
        (r + rho) * sin(a),
        (r + rho) * (sin(b) + abs(sin_el) * (1 - cos(a))),
    )


@kernel
def _in_sensor(a: Vector, R: Floats) -> Vector:
    """R' a."""
    return (
        R[0, 0] * a[0] + R[1, 0] * a[1] + R[2, 0] * a[2],
        R[0, 1] * a[0] + R[1, 1] * a[1] + R[2, 1] * a[2],
        R[0, 2] * a[0] + R[1, 2] * a[1] + R[2, 2] * a[2],
    )


@kernel
def _in_room(a: Vector, R: Floats) -> Vector:
    """R a."""
    return (
        R[0, 0] * a[0] + R[0, 1] * a[1] + R[0, 2] * a[2],
        R[1, 0] * a[0] + R[1, 1] * a[1] + R[1, 2] * a[2],
        R[2, 0] * a[0] + R[2, 1] * a[1] + R[2, 2] * a[2],
    )
