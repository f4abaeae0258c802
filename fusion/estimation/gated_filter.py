"""A constant-velocity Kalman filter for all joints at once, driven by white acceleration, with a gate.

State [p; v] per joint and axis. Measurement noise and process noise are the same on the three axes, so one 2×2
covariance [[pp, pv], [pv, vv]] serves all three. All arrays have the joints first.
"""

from __future__ import annotations

from dataclasses import dataclass, replace
from typing import Final

import numpy as np

from fusion.estimation.freshness import seconds_in_motion
from fusion.estimation.measurement import Flags
from fusion.messages import Floats
from fusion.skeleton import JOINT_COUNT

FRAME_S: Final = 1 / 30
ACCELERATION_STD: Final = 12.0
"""m/s² per 30 Hz frame; 12 to 25 serve, 6 lags behind a reaching hand [methods §5]. The calmest that serves."""
ACCELERATION_DENSITY: Final = ACCELERATION_STD**2 * FRAME_S  # m²/s³
START_SPEED_STD: Final = 1.0  # m/s


@dataclass(frozen=True, slots=True)
class Track:
    """Mean and covariance of every joint at `t_s`; a joint never seen has `seen_s` = -inf and NaN mean."""

    t_s: float
    position: Floats  # (J, 3) m
    velocity: Floats  # (J, 3) m/s
    pp: Floats  # (J,) m²
    pv: Floats  # (J,) m²/s
    vv: Floats  # (J,) m²/s²
    seen_s: Floats  # (J,) time of the last measurement that was used


def unseen(t_s: float) -> Track:
    """The track before anything was seen."""
    nowhere = np.full((JOINT_COUNT, 3), np.nan)
    zero = np.zeros(JOINT_COUNT)
    return Track(t_s, nowhere, np.zeros((JOINT_COUNT, 3)), zero, zero, zero, np.full(JOINT_COUNT, -np.inf))


def predict(track: Track, t_s: float) -> Track:
    """Move on to `t_s`: p + v dt, P → F P F' + Q, with the mean halted three frames after the last measurement.

    Q = q [[dt³/3, dt²/2], [dt²/2, dt]], q = a²/30 Hz for a white acceleration of a per frame. The covariance grows
    through the whole silence, the mean does not fly off.
    """
    dt = t_s - track.t_s
    if not 0 < dt < np.inf:  # an older sample, or the very first
        return replace(track, t_s=max(t_s, track.t_s))
    moving_s = seconds_in_motion(track.seen_s, track.t_s, t_s)[:, None]
    q = ACCELERATION_DENSITY
    return Track(
        t_s,
        track.position + track.velocity * moving_s,
        np.where(moving_s > 0, track.velocity, 0.0),
        track.pp + 2 * dt * track.pv + dt**2 * track.vv + q * dt**3 / 3,
        track.pv + dt * track.vv + q * dt**2 / 2,
        track.vv + q * dt,
        track.seen_s,
    )


def carried_on(track: Track, positions: Floats, t_s: float) -> Floats:
    """(J, 3) m, positions measured at `t_s`, a little before the track's own time, moved on with its velocity."""
    late_s = max(track.t_s - t_s, 0.0)
    return positions + np.where(np.isfinite(track.position), track.velocity, 0.0) * late_s


def sigmas_off(track: Track, positions: Floats, variance: Floats) -> Floats:
    """(J,) how far a measurement is from its prediction on its worst axis, in standard deviations of the difference.

    Axis by axis, because that is what a number of sigmas is said of: a distance in three dimensions exceeds 4 twenty
    times as often as one axis does.
    """
    worst: Floats = np.abs(positions - track.position).max(axis=1)
    return worst / np.sqrt(track.pp + variance)


def correct(track: Track, positions: Floats, variance: Floats, used: Flags) -> Track:
    """Take the measurements of the joints in `used`; `variance` (J,) m² is that of one axis."""
    gain = np.where(used, 1.0, 0.0) / (track.pp + np.where(used, variance, 1.0))
    gain_p, gain_v = gain * track.pp, gain * track.pv
    innovation = np.where(used[:, None], positions - track.position, 0.0)
    return Track(
        track.t_s,
        track.position + gain_p[:, None] * innovation,
        track.velocity + gain_v[:, None] * innovation,
        (1 - gain_p) * track.pp,
        (1 - gain_p) * track.pv,
        track.vv - gain_v * track.pv,
        np.where(used, track.t_s, track.seen_s),
    )


def start(track: Track, positions: Floats, variance: Floats, which: Flags) -> Track:
    """Begin the joints in `which` at the measurement, at rest."""
    if not which.any():
        return track
    return replace(
        track,
        position=np.where(which[:, None], positions, track.position),
        velocity=np.where(which[:, None], 0.0, track.velocity),
        pp=np.where(which, variance, track.pp),
        pv=np.where(which, 0.0, track.pv),
        vv=np.where(which, START_SPEED_STD**2, track.vv),
        seen_s=np.where(which, track.t_s, track.seen_s),
    )
