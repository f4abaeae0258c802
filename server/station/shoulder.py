"""How far the healthy shoulder is drawn up: compensation by hitching, told from what raising the arm brings with it."""

from __future__ import annotations

from dataclasses import dataclass, replace
from math import exp, isfinite, nan
from typing import Final

import numpy as np

from fusion.kinematics.body_frame import PELVIS
from fusion.messages import Floats, PipelineFrame
from fusion.skeleton import Side, arm

SMOOTHED_S: Final = 0.3
"""Time constant: a hitch lasts as long as a reach, the sensors' noise mostly shorter."""
NATURAL_RISE_M: Final = 0.03
"""A shoulder rises by this × (1 − cos elevation) with the arm, unhitched: the fit over seven true motions
(docs/metrics.md)."""


@dataclass(frozen=True, slots=True)
class ShoulderRise:
    """The healthy shoulder's height, smoothed; NaN until it is known."""

    height_m: float = nan
    """Above the pelvis along the spine, without what the arm's elevation brings with it."""
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
    """Of the shoulder above the pelvis along the spine, so that leaning is no hitch; NaN where it is not known."""
    if frame.fused is None or frame.trunk is None or frame.healthy is None or not frame.healthy.valid:
        return nan
    up = frame.trunk.rotation_trunk_to_room[:, 1]
    shoulder, elbow = frame.fused.positions_in_room[list(arm(side)[:2])]
    height_m = float((shoulder - frame.fused.positions_in_room[PELVIS]) @ up)
    return height_m - NATURAL_RISE_M * (1.0 - _hanging(elbow - shoulder, up))


def _hanging(upper_arm: Floats, up: Floats) -> float:
    """Cosine of the elevation: 1 = the arm hangs along the spine."""
    return float(-upper_arm @ up / max(float(np.linalg.norm(upper_arm)), 1e-6))
