"""The lag study in a small size, and the measures and filters that it stands on."""

from __future__ import annotations

import numpy as np
import pytest

from fusion.experiments.experiment import Setup
from fusion.experiments.outcome import Outcome
from fusion.messages import Floats
from fusion.virtual_patient.sensor import NO_NOISE
from server.experiments.catalogue.lag import EXPERIMENT
from server.experiments.lag.filters import median, one_euro
from server.experiments.lag.linear import best_linear
from server.experiments.lag.reaching import HIGHEST_RAD, LOWEST_RAD, PEAK_RAD_S, reaching
from server.experiments.lag.scores import delayed, rms_deg, score
from server.experiments.lag.seen import seen


@pytest.fixture(scope="module")
def outcome() -> Outcome:
    return EXPERIMENT.run(Setup(seed=1, effort=0.01))


@pytest.fixture(scope="module")
def truth() -> Floats:
    return reaching(3, 40.0, NO_NOISE).truth_rad[:, 1]


def test_sr2_no_set_point_breaks_the_jerk_limit(outcome: Outcome) -> None:
    (jerk,) = (row for row in outcome.beside if row.what.startswith("largest jerk"))
    assert jerk.met, jerk.ours


def test_without_noise_the_set_point_comes_no_more_than_60_ms_behind(outcome: Outcome) -> None:
    (delay,) = (row for row in outcome.beside if row.what == "delay, upper arm / elbow (none)")
    assert delay.met, delay.ours


def test_the_table_of_rivals_has_every_filter_bare_and_limited(outcome: Outcome) -> None:
    (table,) = (table for table in outcome.tables if table.name == "trade-off")
    families = {row[0] for row in table.rows}
    assert families == {"none", "median", "One Euro", "ours"}
    assert len(table.rows) % 4 == 0


def test_reaches_peak_at_the_speed_they_are_said_to() -> None:
    scene = reaching(3, 40.0, NO_NOISE)
    speed = np.abs(np.diff(scene.truth_rad, axis=0)).max() / 0.01
    assert speed == pytest.approx(PEAK_RAD_S, rel=0.01)
    assert (scene.truth_rad >= LOWEST_RAD - 1e-9).all()
    assert (scene.truth_rad <= HIGHEST_RAD + 1e-9).all()


def test_perfect_sensors_see_the_true_angles_a_frame_late_at_most() -> None:
    known = seen(reaching(3, 12.0, NO_NOISE))
    for joint in (1, 3):
        assert score(known.sensors_rad[:, joint], known.truth_rad[:, joint]).delay_ms <= 40.0
        assert rms_deg(known.sensors_rad[:, joint], known.truth_rad[:, joint], 2) < 1.0


def test_a_delay_is_found_and_costs_nothing_at_itself(truth: Floats) -> None:
    found = score(delayed(truth, 12), truth)
    assert found.delay_ms == 120.0
    assert found.at_delay_deg == 0.0
    assert found.now_deg > 1.0


def test_the_best_linear_filter_of_a_pure_delay_undoes_what_can_be_undone(truth: Floats) -> None:
    assert rms_deg(best_linear(delayed(truth, 3), truth, 6), truth, 6) < 0.01


def test_a_punctual_filter_comes_when_it_should_and_the_best_comes_later(truth: Floats) -> None:
    noisy = truth + np.random.default_rng(1).normal(0, 0.15, len(truth))
    punctual, best = (best_linear(noisy, truth, 6, 0.0, told) for told in (True, False))
    assert score(punctual, truth).delay_ms == pytest.approx(60.0, abs=10.0)
    assert score(best, truth).delay_ms > score(punctual, truth).delay_ms
    assert rms_deg(best, truth, 6) < rms_deg(punctual, truth, 6)


def test_the_median_lags_by_half_its_window(truth: Floats) -> None:
    assert score(median(truth, 0.4), truth).delay_ms == pytest.approx(200.0, abs=30.0)


def test_one_euro_with_beta_is_quicker_than_without(truth: Floats) -> None:
    slow, quick = (score(one_euro(truth, 0.5, beta), truth).delay_ms for beta in (0.0, 2.0))
    assert quick < slow
