"""`mirrorlimb convert`: a recording from either form into the other."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated

import typer

from fusion.recording.reader import read_recording
from fusion.recording.writer import write_recording


def convert(
    recording: Annotated[Path, typer.Argument(help="A recording: its folder or a .mcap file.", show_default=False)],
    out: Annotated[Path, typer.Argument(help="What to make: NAME.mcap, or else a folder.", show_default=False)],
) -> None:
    """Turn a recording's folder into one .mcap file, or a .mcap file into a folder."""
    source = read_recording(recording)
    write_recording(source, out)
    frames = sum(len(stream.samples) for stream in source.skeleton_streams)
    sensors = f"{len(source.skeleton_streams)} sensors, {frames} frames"
    typer.echo(f"{out}: {sensors}, {len(source.imu_streams)} inertial streams.")
