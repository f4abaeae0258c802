"""What a drive's process writes down, and what it says of a fault: when it was told, when the arm stood still."""

from __future__ import annotations

import time
from pathlib import Path
from typing import Final

import msgspec

from server.station.exo.driver import DriveMode, Joints

STILL_RAD_S: Final = 0.05
"""Three degrees a second: slower than this is standing, with the measurement's own noise."""

STILL_RAD: Final = 0.005
"""And this near to where it ends: a drive that is spoken to anew settles by less (a quarter of a degree)."""
LATELY_S: Final = 0.02


class Note(msgspec.Struct, frozen=True):
    """One line of the log; every time is the machine's monotonic clock, as the drive read it."""

    t_s: float
    command_s: float | None
    """When the newest command came."""
    is_command: bool
    """Whether this line was written because a command came."""
    mode: DriveMode | None
    reason: str
    angle_rad: Joints
    velocity_rad_s: Joints

    @property
    def speed_rad_s(self) -> float:
        """Of the fastest joint, measured."""
        return max(map(abs, self.velocity_rad_s))


_note_from = msgspec.json.Decoder(Note).decode


class DriveLog:
    """The lines so far, read again whenever somebody asks; a line that is still being written waits.

    Args:
        path: where the drive's process writes.
    """

    def __init__(self, path: Path) -> None:
        self._path = path
        self._read_bytes = 0
        self._notes: list[Note] = []

    def notes(self) -> list[Note]:
        """All of them, oldest first."""
        if not self._path.exists():
            return self._notes
        with self._path.open("rb") as file:
            file.seek(self._read_bytes)
            whole, _, _ = file.read().rpartition(b"\n")
        if whole:
            self._read_bytes += len(whole) + 1
            self._notes += self._noted(whole.split(b"\n"))
        return self._notes

    def _noted(self, lines: list[bytes]) -> list[Note]:
        return list(map(_note_from, lines))

    def since(self, t_s: float) -> list[Note]:
        """Those not older than `t_s`."""
        notes = self.notes()
        begin = len(notes)
        while begin and notes[begin - 1].t_s >= t_s:
            begin -= 1
        return notes[begin:]


def follows(log: DriveLog, faster_than_rad_s: float) -> bool:
    """Whether the arm follows now, and moves."""
    lately = log.since(time.monotonic() - LATELY_S)
    return bool(lately) and not lately[-1].reason and lately[-1].speed_rad_s > faster_than_rad_s


def commands(notes: list[Note]) -> list[Note]:
    """The lines that say that a command came."""
    return [note for note in notes if note.is_command]


def told_after_s(notes: list[Note], since_s: float, words: str = "") -> float | None:
    """From a moment to the first command that comes to rest or holds, for a reason with these words in it."""
    for note in commands(notes):
        if note.t_s >= since_s and note.reason and words in note.reason:
            return note.t_s - since_s
    return None


def still_after_s(notes: list[Note], since_s: float) -> float | None:
    """From a moment to the one after which the arm stands where it ends; None = it still moves at the end."""
    later = [note for note in notes if note.t_s >= since_s]
    if not later or later[-1].speed_rad_s > STILL_RAD_S:
        return None
    ends = later[-1].angle_rad
    moving = [note.t_s for note in later if note.speed_rad_s > STILL_RAD_S and _apart_rad(note, ends) > STILL_RAD]
    return max(moving, default=since_s) - since_s


def _apart_rad(note: Note, angle_rad: Joints) -> float:
    return max(abs(here - there) for here, there in zip(note.angle_rad, angle_rad, strict=True))
