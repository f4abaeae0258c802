"""A simulated patient before two sensors that err as Table 1 says about a mean of zero, mounting and clocks known."""

from __future__ import annotations

from dataclasses import dataclass, replace
from typing import Final

import numpy as np

from fusion.align.alignment import reference_alignment
from fusion.experiments.measures.covered_lens import covered
from fusion.experiments.measures.scene import Scene, scene_of
from fusion.experiments.measures.turning import second_to_first
from fusion.recording.recording import Recording, Trouble
from fusion.skeleton import Side
from fusion.virtual_patient.sensor import TABLE1
from fusion.virtual_patient.trial import sensors_for, virtual_recording

MEANS_OFF: Final = replace(TABLE1, mean_m=(0.0, 0.0, 0.0))
"""The paper takes the mean errors off before it fuses."""


@dataclass(frozen=True, slots=True)
class KnownScene:
    """A scene and the recording with its truth."""

    recording: Recording
    scene: Scene


def known_scene(seed: int, length_s: float, events: tuple[Trouble, ...] = ()) -> KnownScene:
    """A right-armed patient; each event covers the lens of its sensor ("virtual-1", "virtual-2").

    The alignment is the true one: what fusion does is to be seen here, and not how well two still shoulders tell two
    clocks apart.
    """
    recording = virtual_recording(seed, length_s, noise=MEANS_OFF, clock_offset_s=0.0, apart_rad=np.pi / 2)
    recording = covered(recording, events, seed)
    first, second = sensors_for(Side.RIGHT, seed, MEANS_OFF, 0.0, np.pi / 2)
    known = {first.name: reference_alignment(), second.name: second_to_first(first.pose, second.pose)}
    return KnownScene(recording, scene_of(recording, known))
