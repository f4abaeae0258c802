"""Which of a sensor's joints are believed: tracked without a flicker, with bones as long as they always are."""

from __future__ import annotations

from dataclasses import dataclass, replace
from typing import Final

import numpy as np

from fusion.estimation import bones
from fusion.estimation.bones import Bones
from fusion.estimation.measurement import Flags, Measurement
from fusion.messages import Floats
from fusion.skeleton import JOINT_COUNT

STEADY_S: Final = 0.25
"""A joint is believed after this long without doubt: one that wanders flickers between inferred and tracked. One
that was not tracked at all and comes back tracked is believed at once."""
SURE_FOR_S: Final = 0.25
"""What was believed this lately outweighs doubtful word that is newer; 0.2 to 0.5 s serve. With less, a sensor whose
samples come late lets the doubtful ones of a faster sensor in and out by turns."""


@dataclass(frozen=True, slots=True)
class SensorTrust:
    """What is remembered of one sensor."""

    sensor: str
    bones: Bones
    doubted_s: Floats  # (J,) when the joint was last in doubt; -inf never
    believed_s: Floats  # (J,) when the joint was last believed and fitted; -inf never


@dataclass(frozen=True, slots=True)
class Verdict:
    """How the joints of one sample are to be taken."""

    believed: Flags  # (J,) tracked without a flicker, bones right
    doubted: Flags  # (J,) given and not believed
    wandering: Flags  # (J,) doubted because a bone's length is wrong


def stranger(sensor: str) -> SensorTrust:
    """A sensor heard for the first time."""
    never = np.full(JOINT_COUNT, -np.inf)
    return SensorTrust(sensor, bones.unknown(), never, never)


def judge(known: SensorTrust, t_s: float, measured: Measurement) -> tuple[Verdict, SensorTrust]:
    """Judge one sample by what is known of its sensor, and remember what it says of the bones."""
    wandering = bones.wandering(known.bones, measured)
    doubtful = measured.given & (wandering | ~measured.tracked)
    doubted_s = np.where(doubtful, t_s, known.doubted_s)
    believed = measured.tracked & (t_s - doubted_s > STEADY_S)
    learnt = replace(known, bones=bones.learn(known.bones, measured), doubted_s=doubted_s)
    return Verdict(believed, measured.given & ~believed, wandering), learnt


def believe(known: SensorTrust, t_s: float, joints: Flags) -> SensorTrust:
    """Remember which joints (J,) were not only believed but fitted what was expected."""
    return replace(known, believed_s=np.where(joints, t_s, known.believed_s))


def believed_lately(sensors: tuple[SensorTrust, ...], t_s: float) -> Flags:
    """(J,) whether any of the sensors was believed lately enough to outweigh doubtful word."""
    return t_s - last_believed_s(sensors) <= SURE_FOR_S


def last_believed_s(sensors: tuple[SensorTrust, ...]) -> Floats:
    """(J,) when any of the sensors was last believed; -inf never."""
    last_s = np.full(JOINT_COUNT, -np.inf)
    for trust in sensors:
        last_s = np.maximum(last_s, trust.believed_s)
    return last_s


def split(known: tuple[SensorTrust, ...], sensor: str) -> tuple[SensorTrust, tuple[SensorTrust, ...]]:
    """One sensor and all the others."""
    own = next((trust for trust in known if trust.sensor == sensor), None)
    return own or stranger(sensor), tuple(trust for trust in known if trust.sensor != sensor)
