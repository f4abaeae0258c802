"""A sensor's error box in range, azimuth and elevation, turned into three strips along the room's axes [methods §5]."""

from __future__ import annotations

from typing import Final

import numpy as np

from fusion.messages import AlignedSample, Floats

NEAREST_M: Final = 0.5
"""No sensor sees a body nearer than this; keeps the angles of a bad point finite."""


def half_width_in_room(sample: AlignedSample, positions: Floats, half_width: Floats) -> Floats:
    """(J, 3) m, half-widths along the room's axes of strips around each measured point that hold its error box.

    Azimuth is atan2(x, z) and elevation asin(y/r) in the sensor's frame. The box is r ± ρ, azimuth ± a, elevation ± b
    with a and b the given metres seen at the range r. Its curvature widens it, along its own three axes, to

        range      r - (r-ρ)(cos a + cos b - 1)
        azimuth    (r+ρ) sin a
        elevation  (r+ρ)(sin b + |sin el| (1 - cos a))

    which depends on the measurement and never on what was predicted.

    Args:
        sample: for where the sensor stands and looks.
        positions: (J, 3) m in room, finite.
        half_width: (J, 3) m, half the box along range, across and up.
    """
    line = (positions - sample.lens_in_room) @ sample.rotation_sensor_to_room  # in sensor
    line[:, 2] = np.where(np.hypot(line[:, 0], line[:, 2]) < NEAREST_M, NEAREST_M, line[:, 2])
    flat = np.hypot(line[:, 0], line[:, 2])
    r = np.hypot(flat, line[:, 1])
    axes_in_room = _axes(line, flat, r) @ sample.rotation_sensor_to_room.T
    in_room: Floats = np.einsum("jk,jka->ja", _widened(r, flat, line[:, 1] / r, half_width), np.abs(axes_in_room))
    return in_room


def _axes(line: Floats, flat: Floats, r: Floats) -> Floats:
    """(J, 3, 3) unit vectors of growing range, azimuth and elevation, in the sensor's frame."""
    sin_az, cos_az = line[:, 0] / flat, line[:, 2] / flat
    sin_el, cos_el = line[:, 1] / r, flat / r
    zero = np.zeros_like(flat)
    along = [cos_el * sin_az, sin_el, cos_el * cos_az]
    across = [cos_az, zero, -sin_az]
    up = [-sin_el * sin_az, cos_el, -sin_el * cos_az]
    return np.array([along, across, up]).transpose(2, 0, 1)


def _widened(r: Floats, flat: Floats, sin_el: Floats, half_width: Floats) -> Floats:
    rho = half_width[:, 0]
    a = np.minimum(half_width[:, 1] / flat, np.pi / 2)
    b = np.minimum(half_width[:, 2] / r, np.pi / 2)
    along = r - np.maximum(r - rho, 0.0) * np.maximum(np.cos(a) + np.cos(b) - 1, 0.0)
    across = (r + rho) * np.sin(a)
    up = (r + rho) * (np.sin(b) + np.abs(sin_el) * (1 - np.cos(a)))
    return np.array([along, across, up]).T
