"""Offline fusion against real time: alignment found, body fused, angles and mirror target told at every instant."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Final

from fusion.estimation.set_membership import SetMembership
from fusion.offline import fuse_recording
from fusion.recording.recording import Recording
from fusion.virtual_patient.trial import virtual_recording

SEED: Final = 3
REPEATS: Final = 3


def times_real_time(recordings: Sequence[Recording], length_s: float) -> dict[str, float]:
    """How much faster than life, the best of some runs, by recording; where none is given, of a virtual patient.

    Reading the recording's files and writing the results are not in it.
    """
    chosen = recordings or (virtual_recording(SEED, length_s),)
    return {recording.name: max(_once(recording) for _ in range(REPEATS)) for recording in chosen}


def _once(recording: Recording) -> float:
    return fuse_recording(recording, SetMembership.name).timings.times_real_time
