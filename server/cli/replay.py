"""`mirrorlimb replay`: sends a recording's sensor streams as the real senders would."""

from __future__ import annotations

from itertools import chain
from pathlib import Path
from typing import Annotated

import typer
from rich.console import Console
from rich.progress import BarColumn, Progress, TextColumn, TimeRemainingColumn

from fusion.formats.registry import DIALECTS, dialect_named
from fusion.recording.reader import read_recording
from server.sender import Sender, departures, duration_s, parse_destination, send_in_time

_NAMES = ", ".join(dialect.name for dialect in DIALECTS)


def replay(
    recording: Annotated[Path, typer.Argument(help="A recording: its folder or a .mcap file.", show_default=False)],
    to: Annotated[
        str, typer.Option(metavar="HOST[:PORT]", help="Where to; the dialect's port by default.")
    ] = "127.0.0.1",
    dialect: Annotated[str, typer.Option(help=f"How to say it: {_NAMES}.")] = DIALECTS[0].name,
    speed: Annotated[float, typer.Option(min=0.01, max=100.0, help="1 = real time.")] = 1.0,
    loop: Annotated[bool, typer.Option("--loop", help="Begin again at the end, until Ctrl-C.")] = False,
) -> None:
    """Send a recording's sensors over UDP in real time, each from an address of its own."""
    spoken = dialect_named(dialect)
    destination = parse_destination(to, spoken.port)
    source = read_recording(recording)
    leaving = departures(source, loop)
    first = next(leaving)
    console = Console(stderr=True)
    where = f"{destination.host}:{destination.port}"
    with Sender(destination, len(source.skeleton_streams), spoken) as sender, _progress(console) as progress:
        length_s = duration_s(source)
        bar = progress.add_task(f"{source.name} → {where}", total=None if loop else length_s)
        send_in_time(chain([first], leaving), sender, speed, lambda after_s: progress.update(bar, completed=after_s))
        if not loop:
            progress.update(bar, completed=length_s)
    if sender.unheard:
        console.print(
            f"Nobody listened on {where} for at least a part of the time. Is `mirrorlimb serve` running?",
            soft_wrap=True,
        )


def _progress(console: Console) -> Progress:
    seconds = TextColumn("{task.completed:.0f} s")
    return Progress(TextColumn("{task.description}"), BarColumn(), seconds, TimeRemainingColumn(), console=console)
