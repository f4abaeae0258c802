"""Loops over the bytes of comma-separated text, compiled: where fields are, what they hold, which are equal.

A recording of a minute is some megabytes of text; going through it word by word in Python took longer than aligning and
fusing it. Whatever is unusual here (an exponent, more digits than a double holds exactly) is left to Python's `float`.
"""

from __future__ import annotations

from typing import Final

import numpy as np
from numpy.typing import NDArray

from fusion.compiled import kernel
from fusion.messages import Floats

Bytes = NDArray[np.uint8]
Places = NDArray[np.int64]

_NEWLINE, _RETURN, _COMMA, _PLUS, _MINUS, _POINT, _ZERO, _NINE = (ord(letter) for letter in "\n\r,+-.09")
_EXACT_DIGITS: Final = 15
"""Integers of so many digits, and powers of ten up to 10^22, are exact doubles, so their quotient is rounded once, as
`float` rounds (Clinger 1990, "How to read floating point numbers accurately")."""
_POWERS: Final = 10.0 ** np.arange(_EXACT_DIGITS + 1)
_FNV_START, _FNV_PRIME = np.uint64(14695981039346656037), np.uint64(1099511628211)


@kernel
def split(text: Bytes, at: int, line: int, columns: int) -> tuple[Places, Places, int]:
    """Find the fields of every line that is not empty, up to the first one of another width.

    Args:
        text: the bytes of the file.
        at: where to begin.
        line: the number of the line that begins there.
        columns: how many fields each line must have.

    Returns:
        `bounds` (rows, columns + 1): field k of row r is ``text[bounds[r, k] : bounds[r, k + 1] - 1]``; the rows' line
        numbers (rows,); and the number of fields in the last row, which is `columns` unless that row is wrong.
    """
    most = 1 + np.count_nonzero(text[at:] == _NEWLINE)
    bounds = np.empty((most, columns + 1), np.int64)
    lines = np.empty(most, np.int64)
    rows, found = 0, columns
    while at < len(text) and found == columns:
        begun = at
        fields, at = _split_line(text, at, bounds[rows])
        if fields > 1 or bounds[rows, 1] > begun + 1:
            lines[rows] = line
            rows, found = rows + 1, fields
        line += 1
    return bounds[:rows], lines[:rows], found


@kernel
def _split_line(text: Bytes, at: int, bounds: Places) -> tuple[int, int]:
    """Note where a line's fields begin, as far as there is room; how many there are, and where the next line begins."""
    bounds[0] = at
    fields = 1
    while at < len(text) and text[at] != _NEWLINE:
        if text[at] == _COMMA:
            if fields < len(bounds):
                bounds[fields] = at + 1
            fields += 1
        at += 1
    end = at - 1 if at > bounds[0] and text[at - 1] == _RETURN else at
    if fields < len(bounds):
        bounds[fields] = end + 1
    return fields, at + 1


@kernel
def decimals(text: Bytes, starts: Places, ends: Places) -> tuple[Floats, NDArray[np.bool_]]:
    """The numbers that fields hold, NaN for an empty one, and which were read: plain decimals that fit a double."""
    values = np.full(len(starts), np.nan)
    read = np.zeros(len(starts), np.bool_)
    for row in range(len(starts)):
        at, end = starts[row], ends[row]
        negative = at < end and text[at] == _MINUS
        if negative or (at < end and text[at] == _PLUS):
            at += 1
        magnitude, read[row] = _magnitude(text, at, end)
        values[row] = -magnitude if negative else magnitude
        read[row] |= starts[row] == end
    return values, read


@kernel
def _magnitude(text: Bytes, at: int, end: int) -> tuple[float, bool]:
    """An unsigned decimal; NaN and False where this is none, or has too many digits."""
    number, digits, places, seen_point = 0, 0, 0, False
    while at < end and digits <= _EXACT_DIGITS:
        if _ZERO <= text[at] <= _NINE:
            number = number * 10 + int(np.int64(text[at]) - _ZERO)
            digits += 1
            places += seen_point
        elif text[at] == _POINT and not seen_point:
            seen_point = True
        else:
            return np.nan, False
        at += 1
    if digits == 0 or digits > _EXACT_DIGITS:
        return np.nan, False
    return number / _POWERS[places], True


@kernel
def first_alike(text: Bytes, starts: Places, ends: Places) -> Places:
    """For each field the first row whose field has the same bytes (an open hash table, FNV-1a)."""
    rows = len(starts)
    size = 64
    while size < 2 * rows:
        size *= 2
    slots = np.full(size, -1, np.int64)
    first = np.empty(rows, np.int64)
    for row in range(rows):
        start, length = starts[row], ends[row] - starts[row]
        mixed = _FNV_START
        for k in range(length):
            mixed = (mixed ^ np.uint64(text[start + k])) * _FNV_PRIME
        slot = np.int64(mixed & np.uint64(size - 1))
        while slots[slot] >= 0 and not _alike(text, start, length, starts[slots[slot]], ends[slots[slot]]):
            slot = (slot + 1) & (size - 1)
        if slots[slot] < 0:
            slots[slot] = row
        first[row] = slots[slot]
    return first


@kernel
def _alike(text: Bytes, start: int, length: int, other_start: int, other_end: int) -> bool:
    alike, k = length == other_end - other_start, 0
    while alike and k < length:
        alike = text[start + k] == text[other_start + k]
        k += 1
    return alike
