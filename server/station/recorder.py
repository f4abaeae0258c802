"""The recorder: a bounded queue in front of a thread of its own, so that no disk can hold up the loop (SR-9)."""

from __future__ import annotations

import logging
import queue
import threading
import time
from collections.abc import Callable
from pathlib import Path

from fusion.messages import Packet, SkeletonSample
from fusion.recording.log import LogAbout, LogWriter

log = logging.getLogger(__name__)

ENTRIES_KEPT = 20_000
"""Entries that wait for the disk: about five seconds of two sensors."""
FLUSH_S = 1.0
"""`kill -9` loses at most what came since."""
CLOSE_WITHIN_S = 5.0

_Entry = Callable[[LogWriter], None]


class Recorder:
    """Writes one recording; every method returns at once.

    Args:
        path: the file to make.
        about: what the recording says of itself.

    Raises:
        MachineError: the file cannot be made.
    """

    def __init__(self, path: Path, about: LogAbout, entries_kept: int = ENTRIES_KEPT) -> None:
        self.path = path
        self.dropped = 0
        """Entries that were not written: the disk was too slow, or refused."""
        self.trouble = ""
        """Why the disk refused, in words."""
        self._writer = LogWriter(path, about)
        self._queue: queue.Queue[_Entry | None] = queue.Queue(entries_kept)
        self._closing = threading.Event()
        self._thread = threading.Thread(target=self._work, name="recorder", daemon=True)
        self._thread.start()

    def packet(self, packet: Packet) -> None:
        """Record a datagram as it came."""
        self._put(lambda writer: writer.packet(packet))

    def sample(self, sample: SkeletonSample) -> None:
        """Record a decoded sample."""
        self._put(lambda writer: writer.sample(sample))

    def tick(self, tick: bytes, t_s: float) -> None:
        """Record an encoded tick."""
        self._put(lambda writer: writer.tick(tick, t_s))

    def event(self, event: bytes, t_s: float) -> None:
        """Record an encoded event."""
        self._put(lambda writer: writer.event(event, t_s))

    def finish(self) -> None:
        """Write what waits and close the file, in the recorder's own time; `finished` says when."""
        self._closing.set()

    @property
    def finished(self) -> bool:
        """Whether the file is closed."""
        return not self._thread.is_alive()

    def close(self) -> None:
        """Finish, and wait for it."""
        self.finish()
        self._thread.join(CLOSE_WITHIN_S)

    def _put(self, entry: _Entry) -> None:
        try:
            self._queue.put_nowait(entry)
        except queue.Full:
            self.dropped += 1

    def _work(self) -> None:
        flush_s = time.monotonic() + FLUSH_S
        while not (self._closing.is_set() and self._queue.empty()):
            entry = self._next()
            if entry is not None:
                self._attempt(entry)
            if time.monotonic() >= flush_s:
                self._attempt(LogWriter.flush, lost=0)
                flush_s = time.monotonic() + FLUSH_S
        self._attempt(LogWriter.close, lost=0)

    def _next(self) -> _Entry | None:
        try:
            return self._queue.get(timeout=0.05)
        except queue.Empty:
            return None

    def _attempt(self, entry: _Entry, lost: int = 1) -> None:
        """A full disk costs the recording, never the session."""
        try:
            entry(self._writer)
        except (OSError, ValueError) as error:
            self.dropped += lost
            if not self.trouble:
                self.trouble = f"The recording {self.path.name} cannot be written: {error}."
                log.error("%s", self.trouble)
