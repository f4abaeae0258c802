"""Trust follows from how far measured figures lie from true ones."""

from __future__ import annotations

from math import radians

import pytest

from fusion.experiments.measures.agreement import Agreement, agreements, due_trust, found_trust
from fusion.metrics.measure import Trust
from fusion.metrics.metric import Metric


def told(bias: float, limit: float, name: str = "movement_time", unit: str = "s", joint: str = "") -> Agreement:
    return Agreement(name, joint, unit, 7, 1.0, bias, limit)


def test_bias_and_limits_are_those_of_the_differences() -> None:
    true = [Metric("sparc", -1.0 - k, "1") for k in range(6)]
    measured = [Metric("sparc", one.value + 0.1 * (-1) ** k, "1") for k, one in enumerate(true)]
    (found,) = agreements([((a,), (b,)) for a, b in zip(measured, true, strict=True)])
    assert (found.sessions, found.typical) == (6, 3.5)
    assert found.bias == pytest.approx(0.0)
    assert found.limit == pytest.approx(1.96 * 0.1 * (6 / 5) ** 0.5)


def test_a_figure_that_few_sessions_have_is_not_told_of() -> None:
    assert agreements([((Metric("lag", 0.1, "s"),), (Metric("lag", 0.1, "s"),))] * 4) == ()


@pytest.mark.parametrize(
    ("agreement", "trust"),
    [
        (told(-0.05, 0.04), Trust.GOOD),
        (told(0.05, 0.06), Trust.FAIR),
        (told(0.2, 0.06), Trust.POOR),
        (told(0.0, radians(9.0), unit="rad"), Trust.GOOD),
        (told(radians(9.0), radians(9.0), unit="rad"), Trust.FAIR),
        (told(0.01, 0.03, unit="m"), Trust.FAIR),
        (told(0.03, 0.03, unit="m"), Trust.POOR),
    ],
)
def test_the_rule_is_a_tenth_and_a_quarter_or_what_the_unit_allows(agreement: Agreement, trust: Trust) -> None:
    assert found_trust("movement_time", [agreement]) is trust


def test_of_several_joints_the_middle_one_counts() -> None:
    joints = [told(0.0, radians(size), "range_of_movement", "rad", str(size)) for size in (5.0, 15.0, 40.0)]
    assert found_trust("range_of_movement", joints) is Trust.FAIR


def test_what_is_known_to_be_unreliable_is_never_trusted_for_a_good_result_of_ours() -> None:
    assert due_trust("peak_speed", [told(0.0, 0.01, "peak_speed", "m/s")]) is Trust.POOR
    assert due_trust("mean_speed", [told(0.0, 0.01, "mean_speed", "m/s")]) is Trust.GOOD
    assert due_trust("sparc", []) is None
