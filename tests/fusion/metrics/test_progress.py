"""A verdict is given only on a change that is more than chance, of a figure that can carry one."""

from __future__ import annotations

import pytest
from hypothesis import given
from hypothesis import strategies as st

from fusion.metrics.catalogue import MEASURES
from fusion.metrics.measure import Better, Measure, PublishedChange, Trust
from fusion.metrics.metric import PASSIVE_DRIVE
from fusion.metrics.progress import SessionValue, Verdict, change_of

MORE = Measure("own_range", "rad", "", "", Trust.GOOD, "", Better.MORE)
LESS = Measure("reaction_time", "s", "", "", Trust.FAIR, "", Better.LESS)
NEITHER = Measure("movement_time", "s", "", "", Trust.GOOD, "")
POOR = Measure("accuracy", "m", "", "", Trust.POOR, "", Better.LESS)


def sessions(*values: float, sem: float | None = 0.1) -> list[SessionValue]:
    return [SessionValue(value, sem) for value in values]


@pytest.mark.parametrize(
    ("measure", "verdict"), [(MORE, Verdict.BETTER), (LESS, Verdict.WORSE), (NEITHER, Verdict.CHANGED)]
)
def test_more_than_chance_is_judged_by_what_the_measure_means(measure: Measure, verdict: Verdict) -> None:
    found = change_of(measure, sessions(1.0, 1.1, 1.9))
    assert found.mdc == pytest.approx(0.277, abs=0.001)
    assert found.difference == pytest.approx(0.9)
    assert found.verdict is verdict
    assert change_of(measure, sessions(1.0, 1.2)).verdict is Verdict.UNCHANGED


def test_what_cannot_be_known_is_not_judged() -> None:
    assert change_of(MORE, []).verdict is Verdict.UNKNOWN
    assert change_of(MORE, sessions(1.0)).verdict is Verdict.UNKNOWN
    assert change_of(MORE, sessions(1.0, 9.0, sem=None)).verdict is Verdict.UNKNOWN
    assert change_of(POOR, sessions(1.0, 9.0)).verdict is Verdict.UNKNOWN
    driven = [SessionValue(1.0, 0.1, PASSIVE_DRIVE), SessionValue(9.0, 0.1)]
    assert change_of(MORE, driven).verdict is Verdict.UNKNOWN


def test_a_published_change_goes_before_our_own() -> None:
    published = Measure("a", "1", "", "", Trust.GOOD, "", Better.MORE, mdc=PublishedChange(5.0, "somebody, 2020"))
    assert change_of(published, sessions(1.0, 5.0)).verdict is Verdict.UNCHANGED
    assert change_of(published, sessions(1.0, 7.0, sem=None)).verdict is Verdict.BETTER


@given(values=st.lists(st.floats(-10, 10), min_size=2, max_size=8), sem=st.floats(0.01, 5.0))
def test_nothing_better_forwards_is_better_backwards(values: list[float], sem: float) -> None:
    there, back = (change_of(MORE, sessions(*order, sem=sem)).verdict for order in (values, values[::-1]))
    turned = {Verdict.BETTER: Verdict.WORSE, Verdict.WORSE: Verdict.BETTER}
    assert back is turned.get(there, there)


def test_the_catalogues_own_measures_can_all_be_judged() -> None:
    for measure in MEASURES.values():
        assert change_of(measure, sessions(1.0, 2.0)).difference == 1.0
