"""Whether the joints are where they are told to be: finds drives that lag, are deaf to set-points, or lie (SR-8)."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
from numpy.typing import NDArray

from fusion.messages import Floats
from server.exoskeleton import ExoskeletonJoint

FAR_RAD, FAR_S = 0.35, 0.3
"""A joint that is further than this from its set-point, for so long, does not follow."""
LEAP_FACTOR, LEAP_RAD = 2.0, 0.1
"""A measurement that moves by more than this many times the joint's speed, and this much more, has leapt."""


class Following:
    """Compares set-points with measurements, tick by tick.

    Args:
        joints: of the device.
    """

    def __init__(self, joints: Sequence[ExoskeletonJoint]) -> None:
        self._names = [joint.name for joint in joints]
        self._speeds = np.array([joint.velocity_rad_s for joint in joints])  # (n,)
        self._near_s: Floats | None = None
        self._before: tuple[float, Floats] | None = None

    def begin(self) -> None:
        """Forget what was: power has come, or a person has reset."""
        self._near_s = self._before = None

    def judge(self, told_rad: Floats, measured_rad: Floats, soft: NDArray[np.bool_], now_s: float) -> str:
        """What is wrong in this tick, naming the joint; "" = nothing. Joints that give way may be anywhere.

        Args:
            told_rad: the last set-points (n,).
            measured_rad: where the joints are (n,).
            soft: which of them give way (n,).
            now_s: monotonic time.
        """
        before_s, before = self._before or (now_s, measured_rad)
        if self._before is None or not np.array_equal(before, measured_rad):
            self._before = now_s, measured_rad
        leapt = np.abs(measured_rad - before) > LEAP_RAD + LEAP_FACTOR * self._speeds * (now_s - before_s)
        near = (np.abs(told_rad - measured_rad) <= FAR_RAD) | soft
        since_s = np.full(len(near), now_s) if self._near_s is None else self._near_s
        self._near_s = np.where(near, now_s, since_s)
        return self._said(leapt, "measures a place that it cannot have moved to") or self._said(
            now_s - self._near_s > FAR_S, "does not follow: it is elsewhere than it is told to be"
        )

    def _said(self, which: NDArray[np.bool_], what: str) -> str:
        return f"The drive of '{self._names[int(np.argmax(which))]}' {what}." if which.any() else ""
