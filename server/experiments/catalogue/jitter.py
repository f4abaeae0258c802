"""Ours: how steadily commands reach the drive, from a process of its own and from a thread of the web process."""

from __future__ import annotations

import asyncio
import os
import subprocess
import sys
import tempfile
import time
from collections.abc import Iterator
from contextlib import contextmanager
from dataclasses import dataclass
from itertools import pairwise
from pathlib import Path
from typing import Final

from fusion.experiments.experiment import Chapter, Experiment, Setup
from fusion.experiments.outcome import Beside, Column, Outcome, Table, columns
from server.experiments.rig.drive_log import DriveLog, commands
from server.experiments.rig.inside import Inside, read_inside
from server.experiments.rig.live_service import LiveService, live_service
from server.experiments.rig.measures import Percentiles, percentiles
from server.experiments.rig.patient import LivePatient
from server.experiments.rig.scene import running_drive

WATCHED_S: Final = 60.0
PERIOD_S: Final = 0.01
LATE_S: Final = 0.005
"""Later than this, the drive has nothing new for half a period."""
GOAL_MS: Final = 5.0
PROCESS, THREAD = "station process", "thread of the web process"
_HOG = "while True: pass"


@dataclass(frozen=True, slots=True)
class Run:
    """One loop under one load."""

    loop: str
    load: str
    off: Percentiles
    """How far the time between two commands is from the period."""
    late: int
    """Commands that came more than `LATE_S` late."""


def run(setup: Setup) -> Outcome:
    """Both loops at once, first alone and then beside busy programs."""
    with tempfile.TemporaryDirectory(prefix="mirrorlimb-") as folder:
        runs, inside = asyncio.run(_both(setup, Path(folder)))
    worst = {(each.loop, each.load): each.off for each in runs}
    loads = tuple(dict.fromkeys(each.load for each in runs))
    beside = tuple(
        Beside(
            f"{loop}, {load}: off the period, p50 / p99 / max",
            f"p99 below {GOAL_MS:g} ms" if loop == PROCESS else "for comparison",
            worst[loop, load].words,
            worst[loop, load].p99_ms < GOAL_MS if loop == PROCESS else None,
        )
        for load in loads
        for loop in (PROCESS, THREAD)
    )
    return Outcome((*beside, *_inside(inside)), (_table(runs),), (), _WHY, (setup.seed,))


def _inside(inside: Inside) -> tuple[Beside, ...]:
    longest_ms = 1e3 * inside.longest_collection_s
    collections = f"{inside.collections} collections, the longest {longest_ms:.2f} ms"
    return (
        Beside("the station's garbage collector", "below 1 ms", collections, longest_ms < 1.0),
        Beside(
            "pages that the station had to fetch from a disk", "none", str(inside.major_faults), not inside.major_faults
        ),
    )


async def _both(setup: Setup, folder: Path) -> tuple[list[Run], Inside]:
    seconds = setup.long(WATCHED_S, 2.0)
    with running_drive(folder) as thread_drive:
        async with live_service(folder, thread_drive) as service:
            logs = {PROCESS: service.drive.log, THREAD: thread_drive.log}
            with LivePatient(service.loop_port, setup.seed):
                await service.engaged()
                idle = await _watched(service, logs, "idle", seconds)
                setup.progress(0.5)
                with hogs():
                    busy = await _watched(service, logs, f"{_cores()} busy programs", seconds)
        return [*idle, *busy], read_inside(folder / "inside.json")


async def _watched(service: LiveService, logs: dict[str, DriveLog], load: str, seconds: float) -> list[Run]:
    begun_s = time.monotonic()
    while time.monotonic() - begun_s < seconds:
        await asyncio.sleep(0.5)
        await service.engaged()
    return [_run(loop, load, log, begun_s) for loop, log in logs.items()]


def _run(loop: str, load: str, log: DriveLog, begun_s: float) -> Run:
    came_s = [note.t_s for note in commands(log.since(begun_s))]
    off_s = [after - before - PERIOD_S for before, after in pairwise(came_s)]
    return Run(loop, load, percentiles([abs(each) for each in off_s]), sum(each > LATE_S for each in off_s))


@contextmanager
def hogs() -> Iterator[None]:
    """A busy program for each core, while the block lasts."""
    busy = [subprocess.Popen([sys.executable, "-c", _HOG]) for _ in range(_cores())]  # noqa: S603 - three words of ours
    try:
        yield
    finally:
        for each in busy:
            each.kill()
            each.wait()


def _cores() -> int:
    return os.cpu_count() or 1


def _table(runs: list[Run]) -> Table:
    headings = (
        Column("loop"),
        Column("load"),
        Column("commands"),
        *columns("p50 [ms]", "p99 [ms]", "max [ms]", digits=2),
        Column(f"over {1e3 * LATE_S:g} ms late"),
    )
    rows = tuple(
        (each.loop, each.load, each.off.count + 1, each.off.p50_ms, each.off.p99_ms, each.off.max_ms, each.late)
        for each in runs
    )
    return Table(
        "jitter", "How far the time between two commands is from 10 ms, by the drive's own clock", headings, rows
    )


_WHY = (
    "Both loops run at once, on the same machine and with as much to do; only the station's has a process and a "
    "priority of its own. In the web process the loop waits for the interpreter that serves pages, and for any other "
    "program. Where the system grants no real-time priority the station's loop is late under the hog too: it counts "
    "that, and holds when it is late too often (docs/station.md)."
)
EXPERIMENT = Experiment(
    "jitter",
    Chapter.SAFETY,
    "How steadily commands reach the drive",
    "No paper says. A drive wants a command every 10 ms and stops by itself after 100 ms; SR-9 wants the loop "
    "untouched by whatever else the machine does.",
    "The real service, its real station, and the same loop once more in a plain thread of the service, each with a "
    "patient who moves and a drive with a process of its own, which notes when each command came: a minute idle, a "
    "minute beside a busy program for each core.",
    run,
    order=20,
    only_by_name=True,
)
