"""What an inertial sensor beside a tag says of its way: how fast and how far it was pushed between two instants."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from fusion.messages import Floats


@dataclass(frozen=True, slots=True)
class Push:
    """What acceleration did between two instants, in an earth frame that is level and points anywhere."""

    velocity_m_s: Floats  # (3,) ∫ a
    displacement_m: Floats  # (3,) ∫∫ a: beyond what the velocity at the beginning does


@dataclass(frozen=True, slots=True)
class Pushes:
    """Acceleration, integrated once and twice from the beginning, so that any interval costs a difference."""

    t_s: Floats  # (N,) rising
    velocity_m_s: Floats  # (N, 3)
    displacement_m: Floats  # (N, 3)
    heading_rad: float | None = None
    """What takes the earth frame into the room; None where it must be found."""

    def between(self, from_s: float, to_s: float) -> Push | None:
        """V(t₁) − V(t₀) and S(t₁) − S(t₀) − V(t₀) (t₁ − t₀); None where the sensor said nothing."""
        if from_s < self.t_s[0] or to_s > self.t_s[-1]:
            return None
        (v0, v1), (s0, s1) = (self._at(values, from_s, to_s) for values in (self.velocity_m_s, self.displacement_m))
        return Push(v1 - v0, s1 - s0 - v0 * (to_s - from_s))

    def _at(self, values: Floats, from_s: float, to_s: float) -> Floats:  # (2, 3)
        return np.stack([np.interp([from_s, to_s], self.t_s, column) for column in values.T], axis=-1)


def integrated(t_s: Floats, acceleration: Floats, heading_rad: float | None = None) -> Pushes:
    """Trapezoids over accelerations (N, 3) m/s² in an earth frame, freed of gravity."""
    step_s = np.diff(t_s)[:, None]
    velocity = _summed(0.5 * (acceleration[1:] + acceleration[:-1]) * step_s)
    moved = velocity[:-1] * step_s + (acceleration[:-1] / 3 + acceleration[1:] / 6) * step_s**2
    return Pushes(t_s, velocity, _summed(moved), heading_rad)


def _summed(steps: Floats) -> Floats:
    return np.concatenate([np.zeros((1, 3)), np.cumsum(steps, axis=0)])
