"""OSC 1.0 from datagram bytes and back, strict: whatever is not whole and well-formed is refused, never guessed at.

Why not python-osc: it completes a truncated float with zero bytes (a joint in the wrong place), loops for ever on a
negative element size, lets a few exceptions of others through and is several times slower (docs/formats.md). The tests
hold this file against it in both directions.
"""

from __future__ import annotations

import struct
from enum import StrEnum
from functools import lru_cache
from typing import Final, NamedTuple

MAX_BYTES: Final = 16_384
"""Longest datagram that is looked at; six bodies in one bundle need about 10 kB."""
MAX_DEPTH: Final = 8
"""Deepest nesting of bundles."""
_BUNDLE: Final = b"#bundle\0"
_IMMEDIATELY: Final = 1
_NUMBERS: Final = {"i": "i", "f": "f", "d": "d", "h": "q", "t": "Q"}
_INT: Final = struct.Struct(">i")

Argument = int | float | str | bytes


class Reason(StrEnum):
    """Why a datagram or a message in it was refused."""

    OVERSIZED = "longer than 16 kB"
    TRUNCATED = "truncated"
    NOT_OSC = "not OSC"
    TRAILING = "bytes left over"
    BAD_TEXT = "text that is not UTF-8"
    UNKNOWN_TAG = "unknown type tag"
    TOO_DEEP = "bundles nested too deep"
    WRONG_ARGUMENTS = "arguments of the wrong types"
    NOT_FINITE = "NaN or infinite"
    TOO_FAR = "a position beyond 50 m; is the unit right?"
    UNKNOWN_JOINT = "unknown joint"
    UNKNOWN_STATE = "unknown tracking state"
    UNKNOWN_BODY = "a body number that cannot be"
    BAD_NAME = "a name that is empty, too long or not printable"
    UNKNOWN_SKELETON = "unknown skeleton"
    UNKNOWN_ADDRESS = "unknown address"
    REPEATED = "repeated or overtaken datagram"
    TOO_MANY_BODIES = "too many bodies at once"
    TOO_MANY_SENDERS = "too many senders at once"


class BadDatagram(Exception):  # noqa: N818  a refusal that is counted, no fault of ours
    """A datagram or message that is not used; `reason` says why. Counted, never shown as an error."""

    def __init__(self, reason: Reason) -> None:
        self.reason = reason
        super().__init__(reason.value)


class Message(NamedTuple):
    """One OSC message."""

    address: str
    tags: str
    """Type tags without the comma."""
    arguments: tuple[Argument, ...]


def read(payload: bytes) -> tuple[Message, ...]:
    """All messages of a datagram, nested bundles opened in their order; time tags are ignored.

    Raises:
        BadDatagram: any part is malformed. Nothing else is ever raised.
    """
    if len(payload) > MAX_BYTES:
        raise BadDatagram(Reason.OVERSIZED)
    if is_bundle(payload):
        messages: list[Message] = []
        _read_bundle(payload, messages, 1)
        return tuple(messages)
    return (_read_message(payload),)


def is_bundle(payload: bytes) -> bool:
    """Whether a datagram is a bundle."""
    return payload.startswith(_BUNDLE)


def _read_bundle(payload: bytes, messages: list[Message], depth: int) -> None:
    if depth > MAX_DEPTH:
        raise BadDatagram(Reason.TOO_DEEP)
    if len(payload) < 16:
        raise BadDatagram(Reason.TRUNCATED)
    at = 16  # after "#bundle" and the time tag
    while at < len(payload):
        start, at = _element(payload, at)
        element = payload[start:at]
        if is_bundle(element):
            _read_bundle(element, messages, depth + 1)
        else:
            messages.append(_read_message(element))


def _element(payload: bytes, at: int) -> tuple[int, int]:
    """Start and end of the bundle element whose size stands at `at`."""
    start = at + 4
    if start > len(payload):
        raise BadDatagram(Reason.TRUNCATED)
    (size,) = _INT.unpack_from(payload, at)
    if size <= 0 or start + size > len(payload):
        raise BadDatagram(Reason.TRUNCATED)
    return start, start + size


def _read_message(payload: bytes) -> Message:
    if not payload.startswith(b"/"):
        raise BadDatagram(Reason.NOT_OSC)
    address, at = _text(payload, 0)
    tags, at = _text(payload, at)
    if not tags.startswith(","):
        raise BadDatagram(Reason.NOT_OSC)
    tags = tags[1:]
    arguments: list[Argument] = []
    for part in _plan(tags):
        values, at = _run(part, payload, at)
        arguments += values
    if at != len(payload):
        raise BadDatagram(Reason.TRAILING)
    return Message(address, tags, tuple(arguments))


@lru_cache(maxsize=64)
def _plan(tags: str) -> tuple[str | struct.Struct, ...]:
    """The tags as runs of numbers, each unpacked at once, and single "s" or "b" between them."""
    runs: list[str] = []
    for tag in tags:
        if tag in "sb":
            runs.append(tag)
        elif tag not in _NUMBERS:
            raise BadDatagram(Reason.UNKNOWN_TAG)
        elif runs and runs[-1].startswith(">"):
            runs[-1] += _NUMBERS[tag]
        else:
            runs.append(">" + _NUMBERS[tag])
    return tuple(struct.Struct(run) if run.startswith(">") else run for run in runs)


def _run(part: str | struct.Struct, payload: bytes, at: int) -> tuple[tuple[Argument, ...], int]:
    if isinstance(part, struct.Struct):
        end = at + part.size
        if end > len(payload):
            raise BadDatagram(Reason.TRUNCATED)
        return part.unpack_from(payload, at), end
    value, end = _text(payload, at) if part == "s" else _blob(payload, at)
    return (value,), end


def _text(payload: bytes, at: int) -> tuple[str, int]:
    end = payload.find(b"\0", at)
    after = (end | 3) + 1  # padded with zeros to a multiple of four
    if end < 0 or after > len(payload):
        raise BadDatagram(Reason.TRUNCATED)
    try:
        return payload[at:end].decode(), after
    except UnicodeDecodeError:
        raise BadDatagram(Reason.BAD_TEXT) from None


def _blob(payload: bytes, at: int) -> tuple[bytes, int]:
    start = at + 4
    if start > len(payload):
        raise BadDatagram(Reason.TRUNCATED)
    (size,) = _INT.unpack_from(payload, at)
    after = start + (size + 3) // 4 * 4
    if size < 0 or after > len(payload):
        raise BadDatagram(Reason.TRUNCATED)
    return payload[start : start + size], after


# ---------------------------------------------------------------- writing


def write(address: str, tags: str, *arguments: Argument) -> bytes:
    """One message as bytes; `tags` without the comma, one per argument."""
    out = [_padded(address.encode()), _padded(b"," + tags.encode())]
    for tag, value in zip(tags, arguments, strict=True):
        if isinstance(value, str):
            out.append(_padded(value.encode()))
        elif isinstance(value, bytes):
            out.append(_INT.pack(len(value)) + value + b"\0" * (-len(value) % 4))
        else:
            out.append(struct.pack(">" + _NUMBERS[tag], value))
    return b"".join(out)


def write_bundle(elements: list[bytes]) -> bytes:
    """Messages or bundles as one bundle, to be taken at once."""
    head = _BUNDLE + struct.pack(">Q", _IMMEDIATELY)
    return head + b"".join(_INT.pack(len(element)) + element for element in elements)


def _padded(text: bytes) -> bytes:
    return text + b"\0" * (4 - len(text) % 4)
