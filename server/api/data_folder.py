"""The folder for database, recordings and logs, and the lock that keeps a second service out of it."""

from __future__ import annotations

import fcntl
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path

from fusion.errors import MachineError
from server.config import Config, default_data_folder

LOCK = "service.lock"
DATABASE = "mirrorlimb.sqlite"


def data_folder(config: Config) -> Path:
    """The data folder, made where it is missing; nobody else on the machine may look inside.

    Raises:
        MachineError: it cannot be made.
    """
    folder = Path(config.data).expanduser().resolve() if config.data else default_data_folder(config.demo)
    try:
        folder.mkdir(mode=0o700, parents=True, exist_ok=True)
    except OSError as error:
        raise MachineError(
            f"The data folder '{folder}' cannot be made: {error.strerror}",
            "a folder that this account may write to",
            "name another one with --data",
        ) from None
    return folder


@contextmanager
def locked(folder: Path) -> Iterator[None]:
    """Hold the folder's lock while the block lasts; the system lets go of it even after `kill -9`.

    Raises:
        MachineError: another service holds it, or it cannot be written.
    """
    try:
        lock = (folder / LOCK).open("a")
    except OSError as error:
        raise MachineError(
            f"The data folder '{folder}' cannot be written to: {error.strerror}",
            "a folder that this account may write to",
            "look at its permissions, or name another one with --data",
        ) from None
    with lock:
        try:
            fcntl.flock(lock, fcntl.LOCK_EX | fcntl.LOCK_NB)
        except OSError:
            raise MachineError(
                f"Another mirrorlimb is running on the data folder '{folder}'",
                "one service for each data folder",
                "use the one that runs, or end it, or name another folder with --data",
            ) from None
        yield
