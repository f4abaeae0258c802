"""Inertial displacement, and its join with a radio position by their variances [Shi]."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Final

from fusion.messages import Floats

ACCELERATION_SIGMA_M_S2: Final = 0.05
"""The accelerometer's deviation that the paper resets to."""


@dataclass(frozen=True, slots=True)
class Inertial:
    """Dead reckoning since the last reset."""

    position: Floats  # (3,) m
    velocity: Floats  # (3,) m/s
    since_reset_s: float = 0.0

    @property
    def sigma_m(self) -> float:
        """σ_I = ½ · 0.05 · t², with t since the reset; per axis. The paper's formula is lost; this is ours."""
        return 0.5 * ACCELERATION_SIGMA_M_S2 * self.since_reset_s**2


def carried_on(inertial: Inertial, acceleration: Floats, dt_s: float) -> Inertial:
    """P += v dt + ½ a dt², v += a dt, with a (3,) m/s² in the world frame and freed of gravity."""
    position = inertial.position + inertial.velocity * dt_s + 0.5 * acceleration * dt_s**2
    velocity = inertial.velocity + acceleration * dt_s
    return Inertial(position, velocity, inertial.since_reset_s + dt_s)


def joined(radio: Floats, radio_sigma_m: float, inertial: Inertial) -> Floats:
    """X = (σ_I² x_U + σ_U² x_I) / (σ_I² + σ_U²) per axis; radio alone where both claim to be exact."""
    trust, doubt = inertial.sigma_m**2, radio_sigma_m**2
    if trust + doubt == 0:
        return radio
    return (trust * radio + doubt * inertial.position) / (trust + doubt)


def reset_if_worse(inertial: Inertial, radio_sigma_m: float, joined_position: Floats) -> Inertial:
    """Start the inertial deviation afresh where σ_U(n) < σ_I(n−1): the reckoning goes on from the joined position.

    Its velocity is mended by what it was off by since the last reset, v += (x − x_I) / t: the paper leaves the
    velocity open, and uncorrected it would make the position drift without bound. So σ_I never exceeds σ_U by more than
    one step's growth while the radio is good.

    Args:
        inertial: the dead reckoning.
        radio_sigma_m: σ_U of the radio position at this instant.
        joined_position: (3,) m, what both said together.
    """
    if radio_sigma_m >= inertial.sigma_m:
        return inertial
    velocity = inertial.velocity + (joined_position - inertial.position) / inertial.since_reset_s
    return Inertial(joined_position, velocity)
