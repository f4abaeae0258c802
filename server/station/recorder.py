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
        self._entries_kept = entries_kept
        self._queue: queue.SimpleQueue[_Entry | None] = queue.SimpleQueue()
        """None is the end mark: behind it comes nothing."""
        self._ended = False
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
        """Write what waits and close the file, in the recorder's own time; `finished` says when.

        What comes afterwards is not part of the recording, and is not lost either.
        """
        if not self._ended:
            self._ended = True
            self._queue.put(None)

    @property
    def finished(self) -> bool:
        """Whether the file is closed."""
        return not self._thread.is_alive()

    def close(self) -> None:
        """Finish, and wait for it."""
        self.finish()
        self._thread.join(CLOSE_WITHIN_S)

    def _put(self, entry: _Entry) -> None:
        if self._ended:
            return
        if self._queue.qsize() < self._entries_kept:
            self._queue.put(entry)
        else:
            self.dropped += 1

    def _work(self) -> None:
        flush_s = time.monotonic() + FLUSH_S
        while (entry := self._next(flush_s)) is not None:
            if entry is LogWriter.flush:
                self._attempt(entry, lost=0)
                flush_s = time.monotonic() + FLUSH_S
            else:
                self._attempt(entry)
        self._attempt(LogWriter.close, lost=0)

    def _next(self, flush_s: float) -> _Entry | None:
        """What is to be done next: a flush when one is due, nothing more after the end mark."""
        left_s = flush_s - time.monotonic()
        try:
            return self._queue.get(timeout=left_s) if left_s > 0 else LogWriter.flush
        except queue.Empty:
            return LogWriter.flush

    def _attempt(self, entry: _Entry, lost: int = 1) -> None:
        """A full disk costs the recording, never the session."""
        try:
            entry(self._writer)
        except (OSError, ValueError) as error:
            self.dropped += lost
            if not self.trouble:
                self.trouble = f"The recording {self.path.name} cannot be written: {error}."
                log.error("%s", self.trouble)
