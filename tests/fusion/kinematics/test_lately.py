"""The running median is the median of what is remembered."""

from __future__ import annotations

from statistics import median

from hypothesis import given
from hypothesis import strategies as st

from fusion.kinematics.lately import Lately


@given(numbers=st.lists(st.floats(-10, 10), min_size=1, max_size=40), memory=st.integers(1, 12))
def test_it_is_the_median_of_the_latest(numbers: list[float], memory: int) -> None:
    lately = Lately(memory)
    for k, number in enumerate(numbers):
        lately.take(number)
        remembered = numbers[max(k + 1 - memory, 0) : k + 1]
        assert lately.count == len(remembered)
        assert lately.median == median(remembered)


def test_of_nothing_it_is_infinite() -> None:
    assert Lately(3).median == float("inf")
