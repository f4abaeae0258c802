"""How far the healthy shoulder is drawn up: compensation by hitching, told from what raising the arm brings with it."""

from __future__ import annotations

from dataclasses import dataclass, replace
from math import exp, isfinite, nan
from typing import Final

from fusion.kinematics.shoulder import shoulder_height_m
from fusion.messages import PipelineFrame
from fusion.skeleton import Side

SMOOTHED_S: Final = 0.3
"""Time constant: a hitch lasts as long as a reach, the sensors' noise mostly shorter."""


@dataclass(frozen=True, slots=True)
class ShoulderRise:
    """The healthy shoulder's height, smoothed; NaN until it is known."""

    height_m: float = nan
    """See `shoulder_height_m`."""
    at_enable_m: float = nan

    def heard(self, frame: PipelineFrame, side: Side, dt_s: float) -> ShoulderRise:
        """After another frame; one in which the arm is not seen changes nothing."""
        seen_m = _height_m(frame, side)
        if not isfinite(seen_m):
            return self
        if not isfinite(self.height_m):
            return replace(self, height_m=seen_m)
        return replace(self, height_m=self.height_m + (1.0 - exp(-dt_s / SMOOTHED_S)) * (seen_m - self.height_m))

    def enabled(self) -> ShoulderRise:
        """Motion was enabled: this is where the shoulder is from now on measured from."""
        return replace(self, at_enable_m=self.height_m)

    def forgotten(self) -> ShoulderRise:
        """The session is over."""
        return replace(self, at_enable_m=nan)

    @property
    def hitch_m(self) -> float:
        """Rise since motion was enabled, negative where it sank; 0 where either is not known."""
        risen = self.height_m - self.at_enable_m
        return risen if isfinite(risen) else 0.0


def _height_m(frame: PipelineFrame, side: Side) -> float:
    """NaN where the arm is not seen."""
    if frame.fused is None or frame.trunk is None or frame.healthy is None or not frame.healthy.valid:
        return nan
    return shoulder_height_m(frame.fused.positions_in_room, frame.trunk, side)
