"""Every kernel of a session compiled, or loaded, before one begins: by `make setup` and at the station's start.

`make setup` compiles what commands on recordings need, too.
"""

from __future__ import annotations

import sys
from pathlib import Path
from tempfile import TemporaryDirectory
from time import perf_counter
from typing import Final

import numpy as np

from fusion.estimation import METHODS
from fusion.messages import PipelineFrame
from fusion.offline import fuse_recording
from fusion.pipeline import Pipeline, PipelineSettings
from fusion.recording.lines import lines_of
from fusion.recording.reader import read_recording
from fusion.recording.writer import write_recording
from fusion.skeleton import JOINTS, Side
from fusion.virtual_patient.patient import VirtualPatient
from fusion.virtual_patient.trial import sensors_for, virtual_recording

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


def warm_files() -> None:
    """Write a recording, read it, fuse it, and write some of that as text."""
    with TemporaryDirectory() as folder:
        path = Path(folder) / "recording"
        write_recording(virtual_recording(1, SECONDS), path)
        fused = fuse_recording(read_recording(path), next(iter(METHODS)))
    lines_of(fused.positions[:, 0], (4, 4, 4), JOINTS, np.zeros(len(fused.t_s), dtype=np.int64))


def main() -> None:
    """Compile for every method, and say so."""
    started_s = perf_counter()
    print("Compiling the inner loops (half a minute once; they are kept) ...", file=sys.stderr, flush=True)
    for method in METHODS:
        warm(method)
    warm_files()
    print(f"Compiled or loaded in {perf_counter() - started_s:.1f} s.", file=sys.stderr)


if __name__ == "__main__":
    main()
