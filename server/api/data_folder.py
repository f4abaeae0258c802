"""The folder for database, recordings and logs, and the lock that keeps a second service out of it."""

from __future__ import annotations

import asyncio
import fcntl
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import IO

from fusion.errors import MachineError
from server.config import Config, default_data_folder

LOCK = "service.lock"
STATION_LOCK = "station.lock"
DATABASE = "mirrorlimb.sqlite"
GONE_WITHIN_S, LOOK_EVERY_S = 10.0, 0.1


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
        if not _taken(lock):
            raise MachineError(
                f"Another mirrorlimb is running on the data folder '{folder}'",
                "one service for each data folder",
                "use the one that runs, or end it, or name another folder with --data",
            )
        yield


async def until_station_is_gone(folder: Path) -> None:
    """Wait for a station whose service was killed: it brings the arm to rest, and ends by itself a few seconds later.

    One that is still there afterwards is somebody else's; the new station will say so.
    """
    with (folder / STATION_LOCK).open("a") as lock:
        for _ in range(int(GONE_WITHIN_S / LOOK_EVERY_S)):
            if _taken(lock):
                return
            await asyncio.sleep(LOOK_EVERY_S)


def _taken(lock: IO[str]) -> bool:
    """Take the lock if nobody holds it; closing the file lets go of it."""
    try:
        fcntl.flock(lock, fcntl.LOCK_EX | fcntl.LOCK_NB)
    except OSError:
        return False
    return True
