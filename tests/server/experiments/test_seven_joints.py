"""Experiment 5 in a small size, and the measures that it stands on."""

from __future__ import annotations

import numpy as np
import pytest

from fusion.experiments.experiment import Setup
from fusion.experiments.outcome import Outcome
from server.experiments.catalogue.seven_joints import EXPERIMENT
from server.experiments.cranked.judged import grown_m, late, within


@pytest.fixture(scope="module")
def outcome() -> Outcome:
    return EXPERIMENT.run(Setup(seed=1, effort=0.05))


def test_the_arm_follows_while_either_sensor_is_covered_and_is_held_while_both_are(outcome: Outcome) -> None:
    met = {row.what: row.met for row in outcome.beside if row.met is not None}
    assert len(met) == 4
    assert all(met.values()), outcome.beside


def test_covering_a_lens_moves_the_hand_no_further_than_the_sensors_are_off(outcome: Outcome) -> None:
    clear, first, second, both = outcome.tables[0].rows
    assert clear[1] == first[1] == second[1] == 100.0
    assert float(both[1]) < 20.0
    assert max(float(clear[4]), float(first[4]), float(second[4])) < 150.0


def test_the_drive_is_not_what_delays_the_arm(outcome: Outcome) -> None:
    for _, _, _, drive_ms, all_ms, drive_mrad, *_ in outcome.tables[1].rows:
        assert float(drive_ms) <= min(10.0, float(all_ms))
        assert float(drive_mrad) < 10.0


def test_parts_that_need_recordings_say_so(outcome: Outcome) -> None:
    assert "none were given" in outcome.left_out[0]


def test_a_known_delay_is_found_and_taken_off() -> None:
    t_s = np.arange(0.0, 20.0, 0.01)
    leader = np.stack([np.sin(1.3 * t_s), np.sin(0.7 * t_s)], axis=1)
    follower = np.stack([np.sin(1.3 * (t_s - 0.06)), np.sin(0.7 * (t_s - 0.123))], axis=1)
    found = late(follower, leader, within(t_s, [(1.0, 19.0)]))
    assert found.delay_s == pytest.approx([0.06, 0.123], abs=1e-3)
    assert (found.rms_shifted_rad < 1e-3).all()
    assert (found.rms_rad > 0.05).all()


def test_only_growth_counts_as_a_jump() -> None:
    t_s = np.arange(0.0, 1.0, 0.01)
    assert grown_m(t_s, 0.3 - 0.1 * t_s, 0.5, 0.1) == 0.0
    assert grown_m(t_s, 0.2 * t_s, 0.5, 0.1) == pytest.approx(0.018)
