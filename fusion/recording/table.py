"""A CSV file, plain or gzipped, as columns; whatever is wrong in it is named with its line."""

from __future__ import annotations

import csv
import gzip
import io
import zlib
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import NoReturn

import numpy as np

from fusion.errors import RecordingError
from fusion.messages import Floats

_MEND = "mend the line, or fetch the recording again"


@dataclass(frozen=True, slots=True)
class Table:
    """The columns of a CSV file by name, all of the same length, and each row's line number."""

    path: Path
    columns: dict[str, tuple[str, ...]]
    lines: tuple[int, ...]

    def text(self, column: str) -> tuple[str, ...]:
        """A column as it stands."""
        return self.columns[column]

    def numbers(self, column: str) -> Floats:  # (rows,)
        """A column as numbers; an empty field is NaN. Raises RecordingError naming the line of any other text."""
        words = self.columns[column]
        try:
            return np.array(words, dtype=np.float64) if words else np.empty(0)
        except ValueError:
            return np.array([self._number(column, row, word) for row, word in enumerate(words)])

    def _number(self, column: str, row: int, word: str) -> float:
        try:
            return float(word) if word.strip() else float("nan")
        except ValueError:
            self.refuse(row, f"{column} is '{word[:40]}'", "a number")

    def codes(self, column: str, known: dict[str, int], expected: str) -> np.ndarray:  # (rows,) int
        """A column of names as their numbers. Raises RecordingError naming the line of an unknown one."""
        words = self.columns[column]
        try:
            return np.fromiter((known[word] for word in words), dtype=np.int64, count=len(words))
        except KeyError:
            row = next(i for i, word in enumerate(words) if word not in known)
            self.refuse(row, f"{column} '{words[row][:40]}' is unknown", expected)

    def require(self, good: np.ndarray, problem: Callable[[int], str], expected: str) -> None:
        """Refuse the first row that is not good."""
        if not good.all():
            row = int(np.argmin(good))
            self.refuse(row, problem(row), expected)

    def refuse(self, row: int, problem: str, expected: str) -> NoReturn:
        """Raise RecordingError for one row."""
        raise RecordingError(f"{self.path}, line {self.lines[row]}: {problem}", expected, _MEND)


def read_table(path: Path, wanted: Sequence[str], optional: Sequence[Sequence[str]] = ()) -> Table:
    """Read the wanted columns of a `.csv` or `.csv.gz`; others are left alone, the order is free.

    Args:
        path: the file.
        wanted: columns that must be there.
        optional: groups of columns; a group that is begun must be whole.

    Raises:
        RecordingError: the file is missing, unreadable, not CSV, lacks a column or has a row of another length.
    """
    header, rows, lines = _rows(path, _text(path))
    begun = [name for group in optional if set(group) & set(header) for name in group]
    wanted = [*wanted, *begun]
    _check_header(path, header, wanted)
    _check_widths(path, rows, lines, len(header))
    columns = tuple(zip(*rows, strict=True)) or ((),) * len(header)
    return Table(path, {name: columns[header.index(name)] for name in wanted}, lines)


def _rows(path: Path, text: str) -> tuple[list[str], list[list[str]], tuple[int, ...]]:
    # No quoting: a stray quotation mark must spoil its own line, not swallow the rest of the file.
    reader = csv.reader(io.StringIO(text), quoting=csv.QUOTE_NONE)
    try:
        header = next(reader, [])
        numbered = [(row, reader.line_num) for row in reader if row]
    except csv.Error as error:
        raise RecordingError(f"{path}, line {reader.line_num}: {error}", "comma-separated text", _MEND) from None
    return header, [row for row, _ in numbered], tuple(line for _, line in numbered)


def _text(path: Path) -> str:
    try:
        raw = path.read_bytes()
        return (gzip.decompress(raw) if path.suffix == ".gz" else raw).decode("utf-8-sig")
    except FileNotFoundError:
        remedy = "check the name in recording.json, or fetch the recording again"
        raise RecordingError(f"{path} is missing", "the file that recording.json names", remedy) from None
    except UnicodeDecodeError as error:
        raise RecordingError(f"{path}, byte {error.start}: not text", "UTF-8", "fetch the recording again") from None
    except (OSError, EOFError, zlib.error) as error:
        remedy = "fetch the recording again; it may have been cut off in copying"
        raise RecordingError(f"{path} cannot be read ({error})", "a whole, readable file", remedy) from None


def _check_header(path: Path, header: list[str], wanted: Sequence[str]) -> None:
    missing = [name for name in wanted if name not in header]
    if missing:
        raise RecordingError(
            f"{path}, line 1: the column {', '.join(missing)} is missing (found: {','.join(header)[:120]})",
            ",".join(wanted),
            "mend the first line",
        )


def _check_widths(path: Path, rows: list[list[str]], lines: tuple[int, ...], width: int) -> None:
    for row, line in zip(rows, lines, strict=True):
        if len(row) != width:
            raise RecordingError(f"{path}, line {line}: {len(row)} fields", f"{width}, as in the first line", _MEND)
