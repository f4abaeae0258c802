"""Choosing constants on some of the patients and scoring them on the one left out."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import Final

from fusion.evaluation.scores import Errors, joined, score

PLATEAU: Final = 0.01
"""A value must be better by this share of the rms before it is preferred to the usual one: peaks do not last."""

ByPatient = Mapping[str, Errors]
"""What one setting came to, patient by patient."""


def without(errors: ByPatient, patient: str) -> Errors:
    """All patients together but one."""
    return joined([each for name, each in errors.items() if name != patient])


def preferred(usual: float, tried: Mapping[float, ByPatient], patient: str) -> float:
    """The value of one constant with the least rms on everybody but `patient`; the usual one on a plateau."""
    rms_mm = {value: score(without(errors, patient)).rms_mm for value, errors in tried.items()}
    best = min(rms_mm, key=lambda value: rms_mm[value])
    return best if rms_mm[best] < (1 - PLATEAU) * rms_mm[usual] else usual


def by_patient(patients: Sequence[str], errors: Sequence[Errors]) -> dict[str, Errors]:
    """The errors of recordings, joined by whose they are."""
    return {
        name: joined([each for whose, each in zip(patients, errors, strict=True) if whose == name])
        for name in dict.fromkeys(patients)
    }
