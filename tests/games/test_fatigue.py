"""A rest is suggested from two signs of fatigue, never from one, and never early."""

from __future__ import annotations

import pytest

from games.fatigue import COMPARED, Movement, is_tired

FRESH = Movement(0.4, 1.1, 0.3)


@pytest.mark.parametrize(
    ("later", "tired"),
    [
        (FRESH, False),
        (Movement(0.2, 1.1, 0.3), False),
        (Movement(0.4, 1.8, 0.3), False),
        (Movement(0.4, 1.1, 0.15), False),
        (Movement(0.2, 1.8, 0.3), True),
        (Movement(0.2, 1.1, 0.15), True),
        (Movement(0.4, 1.8, 0.15), True),
    ],
)
def test_two_signs_make_tired(later: Movement, tired: bool) -> None:
    assert is_tired([FRESH] * COMPARED + [later] * COMPARED) is tired


def test_two_odd_movements_are_forgiven_and_a_beginning_says_nothing() -> None:
    odd = Movement(0.05, 3.0, 0.1)
    assert not is_tired([FRESH] * (2 * COMPARED - 2) + [odd] * 2)
    assert not is_tired([FRESH] * COMPARED + [odd] * (COMPARED - 1))
