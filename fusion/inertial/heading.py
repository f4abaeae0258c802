"""Headings without magnetometer, and the elbow's axis, from what a joint cannot do.

An elbow turns about its hinge j1 (fixed in the upper arm) and about the forearm's long axis j2, and not about
n = j1 × j2. So the difference of the segments' angular velocities has no part along n, at every instant:
``(Rz(δ) ω2 − ω1) · n = 0`` with everything in the earth frames of the two filters, which differ by the heading δ.
Least squares over a recording give j1 and δ together [1, 2, 3]; a wrist, which does not turn about the forearm's long
axis, gives its δ in the same way.

[1] T. Seel, J. Raisch, T. Schauer: IMU-based joint angle measurement for gait analysis. Sensors 14 (2014) 6891–6909.
[2] D. Laidig, P. Müller, T. Seel: Automatic anatomical calibration for IMU-based elbow angle measurement in disturbed
    magnetic fields. Current Directions in Biomedical Engineering 3 (2017) 167–170.
[3] F. Olsson, M. Kok, T. Seel, K. Halvorsen: Robust plug-and-play joint axis estimation using inertial sensors.
    Sensors 20 (2020) 3534 (for the robust loss).
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from typing import Final

import numpy as np
from scipy.optimize import OptimizeResult, least_squares
from scipy.signal import butter, sosfiltfilt
from scipy.spatial.transform import Rotation

from fusion.errors import InputError
from fusion.geometry import Floats
from fusion.inertial.orientation import Oriented

CUTOFF_HZ: Final = 5.0
"""Arms move below this; skin and straps above it."""
EVERY_S: Final = 0.1
KNOT_S: Final = 20.0
"""The heading is a line between instants this far apart."""
DRIFT_RAD: Final = np.radians(2.0)
"""How far a heading may drift from knot to knot (one sigma)."""
NOISE_RAD_S: Final = 0.3
"""What skin, straps and joints that are not ideal leave of the constraint (one sigma)."""
CORRELATED: Final = 5.0
"""So many residuals in a row say the same thing."""
LEAST_RATE_RAD_S: Final = 0.15
"""Root mean square of the relative angular velocity below which a joint has not moved enough to be learnt from."""
LEAST_ALIGNED: Final = 0.3
"""Where hinge and long axis are nearly parallel their cross product points anywhere, and counts less."""


@dataclass(frozen=True, slots=True)
class Heading:
    """The heading δ that takes the child's earth frame into the parent's, over time."""

    offset_rad: Floats  # (T,)

    def rotation(self) -> Rotation:
        """(T,) turns about up."""
        return _about_up(self.offset_rad)


@dataclass(frozen=True, slots=True)
class Hinge:
    """The elbow's flexion axis in the upper arm's sensor, and the forearm's heading."""

    axis: Floats  # (3,) in the sensor of the upper arm; its sign is open
    heading: Heading


@dataclass(frozen=True, slots=True)
class _Pair:
    """Two neighbouring segments at the instants that are used for fitting."""

    t_s: Floats  # (N,)
    parent_rate: Floats  # (N, 3) rad/s in the parent's earth frame
    child_rate: Floats  # (N, 3) rad/s in the child's earth frame
    parent: Rotation  # (N,)
    child: Rotation  # (N,)


def find_hinge(parent: Oriented, child: Oriented, parent_long: Floats, child_long: Floats) -> Hinge:
    """Find the hinge axis and the heading from movement.

    Args:
        parent: the upper arm's sensor.
        child: the forearm's sensor, on the same clock.
        parent_long: (3,) the upper arm's long axis in its sensor.
        child_long: (3,) the forearm's long axis in its sensor.

    Raises:
        InputError: the elbow hardly moved.
    """
    pair = _pair(parent, child)
    across, ahead = _across(parent_long)

    def axis(azimuth: float, tilt: float) -> Floats:
        flat: Floats = np.cos(azimuth) * across + np.sin(azimuth) * ahead
        tilted: Floats = np.cos(tilt) * flat + np.sin(tilt) * parent_long
        return tilted

    def residual(parameters: Floats) -> Floats:
        turn = _about_up(_line(pair.t_s, parameters[2:]))
        hinge = pair.parent.apply(axis(parameters[0], parameters[1]))
        long = turn.apply(pair.child.apply(child_long))
        return _forbidden_rate(pair, turn, np.cross(hinge, long))

    # The axis' sign is open, so half a turn of azimuth is enough to start from.
    starts = [np.array([a, 0.0, d]) for a in np.arange(4) * np.pi / 4 for d in np.arange(6) * np.pi / 3]
    rough = _best(residual, starts)
    fine = _fit(residual, np.concatenate([rough.x[:2], np.full(_knots(pair.t_s), rough.x[2])]), fixed=2)
    return Hinge(axis(*fine.x[:2]), _heading(parent.t_s, pair.t_s, fine.x[2:]))


def find_wrist_heading(parent: Oriented, child: Oriented, parent_long: Floats) -> Heading:
    """Find the hand's heading: a wrist does not turn about the forearm's long axis.

    Raises:
        InputError: the hand hardly moved.
    """
    pair = _pair(parent, child)
    long = pair.parent.apply(parent_long)

    def residual(parameters: Floats) -> Floats:
        return _forbidden_rate(pair, _about_up(_line(pair.t_s, parameters)), long)

    rough = _best(residual, [np.array([d]) for d in np.arange(6) * np.pi / 3])
    fine = _fit(residual, np.full(_knots(pair.t_s), rough.x[0]), fixed=0)
    return _heading(parent.t_s, pair.t_s, fine.x)


def _pair(parent: Oriented, child: Oriented) -> _Pair:
    step_s = float(parent.t_s[1] - parent.t_s[0])
    every = slice(None, None, max(1, round(EVERY_S / step_s)))
    rate, child_rate = (_smooth(one.sensor_to_earth.apply(one.rate_rad_s), step_s)[every] for one in (parent, child))
    moved = np.sqrt(np.mean(np.sum(rate**2 + child_rate**2, axis=1)) / 2)
    if moved < LEAST_RATE_RAD_S:
        what = f"'{parent.site}' and '{child.site}' hardly moved ({moved:.2f} rad/s)"
        raise InputError(what, "some seconds of bending and turning the arm", "record the movement too")
    return _Pair(parent.t_s[every], rate, child_rate, parent.sensor_to_earth[every], child.sensor_to_earth[every])


def _smooth(rate: Floats, step_s: float) -> Floats:
    if step_s * CUTOFF_HZ > 0.4:  # slower sensors have nothing above the cut-off
        return rate
    low_pass = butter(2, CUTOFF_HZ * 2 * step_s, output="sos")
    smooth: Floats = sosfiltfilt(low_pass, rate, axis=0)
    return smooth


def _across(long: Floats) -> tuple[Floats, Floats]:
    """Two unit vectors that complete a long axis to a frame."""
    helper = np.eye(3)[np.argmin(np.abs(long))]
    across = np.cross(long, helper)
    across /= np.linalg.norm(across)
    return across, np.cross(long, across)


def _forbidden_rate(pair: _Pair, turn: Rotation, direction: Floats) -> Floats:
    length = np.maximum(np.linalg.norm(direction, axis=1), LEAST_ALIGNED)
    relative = turn.apply(pair.child_rate) - pair.parent_rate
    rate: Floats = np.sum(relative * direction, axis=1) / length
    return rate


def _best(residual: Callable[[Floats], Floats], starts: list[Floats]) -> OptimizeResult:
    fits = [least_squares(residual, start, loss="soft_l1", f_scale=NOISE_RAD_S) for start in starts]
    return min(fits, key=lambda fit: float(fit.cost))


def _fit(residual: Callable[[Floats], Floats], start: Floats, fixed: int) -> OptimizeResult:
    """Fit with a heading that drifts as a random walk from knot to knot."""
    scale = 1.0 / (NOISE_RAD_S * np.sqrt(CORRELATED))

    def with_drift(parameters: Floats) -> Floats:
        return np.concatenate([residual(parameters) * scale, np.diff(parameters[fixed:]) / DRIFT_RAD])

    return least_squares(with_drift, start, loss="soft_l1")


def _knots(t_s: Floats) -> int:
    return 1 + max(1, round(float(t_s[-1] - t_s[0]) / KNOT_S))


def _line(t_s: Floats, knots: Floats) -> Floats:
    return np.interp(t_s, np.linspace(t_s[0], t_s[-1], len(knots)), knots)


def _about_up(angle_rad: Floats) -> Rotation:
    return Rotation.from_rotvec(angle_rad[:, None] * np.array([0.0, 0.0, 1.0]))


def _heading(t_s: Floats, fitted_t_s: Floats, knots: Floats) -> Heading:
    at = np.linspace(fitted_t_s[0], fitted_t_s[-1], len(knots))
    return Heading(np.interp(t_s, at, knots))
