"""Opens the database, brings it to this program's form, and hands out sessions."""

from __future__ import annotations

from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path

from sqlalchemy import Engine
from sqlalchemy.exc import DBAPIError
from sqlmodel import Session

from db.errors import NotStoredError
from db.migrate import upgrade
from db.sqlite import create_sqlite_engine


class Database:
    """An open database at this program's form.

    Use `session()` for work that belongs together: it is stored wholly when the block ends, or not at all.
    """

    def __init__(self, engine: Engine) -> None:
        self.engine = engine

    @contextmanager
    def session(self) -> Iterator[Session]:
        """A unit of work.

        Raises:
            NotStoredError: the database refused it (locked, full, a constraint); nothing was kept.
        """
        with Session(self.engine, expire_on_commit=False) as session:
            try:
                yield session
                session.commit()
            except DBAPIError as error:
                session.rollback()
                raise _not_stored(self.engine, error) from error

    def close(self) -> None:
        """Let go of the file."""
        self.engine.dispose()


def open_database(path: Path | str) -> Database:
    """Open, or make, the database file at `path` and bring it to the newest form.

    Raises:
        CannotOpenError: not a database, no permission, no such folder.
        TooNewError: written by a newer version of this program.
    """
    upgrade(str(path))
    return Database(create_sqlite_engine(str(path)))


def _not_stored(engine: Engine, error: DBAPIError) -> NotStoredError:
    return NotStoredError(
        f"the database {engine.url.database} refused a change ({error.orig})",
        "a file that can be written, on a disk with room",
        "look at the disk's space and the file's permissions, and that no other program holds the file",
    )
