"""What one sample is worth: which joints are used, how surely, and how far each may be off."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Final

import numpy as np

from fusion.estimation import trust
from fusion.estimation.error_box import half_width_in_room
from fusion.estimation.gated_filter import Track, carried_on
from fusion.estimation.measurement import Flags, Measurement, read
from fusion.estimation.motion_set import SPEED_MAX
from fusion.estimation.trust import SensorTrust
from fusion.messages import AlignedSample, Floats

BELIEVED_STD_M: Final = 0.035
DOUBTED_STD_M: Final = 0.2
"""Off by half a metre at worst is 0.2 to 0.3 m as a rule; nothing changes in between."""
AGREEING_STD_M: Final = 0.07
AGREES_WITHIN_M: Final = 0.08
"""A doubted measurement this near to what a believed sensor leads to expect is used beside it."""
BELIEVED_HALF_WIDTH_M: Final = np.array((0.2, 0.2, 0.15))
"""Range, across, up: the error interval of a tracked joint [Du2016 Table 1]."""
DOUBTED_HALF_WIDTH_M: Final = np.array((0.6, 0.6, 0.6))
"""An inferred or wandering joint is off by half a metre at worst; and a fifth more."""


@dataclass(frozen=True, slots=True)
class Evidence:
    """One sample, ready to be used."""

    positions: Floats  # (J, 3) m in room, as measured
    unbiased: Floats  # (J, 3) m, less what this sensor always says differently from the others
    believed: Flags  # (J,)
    unchecked: Flags  # (J,) believed where nobody was lately: the gate has nothing to judge by
    shared: Flags  # (J,) believed, and so was another sensor lately
    used: Flags  # (J,)
    outvoted: Flags  # (J,) in doubt, disagreeing, and another sensor is sure
    wandering: Flags  # (J,) a bone's length is wrong
    variance: Floats  # (J,) m²
    half_width: Floats  # (J, 3) m along the room's axes


def weigh(
    sample: AlignedSample, own: SensorTrust, others: tuple[SensorTrust, ...], track: Track, offset_m: Floats
) -> tuple[Evidence, SensorTrust]:
    """Weigh one sample against its sensor's past, the other sensors and the predicted track.

    `offset_m` (J, 3) is the sensor's learnt bias: the point is moved by what is left, the set by what was measured.
    """
    t_s = track.t_s
    measured = read(sample)
    verdict, learnt = trust.judge(own, t_s, measured)
    positions = carried_on(track, measured.positions, sample.t_s)
    unbiased = positions - offset_m
    surely = trust.believed_lately(others, t_s)
    agreeing = verdict.doubted & surely & (np.linalg.norm(unbiased - track.position, axis=1) < AGREES_WITHIN_M)
    outvoted = verdict.doubted & surely & ~agreeing
    std_m = np.where(verdict.believed, BELIEVED_STD_M, np.where(agreeing, AGREEING_STD_M, DOUBTED_STD_M))
    half_width = _half_width(sample, measured, verdict.believed) + SPEED_MAX * max(t_s - sample.t_s, 0.0)
    evidence = Evidence(
        positions=positions,
        unbiased=unbiased,
        believed=verdict.believed,
        unchecked=verdict.believed & ~surely & ~trust.believed_lately((own,), t_s),
        shared=verdict.believed & surely,
        used=measured.given & ~outvoted,
        outvoted=outvoted,
        wandering=verdict.wandering,
        variance=std_m**2,
        half_width=half_width,
    )
    return evidence, learnt


def _half_width(sample: AlignedSample, measured: Measurement, believed: Flags) -> Floats:
    in_sensor = np.where(believed[:, None], BELIEVED_HALF_WIDTH_M, DOUBTED_HALF_WIDTH_M)
    return half_width_in_room(sample, measured.positions, in_sensor)
