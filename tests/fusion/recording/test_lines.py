"""Lines of decimals against Python's own formatting."""

from decimal import Decimal

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from fusion.recording.lines import LARGEST, lines_of

names = st.text(st.characters(min_codepoint=32, max_codepoint=126, exclude_characters=","), max_size=8)


@given(
    st.lists(st.tuples(st.floats(-1e6, 1e6), st.floats(-LARGEST, LARGEST), names)),
    st.tuples(st.integers(0, 6), st.integers(0, 6)),
)
def test_each_number_is_the_nearest_decimal(rows, places):
    numbers = np.array([row[:2] for row in rows]).reshape(-1, 2)
    written = lines_of(numbers, places, [row[2] for row in rows], np.arange(len(rows)))
    lines = written.decode().splitlines()
    assert len(lines) == len(rows)
    for line, (a, b, name) in zip(lines, rows, strict=True):
        first, middle, last = line.split(",")
        assert middle == name
        for word, number, decimals in ((first, a, places[0]), (last, b, places[1])):
            assert len(word.partition(".")[2]) == decimals
            off = abs(Decimal(word) - Decimal(number))
            assert off <= Decimal("0.5000001") * Decimal(10) ** -decimals


@pytest.mark.parametrize("number", [0.0, 1.0, -0.00001, 9.99996, 123.45678, -2.5, 1e-12, np.nan, np.inf, -np.inf])
def test_a_number_looks_as_python_writes_it(number):
    assert lines_of(np.array([[number]]), [4], ["Head"], np.zeros(1, np.int64)) == f"{number:.4f},Head\n".encode()


def test_no_rows_are_no_text():
    assert lines_of(np.empty((0, 3)), [1, 1, 1], [], np.empty(0, np.int64)) == b""
