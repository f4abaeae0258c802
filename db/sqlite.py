"""The one place that knows SQLite: how its file is opened so that it is safe and does not wait for ever."""

from __future__ import annotations

from typing import Any

from sqlalchemy import Connection, Engine, create_engine, event

_PRAGMAS = (
    # Before all others, so that none of them fails because another process holds the file for an instant.
    "PRAGMA busy_timeout = 3000",
    # Readers and the one writer do not wait for each other; with it, NORMAL loses nothing at a crash of the process.
    "PRAGMA journal_mode = WAL",
    "PRAGMA synchronous = NORMAL",
)


def create_sqlite_engine(path: str, *, enforce_foreign_keys: bool = True) -> Engine:
    """An engine on the file at `path`.

    Migrations must not enforce foreign keys: in batch mode a table is made anew and the old one dropped, and
    dropping it would take along every row that points to it.
    """
    engine = create_engine(f"sqlite:///{path}")
    pragmas = (*_PRAGMAS, f"PRAGMA foreign_keys = {'ON' if enforce_foreign_keys else 'OFF'}")

    @event.listens_for(engine, "connect")
    def set_up(connection: Any, _record: Any) -> None:
        # Python's own transaction handling commits before it changes a table; half a migration could then stay.
        connection.isolation_level = None
        cursor = connection.cursor()
        for pragma in pragmas:
            cursor.execute(pragma)
        cursor.close()

    # IMMEDIATE: a transaction that reads first and writes later waits at its start, instead of failing half-way
    # because another one has written in between.
    @event.listens_for(engine, "begin")
    def begin(connection: Connection) -> None:
        connection.exec_driver_sql("BEGIN IMMEDIATE")

    return engine
