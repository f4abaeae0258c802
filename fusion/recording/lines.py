"""Rows of numbers as comma-separated text, compiled: word by word a minute of joints took a tenth of a second.

The numbers are what `f"{number:.4f}"` gives, but for ties: there the last place may differ.
"""

from __future__ import annotations

from collections.abc import Sequence
from typing import Final

import numpy as np
from numpy.typing import NDArray

from fusion.compiled import kernel
from fusion.messages import Floats

Bytes = NDArray[np.uint8]
Integers = NDArray[np.int64]

LARGEST: Final = 1e15
"""What is larger is written as infinite: no time, place or angle is."""
_LONGEST = len("-1000000000000000.,")
_COMMA, _NEWLINE, _MINUS, _POINT, _ZERO = (ord(letter) for letter in ",\n-.0")
_NAN, _INF = np.frombuffer(b"nan", np.uint8), np.frombuffer(b"inf", np.uint8)


def lines_of(numbers: Floats, places: Sequence[int], names: Sequence[str], name: Integers) -> bytes:
    """A line per row: its first number, its name, and its other numbers.

    Args:
        numbers: (N, K), K ≥ 1.
        places: how many decimal places each column has.
        names: ASCII, without commas.
        name: (N,) which of the names each row has.
    """
    width = max(1, *map(len, names), 1)
    letters = np.array([text.encode() for text in names], f"S{width}").view(np.uint8).reshape(-1, width)
    lengths = np.array([len(text) for text in names], np.int64)
    return _lines(np.ascontiguousarray(numbers), np.array(places), letters, lengths, name).tobytes()


@kernel
def _lines(numbers: Floats, places: Integers, letters: Bytes, lengths: Integers, name: Integers) -> Bytes:
    rows, columns = numbers.shape
    text = np.empty(rows * (columns * _LONGEST + places.sum() + letters.shape[1] + 1), np.uint8)
    at = 0
    for n in range(rows):
        at = _put_decimal(text, at, numbers[n, 0], places[0])
        text[at] = _COMMA
        at = _put(text, at + 1, letters[name[n], : lengths[name[n]]])
        for k in range(1, columns):
            text[at] = _COMMA
            at = _put_decimal(text, at + 1, numbers[n, k], places[k])
        text[at] = _NEWLINE
        at += 1
    return text[:at]


@kernel
def _put_decimal(text: Bytes, at: int, number: float, places: int) -> int:
    """Write a number; where the next letter goes."""
    if np.isnan(number):
        return _put(text, at, _NAN)
    if number < 0:
        text[at] = _MINUS
        at += 1
    magnitude = abs(number)
    if magnitude > LARGEST:
        return _put(text, at, _INF)
    whole, one = int(magnitude), 10**places
    part = int(np.rint((magnitude - whole) * one))
    if part == one:
        whole, part = whole + 1, 0
    at = _put_integer(text, at, whole, 1)
    if places == 0:
        return at
    text[at] = _POINT
    return _put_integer(text, at + 1, part, places)


@kernel
def _put_integer(text: Bytes, at: int, number: int, least: int) -> int:
    """Write an integer with leading zeros to at least so many digits."""
    digits, rest = 1, number // 10
    while rest > 0:
        digits, rest = digits + 1, rest // 10
    digits = max(digits, least)
    for place in range(at + digits - 1, at - 1, -1):
        text[place] = _ZERO + number % 10
        number //= 10
    return at + digits


@kernel
def _put(text: Bytes, at: int, letters: Bytes) -> int:
    for k in range(len(letters)):
        text[at + k] = letters[k]
    return at + len(letters)
