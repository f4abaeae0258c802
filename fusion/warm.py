"""Every kernel of a session compiled, or loaded, before one begins: by `make setup` and at the station's start."""

from __future__ import annotations

import sys
from time import perf_counter
from typing import Final

from fusion.estimation import METHODS
from fusion.messages import PipelineFrame
from fusion.pipeline import Pipeline, PipelineSettings
from fusion.skeleton import Side
from fusion.virtual_patient.patient import VirtualPatient
from fusion.virtual_patient.trial import sensors_for

SECONDS: Final = 4.0
"""Of the virtual patient's time: long enough for a sensor to be aligned and an arm to be mirrored."""
FRAME_S: Final = 1 / 30


def warm(method: str) -> PipelineFrame:
    """Let a pipeline follow a virtual patient, and return what it says in the end.

    Half a second once everything is compiled; half a minute the first time after an update.
    """
    side = Side.RIGHT
    patient, sensors = VirtualPatient(side, seed=1), sensors_for(side, seed=1)
    pipeline = Pipeline(PipelineSettings(side, method))
    for k in range(round(SECONDS / FRAME_S)):
        positions = patient.step(FRAME_S)
        for sensor in sensors:
            sample = sensor.see(positions, k * FRAME_S)
            if sample is not None:
                pipeline.take(sample)
        told = pipeline.step(k * FRAME_S)
    return told


def main() -> None:
    """Compile for every method, and say so."""
    started_s = perf_counter()
    print("Compiling the inner loops (half a minute once; they are kept) ...", file=sys.stderr, flush=True)
    for method in METHODS:
        warm(method)
    print(f"Compiled or loaded in {perf_counter() - started_s:.1f} s.", file=sys.stderr)


if __name__ == "__main__":
    main()
