"""Faults on a CAN bus of CiA 402 drives: the station's end, the drives' end, and one drive alone."""

from __future__ import annotations

from collections.abc import AsyncIterator
from contextlib import asynccontextmanager
from functools import partial
from typing import Final

from server.emulated.cia402.control import order
from server.experiments.rig.fault import BRAKING_S, UNHEARD, WATCHDOG_S, Fault
from server.experiments.rig.scene import Scene
from server.experiments.rig.station_faults import drive_frozen, station_frozen, station_killed
from server.messages import DriveState

JOINT: Final = "shoulder elevation"
OVERCURRENT: Final = 0x2310
_LATCHED: Final = frozenset({DriveState.FAULT})


@asynccontextmanager
async def _ordered(scene: Scene, what: str) -> AsyncIterator[None]:
    order(scene.drive.address, what)
    try:
        yield
    finally:
        order(scene.drive.address, "well all")


FAULTS: Final[tuple[Fault[Scene], ...]] = (
    Fault(
        "node-silent",
        f"the drive of one joint ({JOINT}) silent on the bus",
        partial(_ordered, what=f"silent {JOINT}"),
        _LATCHED,
        WATCHDOG_S + 0.1,
        WATCHDOG_S + 0.1 + BRAKING_S,
    ),
    Fault(
        "node-fault",
        f"the drive of one joint ({JOINT}) reports overcurrent",
        partial(_ordered, what=f"fault {JOINT} {OVERCURRENT:#x}"),
        _LATCHED,
        WATCHDOG_S,
        WATCHDOG_S + BRAKING_S,
    ),
    Fault(
        "station-frozen",
        "the station's process frozen (SIGSTOP); the drives miss its heartbeat",
        station_frozen,
        frozenset({DriveState.FAULT, DriveState.HOLD}),
        still_within_s=WATCHDOG_S + BRAKING_S,
        heard_after_s=0.3,
    ),
    Fault("bus-dead", "all drives gone from the bus at once", drive_frozen, _LATCHED, WATCHDOG_S + 0.1),
    Fault(
        "station-killed",
        "the station killed (SIGKILL); the drives miss its heartbeat",
        station_killed,
        UNHEARD,
        still_within_s=WATCHDOG_S + BRAKING_S,
        ends=True,
    ),
)
