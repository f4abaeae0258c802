"""One command as a trajectory that ends at rest, so that a robot that hears nothing more brakes by itself (SR-3).

First point: where the joints shall be `lead_s` from now, at their speed. From there each joint brakes at its own
acceleration limit a, q(t) = q₁ + v t − sign(v) a t²/2, until it stands after |v|/a; every instant at which a joint
comes to stand is a point. Between points with position and velocity a ROS 2 controller interpolates with cubics, which
give these parabolas exactly.
"""

from __future__ import annotations

import numpy as np

from fusion.messages import Floats
from server.station.exo.rosbridge.wire import JointTrajectory, Point, time_of

APART_S = 0.002
"""Points nearer than this to one another are one: a controller takes growing times only."""


def trajectory(
    names: tuple[str, ...],
    joints_rad: Floats,
    joints_rad_s: Floats,
    braking_rad_s2: Floats,
    ends: Floats,
    lead_s: float,
) -> JointTrajectory:
    """The trajectory of one command.

    Args:
        names: of the joints, in the order of what follows.
        joints_rad: (n,) set-points now.
        joints_rad_s: (n,) their velocities.
        braking_rad_s2: (n,) each joint's limit.
        ends: (n, 2) range that no point leaves; a joint that would brakes harder.
        lead_s: time to the first point.
    """
    first = np.clip(joints_rad + joints_rad_s * lead_s, ends[:, 0], ends[:, 1])
    brake_s = _brake_s(first, joints_rad_s, braking_rad_s2, ends)
    velocity = np.where(brake_s > 0, joints_rad_s, 0.0)
    return JointTrajectory(names, _points(first, velocity, brake_s, lead_s))


def _brake_s(first: Floats, velocity: Floats, braking: Floats, ends: Floats) -> Floats:
    """How long each joint brakes: at its limit, or shorter where its range ends sooner; 0 = it stands at once."""
    room = np.where(velocity > 0, ends[:, 1] - first, first - ends[:, 0])
    speed = np.maximum(np.abs(velocity), 1e-9)
    brake_s = np.minimum(speed / braking, 2.0 * room / speed)
    return np.where(brake_s > APART_S, brake_s, 0.0)


def _instants(brake_s: Floats) -> list[float]:
    """Where joints come to stand, ascending; of those that are nearly one the last is kept."""
    kept: list[float] = []
    for instant in sorted(map(float, brake_s), reverse=True):
        if instant and (not kept or kept[-1] - instant > APART_S):
            kept.append(instant)
    return kept[::-1]


def _points(first: Floats, velocity: Floats, brake_s: Floats, lead_s: float) -> tuple[Point, ...]:
    """The first point and each instant at which a joint comes to stand."""
    after_s = [0.0, *_instants(brake_s)]
    braked = np.minimum(np.array(after_s)[:, None] / np.maximum(brake_s, APART_S), 1.0)  # (k, n)
    angles = first + velocity * brake_s * braked * (1.0 - braked / 2.0)
    left = velocity * (1.0 - braked)
    return tuple(
        Point(tuple(angle), tuple(speed), time_of(lead_s + after))
        for angle, speed, after in zip(angles.tolist(), left.tolist(), after_s, strict=True)
    )
