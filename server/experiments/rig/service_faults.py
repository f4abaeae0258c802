"""Faults around a whole service: its process, its database, its disk, and its station's process."""

from __future__ import annotations

import asyncio
import resource
import sqlite3
from collections.abc import AsyncIterator
from contextlib import asynccontextmanager, closing
from typing import Final

from server.api.data_folder import DATABASE
from server.experiments.rig.fault import (
    BRAKING_S,
    HEARTBEAT_S,
    HELD,
    SOON_S,
    UNHEARD,
    UNMOVED,
    WATCHDOG_S,
    Fault,
)
from server.experiments.rig.live_service import LiveService
from server.messages import DriveState

LOCKED_WITHIN_S: Final = 5.0
_STOPPED: Final = frozenset({DriveState.STOPPED})


@asynccontextmanager
async def _killed(service: LiveService) -> AsyncIterator[None]:
    service.process.kill()
    yield


@asynccontextmanager
async def _frozen(service: LiveService) -> AsyncIterator[None]:
    service.freeze()
    try:
        yield
    finally:
        service.thaw()


@asynccontextmanager
async def _page_closed(service: LiveService) -> AsyncIterator[None]:
    await service.close_page()
    try:
        yield
    finally:
        await service.open_page()


@asynccontextmanager
async def _database_locked(service: LiveService) -> AsyncIterator[None]:
    path = service.data / "service" / DATABASE
    with closing(sqlite3.connect(path, timeout=LOCKED_WITHIN_S, isolation_level=None)) as database:
        database.execute("BEGIN EXCLUSIVE")
        try:
            yield
        finally:
            database.execute("ROLLBACK")


@asynccontextmanager
async def _disk_full(service: LiveService) -> AsyncIterator[None]:
    """No file of the service or its station may grow."""
    pids = (service.process.pid, service.station.pid)
    before = [resource.prlimit(pid, resource.RLIMIT_FSIZE, (0, resource.RLIM_INFINITY)) for pid in pids]
    try:
        yield
    finally:
        for pid, limits in zip(pids, before, strict=True):
            resource.prlimit(pid, resource.RLIMIT_FSIZE, limits)


@asynccontextmanager
async def _stopped_while(service: LiveService) -> AsyncIterator[None]:
    async with _database_locked(service):
        pressed = asyncio.create_task(service.control("stop"))
        yield
    await pressed


@asynccontextmanager
async def _station_killed(service: LiveService) -> AsyncIterator[None]:
    service.station.kill()
    await service.heard_again()
    try:
        yield
    finally:
        await service.end_session()
        await service.open_session()


FAULTS: Final[tuple[Fault[LiveService], ...]] = (
    Fault(
        "page-closed",
        "the page in charge closed",
        _page_closed,
        UNHEARD,
        HEARTBEAT_S + SOON_S,
        HEARTBEAT_S + SOON_S + BRAKING_S,
        ("charge",),
    ),
    Fault("database-locked", "the database locked by another program", _database_locked, UNMOVED),
    Fault(
        "stop-database-locked",
        "a person stops while the database is locked",
        _stopped_while,
        _STOPPED,
        HEARTBEAT_S,
        HEARTBEAT_S + BRAKING_S,
        ("pressed stop",),
    ),
    Fault("disk-full", "disk full under database, recording and logs", _disk_full, UNMOVED, watched_s=1.3),
    Fault(
        "service-frozen",
        "the service frozen (SIGSTOP)",
        _frozen,
        HELD,
        HEARTBEAT_S + SOON_S,
        HEARTBEAT_S + SOON_S + BRAKING_S,
        ("silent", "charge"),
        heard_after_s=0.3,
    ),
    Fault(
        "station-killed",
        "the station killed (SIGKILL); its service starts another",
        _station_killed,
        frozenset({DriveState.OFF}),
        still_within_s=WATCHDOG_S + BRAKING_S,
    ),
    Fault(
        "service-killed",
        "the service killed (SIGKILL)",
        _killed,
        UNHEARD,
        HEARTBEAT_S,
        HEARTBEAT_S + BRAKING_S,
        ("gone",),
        ends=True,
    ),
)
