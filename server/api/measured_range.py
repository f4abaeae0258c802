"""How far the patient moved each joint unaided: a proposal for the passive range, for a person to confirm (SR-18)."""

from __future__ import annotations

from math import inf, pi

from db.limits import JointRange, PassiveRange
from server.api.forms import MeasuredRange
from server.messages import EXO_JOINTS, Assistance, DriveState, LiveTick

LEAST_RAD = 0.02
"""A joint that moved less has no range yet."""


class RangeMeter:
    """Keeps the least and greatest measured angle of each joint while the arm is engaged and moves freely."""

    def __init__(self) -> None:
        self._ticks = 0
        self._least = [inf] * len(EXO_JOINTS)
        self._greatest = [-inf] * len(EXO_JOINTS)

    def take(self, tick: LiveTick) -> None:
        """Take a tick; one in which the drive moves the arm tells nothing about the patient."""
        if not moves_freely(tick):
            return
        self._ticks += 1
        self._least = [min(pair) for pair in zip(self._least, tick.exo.angle_rad, strict=True)]
        self._greatest = [max(pair) for pair in zip(self._greatest, tick.exo.angle_rad, strict=True)]

    def read(self) -> MeasuredRange:
        """What has been reached; a range once every joint has moved."""
        spans = tuple(zip(self._least, self._greatest, strict=True))
        if not all(greatest - least >= LEAST_RAD for least, greatest in spans):
            return MeasuredRange(ticks=self._ticks, range=None)
        ranges = {joint: _range(*span) for joint, span in zip(EXO_JOINTS, spans, strict=True)}
        return MeasuredRange(ticks=self._ticks, range=PassiveRange(**ranges))


def moves_freely(tick: LiveTick) -> bool:
    """Whether the drive only carries the arm's weight."""
    return tick.state is DriveState.ENGAGED and tick.exo.assistance is Assistance.FREE


def _range(least: float, greatest: float) -> JointRange:
    return JointRange(min_rad=max(least, -pi), max_rad=min(greatest, pi))
