"""What every wire dialect can do, and how a table of them is kept."""

from __future__ import annotations

import zlib
from collections.abc import Mapping
from typing import Protocol

from fusion.formats.osc import Argument, BadDatagram, Message, Reason
from fusion.messages import SkeletonSample


class Assembler(Protocol):
    """Turns one sender's messages into samples; keeps the frames that are still open. Call `flush` before `take`."""

    def take(self, message: Message, now_s: float) -> list[SkeletonSample]:
        """Take one message received at `now_s`; returns the samples that it completes.

        Raises:
            BadDatagram: the message cannot be used.
        """
        ...

    def end_of_bundle(self) -> list[SkeletonSample]:
        """The bundle that the latest messages came in has ended."""
        ...

    def flush(self, now_s: float) -> list[SkeletonSample]:
        """Close what has been silent for too long."""
        ...


class Dialect(Protocol):
    """One way of saying skeletons in OSC. A new dialect is a new file and a line in `registry`."""

    @property
    def name(self) -> str:
        """Name for `--dialect`."""
        ...

    @property
    def port(self) -> int:
        """UDP port that its senders use."""
        ...

    def claims(self, address: str) -> bool:
        """Whether an OSC address is this dialect's."""
        ...

    def assembler(self, stream: str) -> Assembler:
        """A fresh assembler for one sender."""
        ...

    def encode(self, sample: SkeletonSample, sequence: int) -> list[bytes]:
        """A sample as the datagrams that a real sender would send, in its order.

        Args:
            sample: what to say. Bodies that are no number become one where the dialect knows only numbers.
            sequence: number of this sample among its sensor's; used by dialects that carry one.
        """
        ...


def expect_tags(message: Message, *tags: str) -> None:
    """Refuse a message whose arguments are not of the types the dialect says."""
    if message.tags not in tags:
        raise BadDatagram(Reason.WRONG_ARGUMENTS)


def body_number(body: str, limit: int) -> int:
    """The body's number below `limit`; a name becomes a number that stays the same."""
    if body.isascii() and body.isdigit() and len(body) <= 20 and int(body) < limit:
        return int(body)
    return zlib.crc32(body.encode()) % limit


def code(known: Mapping[str, int], word: Argument, reason: Reason) -> int:
    """The number of a known word; any other is refused for the reason given."""
    number = known.get(word) if isinstance(word, str) else None
    if number is None:
        raise BadDatagram(reason)
    return number
