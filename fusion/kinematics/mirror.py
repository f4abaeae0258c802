"""The healthy arm mirrored in the sagittal plane: where the affected arm should go, and how fast."""

from __future__ import annotations

from dataclasses import replace
from math import exp, pi, radians
from typing import Final

import numpy as np

from fusion.compiled import kernel
from fusion.kinematics.angles import HANGING, wrapped
from fusion.messages import Floats, JointAngles, MirrorTarget

Velocities = tuple[Floats, float, float]
"""Of the upper arm's direction (3,), of the twist and of the elbow, per second."""
STILL: Final[Velocities] = (np.zeros(3), 0.0, 0.0)

VELOCITY_TIME_S: Final = 0.1
"""Time constant of the velocities' filter; velocities only feed forward, the position is never delayed."""
LONGEST_STEP_S: Final = 0.25
"""A previous target older than this says nothing about velocity."""
TWIST_UNTOLD_RAD, TWIST_TOLD_RAD = radians(15.0), radians(45.0)
"""Elbow bend below which the forearm does not tell the twist, and above which it fully does."""
TWIST_RATE_RAD_S: Final = 5.0
"""Fastest catching-up of the twist, so that leaving the straight elbow is no jump; above voluntary speed."""


def mirror(healthy: JointAngles, previous: MirrorTarget | None) -> MirrorTarget:
    """The target for the other arm.

    Limb coordinates make mirroring a copy. The twist moves towards the measured one at a rate that falls to zero with
    a straight elbow, where the measured twist means nothing; there the previous twist stays. Bounds are copied; what
    the twist still has to go is added to its own.

    Args:
        healthy: the healthy arm's angles.
        previous: the target of the tick before, for velocities and the held twist; None at the start.

    Returns:
        The target; invalid where the angles are, and then it rests at the previous one.
    """
    if previous is not None and previous.side is not healthy.side.other:
        previous = None
    if not healthy.valid:
        return _resting(healthy, previous)
    twist_rad = _told_twist(healthy, previous)
    return _copied(healthy, twist_rad, _velocities(healthy, twist_rad, previous))


def _copied(healthy: JointAngles, twist_rad: float, velocities: Velocities) -> MirrorTarget:
    direction_velocity, twist_rad_s, elbow_rad_s = velocities
    return MirrorTarget(
        t_s=healthy.t_s,
        side=healthy.side.other,
        direction_in_limb=healthy.direction_in_limb,
        twist_rad=twist_rad,
        elbow_rad=healthy.elbow_flexion_rad,
        direction_velocity=direction_velocity,
        twist_rad_s=twist_rad_s,
        elbow_rad_s=elbow_rad_s,
        swing_bound_rad=healthy.swing_bound_rad,
        twist_bound_rad=min(healthy.twist_bound_rad + abs(wrapped(healthy.twist_rad - twist_rad)), pi),
        elbow_bound_rad=healthy.elbow_bound_rad,
        valid=True,
    )


def _resting(healthy: JointAngles, previous: MirrorTarget | None) -> MirrorTarget:
    """Nothing to follow: stay, claim nothing."""
    last = previous or replace(_copied(healthy, 0.0, STILL), direction_in_limb=np.array(HANGING), elbow_rad=0.0)
    return replace(
        last,
        t_s=healthy.t_s,
        direction_velocity=np.zeros(3),
        twist_rad_s=0.0,
        elbow_rad_s=0.0,
        swing_bound_rad=pi,
        twist_bound_rad=pi,
        elbow_bound_rad=pi,
        valid=False,
    )


def _told_twist(healthy: JointAngles, previous: MirrorTarget | None) -> float:
    """The twist, held where the elbow is too straight to tell it."""
    weight = _determination(healthy.elbow_flexion_rad)
    if previous is None:
        return weight * healthy.twist_rad
    largest = TWIST_RATE_RAD_S * weight * max(healthy.t_s - previous.t_s, 0.0)
    change = wrapped(healthy.twist_rad - previous.twist_rad)
    return wrapped(previous.twist_rad + min(max(change, -largest), largest))


def _determination(flexion_rad: float) -> float:
    """0 for a straight or folded elbow, 1 for a clearly bent one, smooth between."""
    bend = min(flexion_rad, pi - flexion_rad)
    part = min(max((bend - TWIST_UNTOLD_RAD) / (TWIST_TOLD_RAD - TWIST_UNTOLD_RAD), 0.0), 1.0)
    return part * part * (3.0 - 2.0 * part)


def _velocities(healthy: JointAngles, twist_rad: float, previous: MirrorTarget | None) -> Velocities:
    """Differences to the previous target through a first-order low-pass."""
    dt_s = healthy.t_s - previous.t_s if previous else 0.0
    if previous is None or not previous.valid or not 0.0 < dt_s <= LONGEST_STEP_S:
        return STILL
    share = 1.0 - exp(-dt_s / VELOCITY_TIME_S)
    twist = wrapped(twist_rad - previous.twist_rad) / dt_s
    elbow = (healthy.elbow_flexion_rad - previous.elbow_rad) / dt_s
    return (
        _low_passed(previous.direction_velocity, previous.direction_in_limb, healthy.direction_in_limb, dt_s, share),
        previous.twist_rad_s + share * (twist - previous.twist_rad_s),
        previous.elbow_rad_s + share * (elbow - previous.elbow_rad_s),
    )


@kernel
def _low_passed(velocity: Floats, before: Floats, now: Floats, dt_s: float, share: float) -> Floats:
    """A velocity (3,) moved by this share towards that of the way from `before` to `now`."""
    moved = np.empty(3)
    for k in range(3):
        moved[k] = velocity[k] + share * ((now[k] - before[k]) / dt_s - velocity[k])
    return moved
