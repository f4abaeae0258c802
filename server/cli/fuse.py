"""`mirrorlimb fuse`: the live pipeline over a recording, as fast as it goes."""

from __future__ import annotations

from pathlib import Path
from time import time
from typing import Annotated

import typer
from psutil import Process
from rich.console import Console
from rich.progress import BarColumn, Progress, TextColumn, TimeElapsedColumn

from fusion.estimation import METHODS
from fusion.offline import FusedRecording, OtherSensors, Timings, fuse_recording
from fusion.recording.reader import read_recording
from server.cli.fused_files import make_folder, write_fused


def fuse(
    recording: Annotated[Path, typer.Argument(help="A recording: its folder or a .mcap file.", show_default=False)],
    out: Annotated[Path, typer.Option(metavar="FOLDER", help="Where fused.csv, angles.csv and report.json go.")],
    method: Annotated[str, typer.Option(help=f"One of {', '.join(METHODS)}.")] = "set-membership",
    reference: Annotated[
        str | None,
        typer.Option(metavar="SENSOR", help="Whose frame and clock count; the recording's primary by default."),
    ] = None,
    causal: Annotated[
        bool, typer.Option("--causal", help="Learn the alignment on the way, as live, not from the whole recording.")
    ] = False,
) -> None:
    """Align, fuse and mirror a recording; mounting and clocks need not be known."""
    console = Console(stderr=True)
    source = read_recording(recording)
    make_folder(out)
    with _progress(console) as progress:
        bar = progress.add_task(f"{source.name}: {method}", total=1.0)
        fused = fuse_recording(
            source, method, reference, causal, progress=lambda share: progress.update(bar, completed=share)
        )
    write_fused(fused, out)
    for line in _summary(fused, out):
        console.print(line, highlight=False, markup=False, soft_wrap=True)


def _progress(console: Console) -> Progress:
    percent = TextColumn("{task.percentage:3.0f} %")
    return Progress(TextColumn("{task.description}"), BarColumn(), percent, TimeElapsedColumn(), console=console)


def _summary(fused: FusedRecording, out: Path) -> list[str]:
    """What a person wants to know at once; the rest is in report.json."""
    lines = [f"{fused.name}: {len(fused.t_s)} instants in the frame of {fused.reference} → {out}"]
    for sensor in fused.sensors:
        found = sensor.alignment
        if sensor.is_reference:
            continue
        if found is None:
            lines.append(f"{sensor.sensor}: not aligned, not used")
        else:
            offset, residual = found.clock_offset_s * 1e3, found.residual_m * 1e3
            lines.append(f"{sensor.sensor}: clock offset {offset:.0f} ms, joints {residual:.0f} mm apart (median)")
    warnings = [f"Warning: {warning}" for sensor in fused.sensors for warning in sensor.warnings]
    return [*lines, *_beside_cameras(fused.others), *warnings, _speed(fused.timings)]


def _beside_cameras(others: OtherSensors) -> list[str]:
    used = [f"joined with {', '.join(others.used)}"] if others.used else []
    return [*used, *(f"{name}: not used. {why}" for name, why in others.unusable.items())]


def _speed(timings: Timings) -> str:
    """Of the work alone, and of the whole command from its first moment on."""
    whole_s = time() - Process().create_time()
    return (
        f"{timings.times_real_time:.0f} times as fast as real time; "
        f"{timings.recording_s / whole_s:.0f} times with Python's start, reading and writing ({whole_s:.1f} s)"
    )
