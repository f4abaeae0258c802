"""Brings a database to this program's form, or says why it cannot be."""

from __future__ import annotations

from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path

from alembic import command
from alembic.config import Config
from alembic.runtime.migration import MigrationContext
from alembic.script import ScriptDirectory
from alembic.util.exc import CommandError
from sqlalchemy import Connection
from sqlalchemy.exc import DatabaseError as SqlDatabaseError

from db.errors import CannotOpenError, TooNewError
from db.sqlite import create_sqlite_engine

MIGRATIONS = Path(__file__).parent / "migrations"


def upgrade(path: str, revision: str = "head") -> None:
    """Bring the database at `path` to `revision`; all of it, or nothing.

    Raises:
        CannotOpenError: not a database, no permission, no such folder.
        TooNewError: written by a newer version of this program.
    """
    with _connection(path) as connection:
        _refuse_newer(connection, path)
        command.upgrade(_config(connection), revision)


def downgrade(path: str, revision: str) -> None:
    """Take the database at `path` back to `revision` ("base" is empty)."""
    with _connection(path) as connection:
        command.downgrade(_config(connection), revision)


@contextmanager
def _connection(path: str) -> Iterator[Connection]:
    engine = create_sqlite_engine(path, enforce_foreign_keys=False)
    try:
        with engine.begin() as connection:
            yield connection
    except SqlDatabaseError as error:
        raise _cannot_open(path, error) from error
    finally:
        engine.dispose()


def _config(connection: Connection) -> Config:
    config = Config()
    config.set_main_option("script_location", str(MIGRATIONS))
    config.attributes["connection"] = connection
    return config


def _refuse_newer(connection: Connection, name: str) -> None:
    revision = MigrationContext.configure(connection).get_current_revision()
    if revision is None:
        return
    try:
        ScriptDirectory(str(MIGRATIONS)).get_revision(revision)
    except CommandError as error:
        raise TooNewError(
            f"the database {name} has the form '{revision}', which this program does not know",
            "a database written by this version or an older one",
            "start the newer version of mirrorlimb, or name another folder with --data",
        ) from error


def _cannot_open(name: str, error: SqlDatabaseError) -> CannotOpenError:
    return CannotOpenError(
        f"the database {name} cannot be opened ({error.orig})",
        "a file that this program made, in a folder that it may write to",
        "look at the file and its permissions, put back a copy, or name another folder with --data",
    )
