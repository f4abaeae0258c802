"""A letter box for one reader that holds the newest letter only, so that a slow reader slows nobody."""

from __future__ import annotations

import asyncio
from collections.abc import Iterator
from contextlib import contextmanager
from typing import Generic, TypeVar

T = TypeVar("T")


class Newest(Generic[T]):
    """Holds the newest value until it is taken; an older one is replaced."""

    def __init__(self) -> None:
        self._value: T | None = None
        self._there = asyncio.Event()

    def put(self, value: T) -> None:
        """Replace whatever lies there. Never waits."""
        self._value = value
        self._there.set()

    async def take(self) -> T:
        """The newest value; waits for one that has not been taken."""
        while True:
            await self._there.wait()
            self._there.clear()
            value, self._value = self._value, None
            if value is not None:
                return value


class FanOut(Generic[T]):
    """Gives every value to every reader's letter box."""

    def __init__(self) -> None:
        self._boxes: set[Newest[T]] = set()

    def put(self, value: T) -> None:
        """Give the value to all readers. Never waits."""
        for box in self._boxes:
            box.put(value)

    @property
    def readers(self) -> int:
        """How many are reading."""
        return len(self._boxes)

    @contextmanager
    def reading(self) -> Iterator[Newest[T]]:
        """A letter box of one's own while the block lasts."""
        box: Newest[T] = Newest()
        self._boxes.add(box)
        try:
            yield box
        finally:
            self._boxes.discard(box)
