"""Ours: SR-8's single faults, put into real processes, and the time to the safe state of each."""

from __future__ import annotations

import asyncio
import tempfile
from collections.abc import Callable
from contextlib import AbstractAsyncContextManager
from importlib.util import find_spec
from pathlib import Path
from statistics import median
from typing import Final

from fusion.experiments.experiment import Chapter, Experiment, Setup
from fusion.experiments.outcome import Beside, Cell, Column, Outcome, Table, columns
from server.experiments.rig import service_faults, station_faults
from server.experiments.rig.fault import Fault, Where
from server.experiments.rig.live_service import live_service
from server.experiments.rig.observing import Observed, observed, trouble
from server.experiments.rig.scene import scene

TIMES: Final = 2
ENDING_TIMES: Final = 1
"""Faults after which everything must be started again."""
ATTEMPTS: Final = 3
"""Where the machine stood still meanwhile, once more."""
FAST_RAD_S: Final = 0.6
GOES_ON: Final = "goes on within its limits"


def run(setup: Setup) -> Outcome:
    """Each fault several times; those that end the station in scenes of their own."""
    with tempfile.TemporaryDirectory(prefix="mirrorlimb-") as folder:
        rows = asyncio.run(_all(setup, Path(folder)))
    safe = sum(row.is_safe for row in rows)
    outside = max(each.outside_rad for row in rows for each in row.found)
    repeated = sum(row.repeated for row in rows)
    return Outcome(
        (
            Beside(
                "faults that ended safely and in time, each time",
                "all (SR-8)",
                f"{safe} of {len(rows)}",
                safe == len(rows),
            ),
            Beside("farthest measured outside the limits", "never", f"{outside:.3f} rad", outside == 0.0),
            Beside("put in once more, as the machine itself had stood still", "not given", str(repeated)),
        ),
        (_table(rows),),
        (),
        _WHY,
        (setup.seed,),
        () if find_spec("can") else ("the CAN bus: python-can is not installed (extra 'can')",),
    )


class Row:
    """One fault, and what it did each time."""

    def __init__(self, around: str, what: str, limit_s: float | None, goes_on: bool) -> None:
        self.around, self.what, self.limit_s, self.goes_on = around, what, limit_s, goes_on
        self.found: list[Observed] = []
        self.troubles: list[str] = []
        self.repeated = 0

    @property
    def is_safe(self) -> bool:
        """Whether it ended safely each time."""
        return bool(self.found) and not any(self.troubles)


async def _all(setup: Setup, folder: Path) -> list[Row]:
    rows: list[Row] = []
    times, ending = setup.many(TIMES), setup.many(ENDING_TIMES)
    await _around(
        "station", station_faults.FAULTS, lambda k: scene(_new(folder, f"scene-{k}"), FAST_RAD_S), (times, ending), rows
    )
    setup.progress(0.4)
    if find_spec("can") is not None:
        await _around_the_bus(folder, (times, ending), rows)
    setup.progress(0.6)
    await _around(
        "service", service_faults.FAULTS, lambda k: live_service(_new(folder, f"service-{k}")), (times, ending), rows
    )
    return rows


async def _around_the_bus(folder: Path, times: tuple[int, int], rows: list[Row]) -> None:
    # python-can is an optional extra; the other faults work without it.
    from server.experiments.rig.can_faults import FAULTS
    from server.experiments.rig.can_scene import can_scene

    await _around("CAN bus", FAULTS, lambda k: can_scene(_new(folder, f"can-{k}"), FAST_RAD_S), times, rows)


def _new(folder: Path, name: str) -> Path:
    made = folder / name
    made.mkdir()
    return made


async def _around(
    what: str,
    faults: tuple[Fault[Where], ...],
    opened: Callable[[int], AbstractAsyncContextManager[Where]],
    times: tuple[int, int],
    rows: list[Row],
) -> None:
    """All faults of one kind; what ends a scene is put in last, and once in each scene more."""
    own = {fault.name: Row(what, fault.what, fault.still_within_s, fault.goes_on) for fault in faults}
    rows += own.values()
    usual, ending = times
    for k in range(ending):
        async with opened(k) as where:
            for fault in faults if k == 0 else ():
                for _ in range(0 if fault.ends else usual):
                    await _once(where, fault, own[fault.name], ATTEMPTS)
            for fault in faults:
                if fault.ends:
                    await _once(where, fault, own[fault.name], 1)


async def _once(where: Where, fault: Fault[Where], row: Row, attempts: int) -> None:
    for attempt in range(attempts):
        found = await observed(where, fault)
        said = trouble(found, fault)
        if not said or attempt == attempts - 1:
            row.found.append(found)
            row.troubles.append(said)
            return
        row.repeated += 1


def _table(rows: list[Row]) -> Table:
    headings = (
        Column("around"),
        Column("fault"),
        Column("times"),
        Column("safe state"),
        *columns("state changed after, median [ms]", "longest [ms]", "arm stands after, median [ms]", "longest [ms]"),
        Column("at most [ms]"),
        Column("safe"),
    )
    return Table(
        "faults",
        "From the fault to the safe state, by the station's and the drive's own clocks",
        headings,
        tuple(map(_cells, rows)),
    )


def _cells(row: Row) -> tuple[Cell, ...]:
    decided = [each.decided_s for each in row.found if each.decided_s is not None and not row.goes_on]
    still = [each.still_s for each in row.found if each.still_s is not None and row.limit_s is not None]
    at_most = "–" if row.limit_s is None else f"{1e3 * row.limit_s:.0f}"
    states = " / ".join(sorted({_state(each, row) for each in row.found}))
    safe = "yes" if row.is_safe else "; ".join(filter(None, row.troubles))
    return (row.around, row.what, len(row.found), states, *_two(decided), *_two(still), at_most, safe)


def _state(found: Observed, row: Row) -> str:
    if row.goes_on:
        return GOES_ON
    return f"{found.state or 'the drive holds'}" + (f": {found.reason}" if found.reason else "")


def _two(times_s: list[float]) -> tuple[Cell, Cell]:
    if not times_s:
        return "–", "–"
    return f"{1e3 * median(times_s):.0f}", f"{1e3 * max(times_s):.0f}"


_WHY = (
    "Each fault is put in while some joint moves faster than 0.6 rad/s (0.2 around the service) and the patient goes "
    "on moving; the drive has a process, a clock and a watchdog of its own, so that what it does can be seen when its "
    "station is gone. 'State changed' is the station's own word, or the first command that comes to rest; a drive that "
    "hears nothing acts by itself. 'Stands' is measured: no joint faster than 0.05 rad/s and further than 0.3 degrees "
    "from where it ends. The full disk is a limit on the size of files, which the kernel answers as it answers a full "
    "disk; the wall clock is stepped for the station alone, with the kernel's stamps of its datagrams, and the "
    "machine's own is left."
)
EXPERIMENT = Experiment(
    "fault-injection",
    Chapter.SAFETY,
    "Single faults in real processes",
    "No paper says. SR-8: any single fault reaches the safe state in its time.",
    "The real station with a moving patient and a drive in a process of its own, the same with emulated CiA 402 "
    "drives on a CAN bus between processes, and the real service with its station: processes killed and frozen, "
    "sensors unplugged, datagrams dropped, doubled, reordered and corrupted, the wall clock stepped, the disk full, "
    "the database locked, the page in charge closed.",
    run,
    order=22,
    only_by_name=True,
)
