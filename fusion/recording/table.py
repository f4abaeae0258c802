"""A CSV file, plain or gzipped, as columns; whatever is wrong in it is named with its line."""

from __future__ import annotations

import gzip
import zlib
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import NoReturn

import numpy as np

from fusion.errors import RecordingError
from fusion.messages import Floats
from fusion.recording.fields import Bytes, Places, decimals, first_alike, split

_MEND = "mend the line, or fetch the recording again"


@dataclass(frozen=True, slots=True)
class Table:
    """The wanted columns of a CSV file, all of the same length, and each row's line number."""

    path: Path
    _text: Bytes
    _bounds: dict[str, tuple[Places, Places]]
    """By column: where each row's field starts and ends, (rows,) each."""
    _lines: Places  # (rows,)

    @property
    def columns(self) -> tuple[str, ...]:
        """The names of the columns."""
        return tuple(self._bounds)

    def field(self, column: str, row: int) -> str:
        """One field as it stands."""
        starts, ends = self._bounds[column]
        return self._text[starts[row] : ends[row]].tobytes().decode()

    def numbers(self, column: str) -> Floats:  # (rows,)
        """A column as numbers; an empty field is NaN. Raises RecordingError naming the line of any other text."""
        values, read = decimals(self._text, *self._bounds[column])
        for row in np.nonzero(~read)[0].tolist():
            values[row] = self._number(column, row, self.field(column, row))
        return values

    def _number(self, column: str, row: int, word: str) -> float:
        try:
            return float(word) if word.strip() else float("nan")
        except ValueError:
            self.refuse(row, f"{column} is '{word[:40]}'", "a number")

    def names(self, column: str) -> tuple[tuple[str, ...], np.ndarray]:
        """The different texts of a column in alphabetical order, and which of them each row has, (rows,) int."""
        first = first_alike(self._text, *self._bounds[column])
        by_name = {self.field(column, row): row for row in np.flatnonzero(np.bincount(first)).tolist()}
        names = sorted(by_name)
        number = np.zeros(len(first), dtype=np.int64)
        number[[by_name[name] for name in names]] = np.arange(len(names))
        return tuple(names), number[first]

    def codes(self, column: str, known: dict[str, int], expected: str) -> np.ndarray:  # (rows,) int
        """A column of names as their numbers. Raises RecordingError naming the line of an unknown one."""
        names, which = self.names(column)
        code: np.ndarray = np.array([known.get(name, -1) for name in names], dtype=np.int64)[which]
        self.require(code >= 0, lambda row: f"{column} '{self.field(column, row)[:40]}' is unknown", expected)
        return code

    def require(self, good: np.ndarray, problem: Callable[[int], str], expected: str) -> None:
        """Refuse the first row that is not good."""
        if not good.all():
            row = int(np.argmin(good))
            self.refuse(row, problem(row), expected)

    def refuse(self, row: int, problem: str, expected: str) -> NoReturn:
        """Raise RecordingError for one row."""
        raise RecordingError(f"{self.path}, line {self._lines[row]}: {problem}", expected, _MEND)


def read_table(path: Path, wanted: Sequence[str], optional: Sequence[Sequence[str]] = ()) -> Table:
    """Read the wanted columns of a `.csv` or `.csv.gz`; others are left alone, the order is free.

    There is no quoting: a stray quotation mark must spoil its own line, not swallow the rest of the file.

    Args:
        path: the file.
        wanted: columns that must be there.
        optional: groups of columns; a group that is begun must be whole.

    Raises:
        RecordingError: the file is missing, unreadable, not text, lacks a column or has a row of another length.
    """
    text = _text(path)
    first, _, _ = text.partition(b"\n")
    header = first.decode().rstrip("\r").split(",")
    begun = [name for group in optional if set(group) & set(header) for name in group]
    wanted = [*wanted, *begun]
    _check_header(path, header, wanted)
    letters = np.frombuffer(text, dtype=np.uint8)
    bounds, lines, width = split(letters, len(first) + 1, 2, len(header))
    if width != len(header):
        problem = f"{path}, line {lines[-1]}: {width} fields"
        raise RecordingError(problem, f"{len(header)}, as in the first line", _MEND)
    places = {name: header.index(name) for name in wanted}
    return Table(path, letters, {name: (bounds[:, k], bounds[:, k + 1] - 1) for name, k in places.items()}, lines)


def _text(path: Path) -> bytes:
    """The file's bytes, unpacked, without the mark that some programs put before UTF-8."""
    try:
        raw = path.read_bytes()
        text = (gzip.decompress(raw) if path.suffix == ".gz" else raw).removeprefix(b"\xef\xbb\xbf")
        text.decode()
    except FileNotFoundError:
        remedy = "check the name in recording.json, or fetch the recording again"
        raise RecordingError(f"{path} is missing", "the file that recording.json names", remedy) from None
    except UnicodeDecodeError as error:
        raise RecordingError(f"{path}, byte {error.start}: not text", "UTF-8", "fetch the recording again") from None
    except (OSError, EOFError, zlib.error) as error:
        remedy = "fetch the recording again; it may have been cut off in copying"
        raise RecordingError(f"{path} cannot be read ({error})", "a whole, readable file", remedy) from None
    return text


def _check_header(path: Path, header: list[str], wanted: Sequence[str]) -> None:
    missing = [name for name in wanted if name not in header]
    if missing:
        raise RecordingError(
            f"{path}, line 1: the column {', '.join(missing)} is missing (found: {','.join(header)[:120]})",
            ",".join(wanted),
            "mend the first line",
        )
