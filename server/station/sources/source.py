"""What the loop asks of wherever datagrams come from."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Protocol

from fusion.messages import Packet


@dataclass(frozen=True, slots=True)
class Losses:
    """Datagrams that came and were not passed on, since the start."""

    oversized: int = 0
    strangers: int = 0
    """From senders that are not allowed."""
    overflowed: int = 0
    """Thrown away by the system because they came faster than they were taken."""

    @property
    def in_all(self) -> int:
        """Of every kind."""
        return self.oversized + self.strangers + self.overflowed


class Source(Protocol):
    """Gives the packets that have come since it was last asked, and never blocks."""

    @property
    def ports(self) -> dict[str, int]:
        """Dialect to UDP port, for people."""
        ...

    @property
    def losses(self) -> Losses:
        """What was not passed on."""
        ...

    def drain(self) -> list[Packet]:
        """The packets since the last time, each with the monotonic time of its arrival."""
        ...
