"""The newest joint states: per joint what was measured, and how old that is by our own clock.

A robot's stamps come from its own clock. What a stamp says less our time of receipt is the clocks' difference less the
message's way; the least way seen is taken as none, so a message that was held up, and a state that is sent again and
again with one stamp, grow old like one that does not come.
"""

from __future__ import annotations

from dataclasses import dataclass, field, replace
from math import inf, isfinite

from server.station.exo.rosbridge.wire import JointState

CLOCKS_DRIFT = 2e-4
"""Clocks may drift apart by so much; the least way seen is forgotten as slowly."""


@dataclass(frozen=True, slots=True)
class Measured:
    """One joint."""

    t_s: float
    """When, by our clock."""
    stamp_s: float
    """When, by the robot's."""
    angle_rad: float
    velocity_rad_s: float
    torque_nm: float
    """0 where the robot measures none."""


@dataclass(frozen=True, slots=True)
class JointStates:
    """What is known of every joint that has been heard of."""

    joints: dict[str, Measured] = field(default_factory=dict)
    least_way_s: float = inf
    heard_s: float = 0.0

    def heard(self, state: JointState, now_s: float) -> JointStates:
        """With one more message; joints that it leaves out keep what they had."""
        stamp_s = state.header.stamp.seconds or now_s  # a robot that does not stamp is taken at its word
        least_s = min(self.least_way_s + CLOCKS_DRIFT * (now_s - self.heard_s), now_s - stamp_s)
        t_s = stamp_s + least_s
        new = {
            name: measured
            for i, name in enumerate(state.name)
            if (measured := _measured(state, i, self.joints.get(name), t_s, stamp_s)) is not None
        }
        return replace(self, joints={**self.joints, **new}, least_way_s=least_s, heard_s=now_s)

    def missing(self, names: tuple[str, ...]) -> tuple[str, ...]:
        """Those of the names that nothing has been heard of."""
        return tuple(name for name in names if name not in self.joints)


def _measured(state: JointState, i: int, before: Measured | None, t_s: float, stamp_s: float) -> Measured | None:
    angle = _number(state.position, i)
    if angle is None:
        return None
    velocity, torque = _number(state.velocity, i), _number(state.effort, i)
    if velocity is None:
        velocity = _difference(angle, stamp_s, before)
    return Measured(t_s, stamp_s, angle, velocity, torque or 0.0)


def _number(values: tuple[float | None, ...], i: int) -> float | None:
    value = values[i] if i < len(values) else None
    return value if value is not None and isfinite(value) else None


def _difference(angle: float, stamp_s: float, before: Measured | None) -> float:
    """The velocity between two states, for a robot that sends none."""
    if before is None:
        return 0.0
    apart_s = stamp_s - before.stamp_s
    return (angle - before.angle_rad) / apart_s if apart_s > 0 else before.velocity_rad_s
