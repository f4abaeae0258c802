"""The joints' set-points: where they stand when powered, then the station's command, joined without a step.

After power, and after each patient's fitting, a hold means "where it stands". From the first FOLLOW on the command
counts; what separates it from where the joint stood (a joint that rests elsewhere, a gate that remembers another hold)
is let go at no more than `JOIN_RAD_S`.
"""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray

from fusion.messages import Floats
from server.station.exo.driver import DriveMode
from server.station.exo.joining import gap_rad

JOIN_RAD_S = 0.2
LEAD_RAD = 0.1
"""A joint that gives way has its set-point no further ahead than this."""


@dataclass(frozen=True, slots=True)
class SetPoint:
    """What the joints are told."""

    joints_rad: Floats  # (n,)
    apart_rad: Floats | None = None  # (n,)
    """What still separates it from the command; None = it stands, and no FOLLOW has come."""

    @classmethod
    def standing(cls, joints_rad: Floats) -> SetPoint:
        """Stay there until the first FOLLOW."""
        return cls(np.array(joints_rad))

    def towards(self, mode: DriveMode, wanted_rad: Floats, measured_rad: Floats, elapsed_s: float) -> SetPoint:
        """One tick on."""
        if not np.isfinite(wanted_rad).all() or (self.apart_rad is None and mode is DriveMode.HOLD):
            return self
        apart = self._apart_rad(wanted_rad, measured_rad)
        apart = np.sign(apart) * np.maximum(np.abs(apart) - JOIN_RAD_S * elapsed_s, 0.0)
        return replace(self, joints_rad=wanted_rad + apart, apart_rad=apart)

    def yielding(self, soft: NDArray[np.bool_], measured_rad: Floats) -> SetPoint:
        """Where a joint gives way, its set-point stays near it, so that it does not snap back when it stiffens."""
        if self.apart_rad is None or not soft.any():
            return self
        near = np.clip(self.joints_rad, measured_rad - LEAD_RAD, measured_rad + LEAD_RAD)
        kept = np.where(soft, near, self.joints_rad)
        return SetPoint(kept, self.apart_rad + kept - self.joints_rad)

    def _apart_rad(self, wanted_rad: Floats, measured_rad: Floats) -> Floats:
        if self.apart_rad is None:
            return self.joints_rad - wanted_rad
        return gap_rad(self.joints_rad - self.apart_rad, self.apart_rad, wanted_rad, measured_rad)
