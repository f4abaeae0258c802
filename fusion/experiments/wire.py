"""A way for datagrams from us to us; who opens sockets provides it."""

from __future__ import annotations

from typing import Protocol


class Wire(Protocol):
    """Datagrams go in at one end and come out at the other."""

    def send(self, payload: bytes) -> None:
        """Put one datagram in."""
        ...

    def receive(self) -> bytes:
        """Wait for the next datagram."""
        ...

    def close(self) -> None:
        """Give the network back."""
        ...
