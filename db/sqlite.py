"""The one place that knows SQLite: how its file is opened so that it is safe and does not wait for ever."""

from __future__ import annotations

from typing import Any

from sqlalchemy import Engine, create_engine, event

_PRAGMAS = (
    # Before all others, so that none of them fails because another process holds the file for an instant.
    "PRAGMA busy_timeout = 3000",
    # Readers and the one writer do not wait for each other; with it, NORMAL loses nothing at a crash of the process.
    "PRAGMA journal_mode = WAL",
    "PRAGMA synchronous = NORMAL",
    "PRAGMA foreign_keys = ON",
)


def create_sqlite_engine(path: str) -> Engine:
    """An engine on the file at `path`."""
    engine = create_engine(f"sqlite:///{path}")
    event.listen(engine, "connect", _set_up)
    return engine


def _set_up(connection: Any, _record: Any) -> None:
    cursor = connection.cursor()
    for pragma in _PRAGMAS:
        cursor.execute(pragma)
    cursor.close()
