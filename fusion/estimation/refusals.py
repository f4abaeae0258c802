"""The latest refusals of each sensor, kept as long as the sample they belong to is fresh."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from fusion.estimation.freshness import CONTINUE_S
from fusion.estimation.measurement import Flags
from fusion.messages import Refusal


@dataclass(frozen=True, slots=True)
class SensorRefusals:
    """What was refused of one sensor's latest sample."""

    sensor: str
    t_s: float
    refusals: tuple[Refusal, ...]


Latest = tuple[SensorRefusals, ...]


def refuse(sensor: str, joints: Flags, reason: str) -> tuple[Refusal, ...]:
    """One refusal per joint in `joints` (J,), all for the same reason."""
    return tuple(Refusal(sensor, int(joint), reason) for joint in np.flatnonzero(joints))


def remember(latest: Latest, sensor: str, t_s: float, refusals: tuple[Refusal, ...]) -> Latest:
    """Put a sensor's newest refusals in the place of its former ones."""
    others = tuple(entry for entry in latest if entry.sensor != sensor)
    return (*others, SensorRefusals(sensor, t_s, refusals))


def fresh(latest: Latest, t_s: float) -> tuple[Refusal, ...]:
    """All refusals of samples that are still fresh at `t_s`."""
    return tuple(r for entry in latest if t_s - entry.t_s <= CONTINUE_S for r in entry.refusals)
