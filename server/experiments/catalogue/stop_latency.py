"""Ours: how long a software stop takes from the button to the drive, with everything that the service does at once."""

from __future__ import annotations

import asyncio
import os
import subprocess
import sys
import tempfile
import time
from collections.abc import AsyncIterator
from contextlib import asynccontextmanager
from dataclasses import dataclass
from pathlib import Path
from typing import Final

import httpx

from fusion.errors import MachineError
from fusion.experiments.experiment import Chapter, Experiment, Setup
from fusion.experiments.outcome import Beside, Column, Outcome, Table, columns
from server.api.data_folder import DATABASE
from server.experiments.rig.drive_log import told_after_s
from server.experiments.rig.live_service import LiveService, live_service
from server.experiments.rig.measures import Percentiles, percentiles

STOPS: Final = 200
QUIET_STOPS: Final = 40
PAGES: Final = 100
WRITERS: Final = 2
GOAL_MS: Final = 50.0
ENGAGED_S: Final = 0.03
"""How long the arm follows before it is stopped."""
LOOKED_FOR_S: Final = 2.0
CROWD_WITHIN_S: Final = 60.0
KEPT, FRESH = "kept open", "opened for it"


@dataclass(frozen=True, slots=True)
class Stop:
    """One stop."""

    connection: str
    to_drive_s: float
    """From the request to the drive's getting the command."""
    to_answer_s: float
    """From the request to the answer on the page."""


def run(setup: Setup) -> Outcome:
    """Stops with one page open, then with everybody there."""
    with tempfile.TemporaryDirectory(prefix="mirrorlimb-") as folder:
        quiet, full = asyncio.run(_measured(setup, Path(folder)))
    loads = {"one page open": quiet, f"{PAGES} pages, 3-D view, database under load": full}
    judged = percentiles([stop.to_drive_s for stop in full])
    within = sum(1e3 * stop.to_drive_s <= GOAL_MS for stop in full) / len(full)
    return Outcome(
        (
            Beside(
                f"stop to drive under full load, p50 / p99 / max, {judged.count} stops",
                "p99 at most 50 ms (SR-7)",
                judged.words,
                judged.p99_ms <= GOAL_MS,
            ),
            Beside("stops that reached the drive within 50 ms under full load", "99 %", f"{100 * within:.1f} %"),
            Beside(
                "stop to drive with one page open", "for comparison", percentiles([s.to_drive_s for s in quiet]).words
            ),
        ),
        (_table(loads),),
        (),
        _WHY,
        (setup.seed,),
    )


async def _measured(setup: Setup, folder: Path) -> tuple[list[Stop], list[Stop]]:
    async with live_service(folder) as service:
        quiet = await _stops(service, setup.many(QUIET_STOPS, 2))
        async with _crowd(service):
            full: list[Stop] = []
            while len(full) < setup.many(STOPS, 4):
                full += await _stops(service, 2)
                setup.progress(len(full) / setup.many(STOPS, 4))
    return quiet, full


async def _stops(service: LiveService, number: int) -> list[Stop]:
    """Half of them over the page's own connection, half over a new one each."""
    stops = []
    for k in range(number):
        await service.engaged()
        await asyncio.sleep(ENGAGED_S)
        async with service.another_page() as other:
            stops.append(await _stop(service, other if k % 2 else service.page, FRESH if k % 2 else KEPT))
    return stops


async def _stop(service: LiveService, page: httpx.AsyncClient, connection: str) -> Stop:
    """What key, click and REST do alike."""
    since_s = time.monotonic()
    await service.control("stop", page)
    answered_s = time.monotonic()
    while time.monotonic() < since_s + LOOKED_FOR_S:
        to_drive_s = told_after_s(service.drive.log.since(since_s), since_s, "pressed stop")
        if to_drive_s is not None:
            return Stop(connection, to_drive_s, answered_s - since_s)
        await asyncio.sleep(0.01)
    raise MachineError(f"a stop did not reach the drive within {LOOKED_FOR_S:g} s", "", "read the service's log")


@asynccontextmanager
async def _crowd(service: LiveService) -> AsyncIterator[None]:
    """Everybody else, while the block lasts."""
    whom = ["--url", service.url, "--cookie", service.cookie, "--database", str(service.data / "service" / DATABASE)]
    command = [sys.executable, "-m", "server.experiments.rig.crowd", *whom]
    load = ["--pages", str(PAGES), "--writers", str(WRITERS)]
    crowd = subprocess.Popen([*command, *load], stdout=subprocess.PIPE, stdin=subprocess.DEVNULL)  # noqa: S603 - ours
    try:
        if crowd.stdout is None or not await asyncio.wait_for(asyncio.to_thread(crowd.stdout.readline), CROWD_WITHIN_S):
            raise MachineError("the pages could not all be opened", f"{PAGES} open pages")
        yield
        if crowd.poll() is not None:
            raise MachineError("the crowd went away before the end; what was measured is not the full load")
    finally:
        crowd.kill()
        crowd.wait()


def _table(loads: dict[str, list[Stop]]) -> Table:
    headings = (
        Column("load"),
        Column("connection"),
        Column("stops"),
        *columns("to the drive p50 [ms]", "p99 [ms]", "max [ms]", "to the page's answer p50 [ms]", "p99 [ms]"),
    )
    rows = []
    for load, stops in loads.items():
        for connection in (KEPT, FRESH):
            told, answered = _percentiles([stop for stop in stops if stop.connection == connection])
            rows.append(
                (load, connection, told.count, told.p50_ms, told.p99_ms, told.max_ms, answered.p50_ms, answered.p99_ms)
            )
    return Table(
        "stop", "From the request to the drive's getting the command, by the drive's clock", headings, tuple(rows)
    )


def _percentiles(stops: list[Stop]) -> tuple[Percentiles, Percentiles]:
    return percentiles([stop.to_drive_s for stop in stops]), percentiles([stop.to_answer_s for stop in stops])


_WHY = (
    "Half a period is spent waiting for the next tick, which reads the stop's own channel first. The rest is the web "
    f"process: its one event loop serves all pages. This machine has {os.cpu_count()} cores, and pages, writers and "
    "service share them; the stop proper is hardware."
)
EXPERIMENT = Experiment(
    "stop-latency",
    Chapter.SAFETY,
    "How long a software stop takes",
    "No paper says. SR-7: the software stop reaches the driver within 50 ms in 99 of 100 cases under full load.",
    "The real service, its real station and a drive with a process of its own. A hundred pages follow the live stream "
    "and draw as fast as they are sent to, one has the 3-D view open, two people enrol patients without a pause, "
    "another program keeps the database file busy with transactions. The arm is engaged and stopped again and again, "
    "by the request that key, click and REST make alike, over the page's own connection and over a new one.",
    run,
    order=21,
    only_by_name=True,
)
