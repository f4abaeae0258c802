"""Slows down whoever guesses passwords: pure, told the time."""

from __future__ import annotations

from collections import OrderedDict
from dataclasses import dataclass


@dataclass(frozen=True, slots=True)
class _Failures:
    count: int
    blocked_until_s: float


class Throttle:
    """After `free` failures in a row under one key, each further one doubles the wait, up to `longest_s`."""

    def __init__(self, free: int, longest_s: float = 300.0, remembered: int = 10_000) -> None:
        self._free, self._longest_s, self._remembered = free, longest_s, remembered
        self._failures: OrderedDict[str, _Failures] = OrderedDict()

    def wait_s(self, key: str, now_s: float) -> float:
        """How long this key must still wait; 0 when it may try."""
        found = self._failures.get(key)
        return 0.0 if found is None else max(0.0, found.blocked_until_s - now_s)

    def failed(self, key: str, now_s: float) -> None:
        """Count a failure."""
        before = self._failures.pop(key, None)
        count = 1 if before is None else before.count + 1
        over = count - self._free
        wait = 0.0 if over < 0 else min(2.0 ** min(over, 30), self._longest_s)
        self._failures[key] = _Failures(count, now_s + wait)
        while len(self._failures) > self._remembered:
            self._failures.popitem(last=False)

    def succeeded(self, key: str) -> None:
        """Forget the failures of this key."""
        self._failures.pop(key, None)
