"""A session's games as a file beside the recording: what they began with and every input, so that they can be played
again exactly.

The file is a row of entries: length and CRC-32 of what follows (little-endian, four bytes each), then MessagePack. The
first entry is what the games began with, every further one an input. Whatever is cut off, or spoilt, ends the file
there: what comes before is whole.
"""

from __future__ import annotations

import zlib
from collections.abc import Iterator
from dataclasses import dataclass
from pathlib import Path
from struct import Struct
from typing import Final, TypeVar

import msgspec

from fusion.errors import RecordingError
from games import replay
from games.game import GameInput, Point, Wish
from games.replay import GameRecord, Played
from server import __version__

SUFFIX: Final = ".game"
FORM: Final = 1
_HEAD = Struct("<II")
T = TypeVar("T")
LONGEST_ENTRY: Final = 1 << 16
"""Bytes; a length beyond that was never written by us."""


class Beginning(msgspec.Struct, frozen=True, kw_only=True):
    """The file's first entry."""

    form: int = FORM
    version: str = __version__
    record: GameRecord


class LoggedInput(msgspec.Struct, frozen=True, array_like=True, gc=False):
    """An input, and the time of the tick that it came from."""

    t_s: float
    dt_s: float
    hand: Point
    active: bool
    healthy_hand: Point | None
    trunk_lean_m: float
    shoulder_hitch_m: float
    wish: Wish
    level: float

    @classmethod
    def of(cls, given: GameInput, t_s: float) -> LoggedInput:
        """What is written of an input."""
        return cls(
            t_s,
            given.dt_s,
            given.hand,
            given.active,
            given.healthy_hand,
            given.trunk_lean_m,
            given.shoulder_hitch_m,
            given.wish,
            given.level,
        )

    @property
    def given(self) -> GameInput:
        """The input as the games took it."""
        return GameInput(
            dt_s=self.dt_s,
            hand=self.hand,
            active=self.active,
            healthy_hand=self.healthy_hand,
            trunk_lean_m=self.trunk_lean_m,
            shoulder_hitch_m=self.shoulder_hitch_m,
            wish=self.wish,
            level=self.level,
        )


_encoder = msgspec.msgpack.Encoder()
_beginnings = msgspec.msgpack.Decoder(Beginning)
_inputs = msgspec.msgpack.Decoder(LoggedInput)


def entry(content: Beginning | LoggedInput) -> bytes:
    """One entry as it stands in the file."""
    body = _encoder.encode(content)
    return _HEAD.pack(len(body), zlib.crc32(body)) + body


@dataclass(frozen=True, slots=True)
class GameLog:
    """A file of ours."""

    path: Path
    version: str
    """The program that wrote it."""
    record: GameRecord

    def inputs(self) -> Iterator[LoggedInput]:
        """Every whole input, in order.

        Raises:
            RecordingError: the file cannot be read.
        """
        bodies = _bodies(self.path)
        next(bodies, None)
        for body in bodies:
            yield _decoded(_inputs, body, self.path)


def read_game(path: Path) -> GameLog:
    """What the games began with, and their inputs.

    Raises:
        RecordingError: the file cannot be read, or is none of ours.
    """
    body = next(_bodies(path), None)
    if body is None:
        raise _not_ours(path)
    beginning = _decoded(_beginnings, body, path)
    if beginning.form != FORM:
        raise _not_ours(path)
    return GameLog(path, beginning.version, beginning.record)


def played(path: Path) -> Played:
    """What became of the games: how every exercise ended, and every attempt.

    Raises:
        RecordingError: the file cannot be read, or is none of ours.
        InputError: there is no game of such a name any more.
    """
    log = read_game(path)
    return replay.played(log.record, (logged.given for logged in log.inputs()))


def game_log_of(recording: Path) -> Path:
    """Where the games of a session are kept that is recorded there."""
    return recording.with_suffix(SUFFIX)


def _bodies(path: Path) -> Iterator[bytes]:
    try:
        with path.open("rb") as file:
            while len(head := file.read(_HEAD.size)) == _HEAD.size:
                length, checksum = _HEAD.unpack(head)
                body = file.read(min(length, LONGEST_ENTRY))
                if len(body) != length or zlib.crc32(body) != checksum:
                    return
                yield body
    except OSError as error:
        raise RecordingError(
            f"{path}: the games cannot be read ({error.strerror})",
            "a session's .game file",
            "name one that is there, and look at its permissions",
        ) from None


def _decoded(decoder: msgspec.msgpack.Decoder[T], body: bytes, path: Path) -> T:
    try:
        return decoder.decode(body)
    except msgspec.MsgspecError:
        raise _not_ours(path) from None


def _not_ours(path: Path) -> RecordingError:
    return RecordingError(
        f"{path} does not hold a session's games",
        f"a file written while games were played (form {FORM})",
        "name the .game file that lies beside a session's recording",
    )
