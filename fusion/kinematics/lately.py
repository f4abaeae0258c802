"""The latest numbers of a kind, and their median."""

from __future__ import annotations

from bisect import bisect_left, insort
from collections import deque


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
        if not self._by_size:
            return float("inf")
        middle = self.count // 2
        if self.count % 2:
            return self._by_size[middle]
        return 0.5 * (self._by_size[middle - 1] + self._by_size[middle])

    def take(self, number: float) -> None:
        """Remember one more, which is not NaN."""
        self._by_time.append(number)
        insort(self._by_size, number)
        if self.count > self._memory:
            del self._by_size[bisect_left(self._by_size, self._by_time.popleft())]
