"""Leaning and hitching are said when they last, and taken back when they are over."""

from __future__ import annotations

import pytest

from games.posture import GOES_BELOW, HITCH_M, LASTS_S, LEAN_M, SETTLES_S, UPRIGHT, Posture

DT_S = 0.1


def after(posture: Posture, seconds: float, lean_m: float = 0.0, hitch_m: float = 0.0) -> Posture:
    for _ in range(round(seconds / DT_S)):
        posture = posture.after(lean_m, hitch_m, DT_S)
    return posture


@pytest.mark.parametrize(("lean_m", "hitch_m", "said"), [(LEAN_M + 0.01, 0.0, "lean"), (0.0, HITCH_M + 0.01, "hitch")])
def test_it_is_said_when_it_lasts(lean_m: float, hitch_m: float, said: str) -> None:
    assert after(UPRIGHT, LASTS_S - 0.3, lean_m, hitch_m).said == ""
    assert after(UPRIGHT, LASTS_S + 0.3, lean_m, hitch_m).said == said


def test_it_does_not_flicker_at_the_threshold() -> None:
    leaning = after(UPRIGHT, LASTS_S + 0.3, LEAN_M + 0.01)
    assert after(leaning, 5.0, LEAN_M * (GOES_BELOW + 0.05)).said == "lean"
    assert after(leaning, LASTS_S + 0.3, LEAN_M * (GOES_BELOW - 0.05)).said == ""


def test_what_is_not_known_counts_as_upright() -> None:
    assert after(UPRIGHT, 5.0, float("nan"), float("nan")).said == ""


def test_who_has_sat_down_differently_is_measured_from_there_and_back_again() -> None:
    shifted_m = LEAN_M + 0.02
    settled = after(UPRIGHT, LASTS_S + SETTLES_S + 1.0, shifted_m)
    assert settled.said == ""
    assert after(settled, 5.0, shifted_m + 0.9 * LEAN_M).said == ""
    assert after(settled, 5.0, shifted_m + 1.1 * LEAN_M).said == "lean"
    back = after(settled, 5.0, 0.0)
    assert after(back, 5.0, LEAN_M + 0.01).said == "lean"
