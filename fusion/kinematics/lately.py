"""The latest numbers of a kind, and their median."""

from __future__ import annotations

from bisect import bisect_left, insort
from collections import deque
from math import inf


class Lately:
    """Remembers so many numbers, in order of time and in order of size.

    Args:
        memory: how many; the oldest leaves for the newest.
    """

    def __init__(self, memory: int) -> None:
        self._memory = memory
        self._by_time: deque[float] = deque()
        self._by_size: list[float] = []

    @property
    def count(self) -> int:
        """How many there are so far."""
        return len(self._by_size)

    @property
    def median(self) -> float:
        """Of those remembered; infinite where there is none."""
        in_order = self._by_size
        if not in_order:
            return inf
        middle, is_odd = divmod(len(in_order), 2)
        return in_order[middle] if is_odd else 0.5 * (in_order[middle - 1] + in_order[middle])

    def take(self, number: float) -> None:
        """Remember one more, which is not NaN."""
        self._by_time.append(number)
        insort(self._by_size, number)
        if len(self._by_size) > self._memory:
            del self._by_size[bisect_left(self._by_size, self._by_time.popleft())]
