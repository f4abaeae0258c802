"""The regulator's law, a thousand times a second: compiled, because Python would take longer than the physics.

Arrays hold a number per joint (n,); those of several quantities have a row for each.
"""

from __future__ import annotations

from math import tanh
from typing import Final

import numpy as np

from fusion.compiled import kernel
from fusion.messages import Floats

CARRIED_S: Final = 0.02
"""A set-point is carried on for so long, as its velocity and acceleration say: one tick and one that is missed."""
RAMP_RAD_S2: Final = 10.0
"""Then it comes to rest with this deceleration, whether or not a command will come: the drive's watchdog (SR-3)."""
KNOWN_FRICTION: Final = 0.8
"""Share of the friction that the drive knows."""
STICTION_RAD_S: Final = 0.02
"""Friction is taken to be fully developed from a few times this velocity."""
FILTER_S: Final = 0.02
"""Time constant with which angle, velocity and torque are smoothed before the arm's share is taken from them."""

ANGLE, VELOCITY, ACCELERATION, PLACE = range(4)
"""Rows of the set-point: as commanded and carried on; PLACE follows ANGLE no faster than the joint may go."""
STIFFNESS, DAMPING, BOUND, SHARE = range(4)
"""Rows of the gains."""
LOW, HIGH, FASTEST, STRONGEST, COULOMB, VISCOUS = range(6)
"""Rows of what the drive knows of its joints."""
WEIGHT, INERTIA = range(2)
"""Rows of the load as believed."""
TORQUE = 2
"""Row of what is smoothed, beside ANGLE and VELOCITY."""


@kernel
def carry_on(wanted: Floats, joints: Floats, since_s: float, dt_s: float) -> None:
    """Move the set-point on by `dt_s`; its last command came `since_s` ago.

    Args:
        wanted: (4, n) the set-point, changed in place.
        joints: (6, n) what the drive knows of its joints.
        since_s: time since the last command.
        dt_s: the step.
    """
    for i in range(wanted.shape[1]):
        if since_s <= CARRIED_S:
            wanted[VELOCITY, i] += wanted[ACCELERATION, i] * dt_s
        else:
            slower = max(abs(wanted[VELOCITY, i]) - RAMP_RAD_S2 * dt_s, 0.0)
            wanted[VELOCITY, i] = slower if wanted[VELOCITY, i] > 0 else -slower
            wanted[ACCELERATION, i] = 0.0
        there = wanted[ANGLE, i] + wanted[VELOCITY, i] * dt_s
        wanted[ANGLE, i] = min(max(there, joints[LOW, i]), joints[HIGH, i])
        if wanted[ANGLE, i] != there:
            wanted[VELOCITY, i] = 0.0
        way, most = wanted[ANGLE, i] - wanted[PLACE, i], joints[FASTEST, i] * dt_s
        wanted[PLACE, i] += min(max(way, -most), most)


@kernel
def torques(
    measured: Floats, wanted: Floats, gains: Floats, joints: Floats, load: Floats, smooth: Floats, dt_s: float
) -> Floats:
    """The motors' torque (n,) for the next step, and what is remembered to tell the arm's share of it.

    τ = clip(K (x_w − x) + D (v_w − v) + inertia, ± bound) + weight + friction, inside what the motor can give.
    Friction is overcome for the wanted movement, as far as it is the drive's. Overcoming it for the arm's own would set
    free what the drive does not know of the weight.

    Args:
        measured: (2, n) the motors' angle and velocity.
        wanted: (4, n) the set-point.
        gains: (4, n).
        joints: (6, n).
        load: (2, n) as believed.
        smooth: (3, n) the smoothed angle, velocity and torque, changed in place.
        dt_s: the step.
    """
    torque, kept = np.empty(measured.shape[1]), dt_s / FILTER_S
    for i in range(measured.shape[1]):
        velocity, share = measured[VELOCITY, i], gains[SHARE, i]
        effort = (
            gains[STIFFNESS, i] * (wanted[PLACE, i] - measured[ANGLE, i])
            + gains[DAMPING, i] * (wanted[VELOCITY, i] - velocity)
            + share * load[INERTIA, i]
        )
        moving = share * wanted[VELOCITY, i]
        bound, most = gains[BOUND, i], joints[STRONGEST, i]
        carried = load[WEIGHT, i] + friction_nm(moving, joints[COULOMB, i], joints[VISCOUS, i])
        torque[i] = min(max(min(max(effort, -bound), bound) + carried, -most), most)
        smooth[ANGLE, i] += kept * (measured[ANGLE, i] - smooth[ANGLE, i])
        smooth[VELOCITY, i] += kept * (velocity - smooth[VELOCITY, i])
        smooth[TORQUE, i] += kept * (torque[i] - smooth[TORQUE, i])
    return torque


@kernel
def friction_nm(velocity_rad_s: float, coulomb_nm: float, viscous_nm_s: float) -> float:
    """What the drive believes that friction takes."""
    return KNOWN_FRICTION * (coulomb_nm * tanh(velocity_rad_s / STICTION_RAD_S) + viscous_nm_s * velocity_rad_s)
