"""What a process says of its inside when it ends: garbage collections, and memory that came from a disk."""

from __future__ import annotations

import gc
import resource
import time
from pathlib import Path

import msgspec


class Inside(msgspec.Struct):
    """Counted from `Watch.begin` on."""

    collections: int = 0
    """Of the garbage collector."""
    longest_collection_s: float = 0.0
    major_faults: int = 0
    """Pages that had to be read from a disk before the process could go on."""


class Watch:
    """Counts until it is written down."""

    def __init__(self) -> None:
        self._inside = Inside()
        self._began_s = 0.0
        self._faults = _major_faults()

    def begin(self) -> None:
        """Count from now on; what came before was the start."""
        self._inside, self._faults = Inside(), _major_faults()
        gc.callbacks.append(self._collected)

    def write(self, path: Path) -> None:
        """Write it down."""
        self._inside.major_faults = _major_faults() - self._faults
        path.write_bytes(msgspec.json.encode(self._inside))

    def _collected(self, phase: str, _: dict[str, int]) -> None:
        if phase == "start":
            self._began_s = time.perf_counter()
            return
        self._inside.collections += 1
        took_s = time.perf_counter() - self._began_s
        self._inside.longest_collection_s = max(self._inside.longest_collection_s, took_s)


def read_inside(path: Path) -> Inside:
    """What a process wrote down."""
    return msgspec.json.decode(path.read_bytes(), type=Inside)


def _major_faults() -> int:
    return resource.getrusage(resource.RUSAGE_SELF).ru_majflt
