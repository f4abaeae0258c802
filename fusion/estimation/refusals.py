"""The latest refusals of each sensor, kept as long as the sample they belong to is fresh."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from fusion.estimation.freshness import CONTINUE_S
from fusion.messages import Refusal

Reasons = tuple[str, ...]
Codes = NDArray[np.uint8]
"""(J,) which of a method's reasons each joint of a sample was refused for; 0 is none, as the first reason is ''."""


@dataclass(frozen=True, slots=True)
class SensorRefusals:
    """What was refused of one sensor's latest sample."""

    sensor: str
    t_s: float
    refusals: tuple[Refusal, ...]


Latest = tuple[SensorRefusals, ...]


def refused(sensor: str, codes: Codes, reasons: Reasons) -> tuple[Refusal, ...]:
    """One refusal per joint that has a reason."""
    if not codes.any():
        return ()
    return tuple(Refusal(sensor, int(joint), reasons[codes[joint]]) for joint in np.flatnonzero(codes))


def remember(latest: Latest, sensor: str, t_s: float, refusals: tuple[Refusal, ...]) -> Latest:
    """Put a sensor's newest refusals in the place of its former ones."""
    others = tuple([entry for entry in latest if entry.sensor != sensor])
    return (*others, SensorRefusals(sensor, t_s, refusals)) if refusals else others


def fresh(latest: Latest, t_s: float) -> tuple[Refusal, ...]:
    """All refusals of samples that are still fresh at `t_s`."""
    return tuple([r for entry in latest if t_s - entry.t_s <= CONTINUE_S for r in entry.refusals])
