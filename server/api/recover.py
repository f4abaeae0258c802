"""At start: sessions that a crash left open are closed, and what could not be measured then is measured now."""

from __future__ import annotations

import logging
from datetime import UTC, datetime
from pathlib import Path

from fastapi.concurrency import run_in_threadpool

from db.columns import now_utc
from db.database import Database
from db.errors import DatabaseError
from db.queries import sessions
from db.therapy_session import SessionStatus, TherapySession
from server.api import session_store
from server.api.figures import Figures

log = logging.getLogger(__name__)


async def close_left_open(database: Database, data: Path) -> list[int]:
    """Close what the last run left open, before anybody can open a new session; the numbers of those to measure.

    Never fails: what cannot be closed now is logged, and stays for the next start.
    """
    try:
        return await run_in_threadpool(_close_left_open, database, data)
    except DatabaseError as error:
        log.error("unfinished sessions could not be closed: %s", error)
        return []


async def measure_all(figures: Figures, left: list[int]) -> None:
    """Measure what the last run could not; long recordings take their time, so this runs beside everything else."""
    for session_id in left:
        await figures.measure(session_id)


def _close_left_open(database: Database, data: Path) -> list[int]:
    with database.session() as session:
        left = sessions.sessions_left_open(session)
    for found in left:
        if found.status is SessionStatus.OPEN:
            ended_at = _last_written(data / found.recording) or now_utc()
            session_store.finish(database, found.id or 0, SessionStatus.INTERRUPTED, ended_at, None)
    return [found.id or 0 for found in left if _is_recorded(data, found)]


def _is_recorded(data: Path, found: TherapySession) -> bool:
    return (data / found.recording).is_file()


def _last_written(recording: Path) -> datetime | None:
    try:
        return datetime.fromtimestamp(recording.stat().st_mtime, UTC)
    except OSError:
        return None
