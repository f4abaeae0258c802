"""`mirrorlimb bench`: how long fusion takes on this machine, each figure beside its baseline in the same run."""

from __future__ import annotations

import json
import sys
from dataclasses import asdict, dataclass
from importlib.util import find_spec
from pathlib import Path
from typing import TYPE_CHECKING, Annotated

import typer
from rich.box import SIMPLE_HEAD
from rich.console import Console
from rich.table import Table

from fusion.errors import InputError, MachineError
from fusion.recording.reader import Recording, read_recording

if TYPE_CHECKING:
    from fusion.benchmarks.rounds import Timing

ROUNDS = 30
LENGTH_S = 60.0
SHORTEST_S = 6.0
"""Alignment and lengths must be learnt before a tick counts."""
LONGEST_S = 3600.0
"""The virtual patient is kept in memory."""
TABLE_WIDTH = 100


@dataclass(frozen=True, slots=True)
class Line:
    """One figure: microseconds for a piece of work, and how that compares with the default method's fused frame."""

    work: str
    median_us: float
    least_us: float
    p99_us: float
    times_ours: float | None = None
    """Median over the default method's, and least over least."""
    least_times_ours: float | None = None


@dataclass(frozen=True, slots=True)
class Figures:
    """All that one run found."""

    fused_frame: list[Line]
    growth: list[Line]
    tick: list[Line]
    offline_times_real_time: dict[str, float]


def bench(
    recording: Annotated[
        list[Path] | None, typer.Argument(help="Fuse these offline; a virtual patient's minute by default.")
    ] = None,
    rounds: Annotated[int, typer.Option(help="Rounds in which all candidates take turns.")] = ROUNDS,
    length: Annotated[float, typer.Option(help="Seconds that the virtual patient is watched.")] = LENGTH_S,
    as_json: Annotated[bool, typer.Option("--json", help="Print all figures as JSON.")] = False,
) -> None:
    """Time a fused frame beside FilterPy and Stone Soup, its growth, a whole tick, and offline fusion.

    Candidates take turns in short rounds, so what else runs on the machine disturbs all alike. "Least" is the quickest
    tenth: nearest to what a quiet machine would show.
    """
    if rounds < 1:
        raise InputError(f"--rounds is {rounds}", "at least 1")
    if not SHORTEST_S <= length <= LONGEST_S:
        raise InputError(f"--length is {length:g}", f"{SHORTEST_S:g} to {LONGEST_S:g} seconds")
    figures = _measure([read_recording(path) for path in recording or []], rounds, length)
    if as_json:
        sys.stdout.write(json.dumps(asdict(figures), indent=1) + "\n")
    else:
        _show(figures)


def _measure(recordings: list[Recording], rounds: int, length_s: float) -> Figures:
    _need_baselines()
    from fusion.benchmarks import fused_frame, offline, scaling, tick

    frame = fused_frame.compare(rounds)
    ours = next(iter(frame.values()))
    return Figures(
        fused_frame=[_line(name, timing, ours) for name, timing in frame.items()],
        growth=[_line(f"{j} joints, {k} sensors", timing) for (j, k), timing in scaling.grow(rounds).items()],
        tick=[_line("2 samples to mirror target", tick.tick(length_s))],
        offline_times_real_time=offline.times_real_time(recordings, length_s),
    )


def _show(figures: Figures) -> None:
    console = Console(width=max(Console().width, TABLE_WIDTH))
    console.print(_table("A fused frame: 25 joints, 2 sensors", figures.fused_frame))
    console.print(_table("Growth of the default method", figures.growth))
    console.print(_table("A whole tick, alignment learnt on the way", figures.tick))
    for name, speed in figures.offline_times_real_time.items():
        console.print(f"Offline, {name}: {speed:.0f} times real time (align and fuse; files not counted)")


def _need_baselines() -> None:
    missing = [name for name in ("filterpy", "stonesoup") if find_spec(name) is None]
    if missing:
        raise MachineError(
            f"{' and '.join(missing)} not installed: there is nothing to compare with",
            "the extra 'research'",
            "run: .venv/bin/python -m pip install -e '.[research]'",
        )


def _line(work: str, timing: Timing, ours: Timing | None = None) -> Line:
    figures = timing.median_us, timing.least_us, timing.p99_us
    if ours is None:
        return Line(work, *figures)
    return Line(work, *figures, timing.median_us / ours.median_us, timing.least_us / ours.least_us)


def _table(heading: str, lines: list[Line]) -> Table:
    table = Table(title=heading, caption="microseconds", box=SIMPLE_HEAD)
    table.add_column("work", no_wrap=True)
    compared = lines[0].times_ours is not None
    for name in ("median", "least", "p99", *(["times the default's", "least"] if compared else [])):
        table.add_column(name, justify="right", no_wrap=True)
    for line in lines:
        table.add_row(line.work, *(f"{us:,.1f}" for us in (line.median_us, line.least_us, line.p99_us)), *_ratios(line))
    return table


def _ratios(line: Line) -> list[str]:
    return [f"{times:.1f}" for times in (line.times_ours, line.least_times_ours) if times is not None]
