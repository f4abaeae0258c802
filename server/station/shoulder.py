"""How far the healthy shoulder is drawn up: compensation by hitching, told from what raising the arm brings with it."""

from __future__ import annotations

from dataclasses import dataclass, replace
from math import isfinite, nan

from fusion.kinematics.shoulder import shoulder_height_m, smoothed_m
from fusion.messages import PipelineFrame
from fusion.skeleton import Side


@dataclass(frozen=True, slots=True)
class ShoulderRise:
    """The healthy shoulder's height, smoothed; NaN until it is known."""

    height_m: float = nan
    """See `shoulder_height_m`."""
    at_enable_m: float = nan

    def heard(self, frame: PipelineFrame, side: Side, dt_s: float) -> ShoulderRise:
        """After another frame; one in which the arm is not seen changes nothing."""
        return replace(self, height_m=smoothed_m(self.height_m, _height_m(frame, side), dt_s))

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
