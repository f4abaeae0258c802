"""Writes a session's games down while they are played, in a thread of its own: no tick waits for a disk."""

from __future__ import annotations

import logging
import os
import threading
import time
from pathlib import Path
from queue import SimpleQueue
from typing import BinaryIO, Final

from games.game import GameInput
from games.replay import GameRecord
from server.api.game_log import Beginning, LoggedInput, entry

log = logging.getLogger(__name__)

WRITTEN_EVERY_S: Final = 0.1
"""What a killed program loses at most; what is written is the system's, and safe from the program's end."""
SYNCED_EVERY_S: Final = 2.0
"""What a power cut loses at most."""
KEPT: Final = 100_000
"""Entries that wait for a disk that does not answer: a quarter of an hour of play."""


class GameLogWriter:
    """An append-only file of one session's games.

    Where the disk refuses, the file ends there and stays readable: the games go on, and `trouble` says why.

    Args:
        path: the file; it must not be there yet.
        record: what the games begin with.
    """

    def __init__(self, path: Path, record: GameRecord) -> None:
        self._path = path
        self._waiting: SimpleQueue[bytes] = SimpleQueue()
        self._synced_s = time.monotonic()
        self._ended = threading.Event()
        self.trouble = ""
        """Why the file ends before the games do; "" = it does not."""
        self._waiting.put(entry(Beginning(record=record)))
        self._thread = threading.Thread(target=self._write, name="game log", daemon=True)
        self._thread.start()

    def take(self, given: GameInput, t_s: float) -> None:
        """Note an input. Never waits."""
        if self.trouble or self._ended.is_set():
            return
        if self._waiting.qsize() >= KEPT:
            self.trouble = f"{self._path}: the disk does not answer"
            return
        self._waiting.put(entry(LoggedInput.of(given, t_s)))

    def close(self) -> None:
        """Write what waits, and end. Waits for the disk: call it in a worker thread."""
        self._ended.set()
        self._thread.join()

    def _write(self) -> None:
        try:
            with self._path.open("xb") as file:
                while not self._ended.wait(WRITTEN_EVERY_S):
                    self._append(file)
                self._append(file)
                os.fsync(file.fileno())
        except OSError as error:
            self.trouble = f"{self._path}: {error.strerror}"
            log.error("the games are no longer written down: %s", self.trouble)

    def _append(self, file: BinaryIO) -> None:
        waiting = [self._waiting.get() for _ in range(self._waiting.qsize())]
        file.write(b"".join(waiting))
        file.flush()
        if time.monotonic() - self._synced_s >= SYNCED_EVERY_S:
            os.fsync(file.fileno())
            self._synced_s = time.monotonic()
