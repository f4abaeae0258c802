"""The compiled reading of CSV against Python's own `float` and `csv`."""

import csv
import io
from pathlib import Path

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from fusion.errors import RecordingError
from fusion.recording.table import read_table

numbers = st.one_of(
    st.floats(allow_nan=False).map(repr),
    st.floats(-1e4, 1e4).map(lambda number: f"{number:.4f}"),
    st.from_regex(r"[+-]?[0-9]{0,18}\.?[0-9]{1,9}", fullmatch=True),
    st.sampled_from(["", " ", "-0", "-0.0", ".5", "5.", "1e-3", " 2.5 ", "nan", "-inf", "1_0", "123456789012345"]),
)
fields = st.text(st.characters(codec="utf-8", exclude_characters=",\n\r"), max_size=6)


@pytest.fixture(scope="module")
def read(tmp_path_factory):
    path = tmp_path_factory.mktemp("tables") / "table.csv"

    def make(text, wanted=("a", "b")):
        path.write_bytes(text.encode())
        return read_table(path, wanted)

    return make


@given(words=st.lists(numbers))
def test_numbers_are_what_float_makes_of_them(read, words):
    found = read("a,b\n" + "".join(f"{word},x\n" for word in words)).numbers("a")
    expected = np.array([float(word) if word.strip() else np.nan for word in words])
    np.testing.assert_array_equal(found, expected)
    np.testing.assert_array_equal(np.signbit(found), np.signbit(expected))


@given(rows=st.lists(st.tuples(fields, fields)), end=st.sampled_from(["\n", "\r\n"]), last=st.booleans())
def test_fields_are_what_csv_makes_of_them(read, rows, end, last):
    text = "a,b" + end + end.join(["", *map(",".join, rows)]) + (end if last else "")
    expected = [row for row in list(csv.reader(io.StringIO(text, newline=""), quoting=csv.QUOTE_NONE))[1:] if row]
    table = read(text)
    assert [[table.field("a", k), table.field("b", k)] for k in range(len(expected))] == expected
    names, which = table.names("b")
    assert [names[k] for k in which] == [b for _, b in expected]
    assert list(names) == sorted(set(names))


@pytest.mark.parametrize(
    ("text", "says"),
    [
        ("a,b\n1,2\n\n\n3\n", "line 5: 1 fields"),
        ("a,b\n1,2,3,4\n", "line 2: 4 fields"),
        ("a,b\r\n1,2\r\n,,\r\n", "line 3: 3 fields"),
        ("a,b\n1,2\n  \n", "line 3: 1 fields"),
        ("", "line 1: the column a, b is missing"),
    ],
)
def test_a_line_of_another_width_is_named(read, text, says):
    with pytest.raises(RecordingError, match=says):
        read(text)


def test_a_mark_before_utf_8_is_no_part_of_the_first_name(read):
    np.testing.assert_array_equal(read("\ufeffa,b\n1,2\n").numbers("a"), [1.0])


def test_what_is_no_text_is_named_with_its_place(tmp_path: Path):
    (tmp_path / "table.csv").write_bytes(b"a,b\n1,\xff\n")
    with pytest.raises(RecordingError, match="byte 6: not text"):
        read_table(tmp_path / "table.csv", ("a", "b"))
