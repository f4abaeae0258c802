"""The extended set-membership filter letter by letter as [Du2016 §2.4] prints it; never used, only shown to fail.

One joint: x = [p; v], p+ = p + v dt, v+ = v + w. It measures range, azimuth and elevation (the paper's own angles are
singular before the lens). The remainder of the linearised h is bounded over the predicted set.
"""

from __future__ import annotations

from dataclasses import dataclass, replace
from typing import Final

import numpy as np

from fusion.messages import Floats

ACCELERATION_MAX: Final = 20.0
START_SPEED_MAX: Final = 1.0
NEAREST_M: Final = 0.05
"""A set that reaches past the lens has no bounded remainder any more; this stands for that."""
HOLDS_BOX: Final = 3.0
"""An ellipsoid that holds a box of three sides has three times the squares of its half sides."""


@dataclass(frozen=True, slots=True)
class LiteralState:
    """E(centre, shape) of one joint."""

    centre: Floats  # (6,) m, m/s
    shape: Floats  # (6, 6)


@dataclass(frozen=True, slots=True)
class Sensor:
    """Where a sensor stands and how large its noise may be."""

    position: Floats  # (3,) m
    rotation: Floats  # (3, 3) sensor to room
    bound_m: float

    def measure(self, position: Floats) -> Floats:
        """(3,) range, azimuth atan2(x, z), elevation asin(y/r) of a point of the room."""
        x, y, z = (position - self.position) @ self.rotation
        r = float(np.sqrt(x * x + y * y + z * z))
        return np.array([r, np.arctan2(x, z), np.arcsin(y / r)])

    def slope(self, position: Floats) -> Floats:
        """(3, 3) its derivative."""
        x, y, z = (position - self.position) @ self.rotation
        flat2 = x * x + z * z
        r2 = flat2 + y * y
        flat, r = np.sqrt(flat2), np.sqrt(r2)
        in_sensor = np.array(
            [[x / r, y / r, z / r], [z / flat2, 0, -x / flat2], [-x * y / (r2 * flat), flat / r2, -y * z / (r2 * flat)]]
        )
        slope: Floats = in_sensor @ self.rotation.T
        return slope


def started(position: Floats, bound_m: float) -> LiteralState:
    """At a measured place, at any speed."""
    squares = np.repeat([HOLDS_BOX * bound_m**2, HOLDS_BOX * START_SPEED_MAX**2], 3)
    return LiteralState(np.concatenate([position, np.zeros(3)]), np.diag(squares))


def predicted(state: LiteralState, dt: float) -> LiteralState:
    """Equations (9) and (10), β_Q = √tr Q / (√tr A P A' + √tr Q) (the paper's lost a "tr")."""
    step = np.eye(6)
    step[:3, 3:] = dt * np.eye(3)
    moved = step @ state.shape @ step.T
    added = np.diag([0.0] * 3 + [HOLDS_BOX * (ACCELERATION_MAX * dt) ** 2] * 3)
    b = np.sqrt(np.trace(added)) / (np.sqrt(np.trace(moved)) + np.sqrt(np.trace(added)))
    return LiteralState(step @ state.centre, moved / (1 - b) + added / b)


def updated(state: LiteralState, sensor: Sensor, measured: Floats, mended_gain: bool) -> tuple[LiteralState, bool]:
    """Equations (7), (8) and (11); says whether the measurement was taken (δ <= 1).

    Args:
        state: predicted to the measurement's time.
        sensor: which measured.
        measured: (3,) range, azimuth, elevation.
        mended_gain: K = B C' W, the set's centre, instead of the printed K = P C' W.
    """
    C = np.zeros((3, 6))
    C[:, :3] = sensor.slope(state.centre[:3])
    R = _widened(state, sensor)
    P = state.shape
    p_m, r_m = np.linalg.norm(C @ P @ C.T, 2), np.linalg.norm(R, 2)
    rho = np.sqrt(r_m) / (np.sqrt(p_m) + np.sqrt(r_m))
    B = P / (1 - rho)
    W = np.linalg.inv(C @ B @ C.T + R / rho)
    d = measured - sensor.measure(state.centre[:3])
    d[1] = (d[1] + np.pi) % (2 * np.pi) - np.pi
    delta = float(d @ W @ d)
    if delta > 1:
        return state, False
    gain = (B if mended_gain else P) @ C.T @ W
    shape = (1 - delta) * (B - B @ C.T @ W @ C @ B)
    return replace(state, centre=state.centre + gain @ d, shape=(shape + shape.T) / 2), True


def _widened(state: LiteralState, sensor: Sensor) -> Floats:
    """R' of equation (8): the noise's ellipsoid and that of the remainder of h over the predicted set.

    Half the largest second derivative times the squared reach δ of the set: 1/r for the range, 1/ρ² for the angles,
    at the point of the set that is nearest to the lens.
    """
    reach = float(np.sqrt(np.linalg.eigvalsh(state.shape[:3, :3])[-1]))
    away = (state.centre[:3] - sensor.position) @ sensor.rotation
    r = max(float(np.linalg.norm(away)), NEAREST_M)
    nearest = max(float(np.hypot(away[0], away[2])) - reach, NEAREST_M)
    remainder = HOLDS_BOX * (0.5 * reach**2 * np.array([1 / nearest, 1 / nearest**2, 1 / nearest**2])) ** 2
    noise = HOLDS_BOX * (sensor.bound_m * np.array([1.0, 1 / r, 1 / r])) ** 2
    a, b = np.sqrt(remainder.sum()), np.sqrt(noise.sum())
    share = b / (a + b)
    return np.diag(remainder / (1 - share) + noise / share)
