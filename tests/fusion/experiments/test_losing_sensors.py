"""Taking sensors away from the one estimator: when, what is left, and what becomes of the bound."""

import numpy as np
import pytest

from fusion.evaluation.scores import score
from fusion.experiments.measures.losing_sensors import (
    BOTH,
    FOR_GOOD,
    LEARN_S,
    LOSSES,
    Loss,
    gaps,
    judged,
    patient,
    together,
    told,
)


@pytest.fixture(scope="module")
def somebody():
    return patient(1, LEARN_S + 9.0)


@pytest.fixture(scope="module")
def whole(somebody):
    return figures(somebody, FOR_GOOD[0])


def figures(who, loss):
    found = judged(told(who, loss), who.side)
    return score(found.arm), found


def test_a_loss_for_good_lasts_to_the_end_and_a_gap_comes_again_and_again():
    assert gaps(FOR_GOOD[0], 90.0) == ((LEARN_S, 90.0),)
    short = gaps(Loss("", BOTH, gap_s=5.0), 90.0)
    assert [end - start for start, end in short] == [5.0] * len(short)
    assert len(short) == 3
    assert len({loss.name for loss in LOSSES}) == len(LOSSES)


def test_covering_both_cameras_widens_the_bound_and_the_truth_stays_inside(somebody, whole):
    covered, found = figures(somebody, Loss("", BOTH, gap_s=5.0))
    blind, _ = figures(somebody, Loss("", BOTH, True, True, True, gap_s=5.0))
    assert whole[0].bound_p50_mm < covered.bound_p50_mm < 0.5 * blind.bound_p50_mm
    assert whole[0].inside_share == covered.inside_share == blind.inside_share == 1.0
    assert np.sqrt(np.mean(found.from_shoulder_m**2)) < 0.06


def test_two_people_are_judged_as_one(whole):
    _, once = whole
    twice = together([once, once])
    assert score(twice.arm).instants == 2 * score(once.arm).instants
    assert score(twice.arm).rms_mm == pytest.approx(score(once.arm).rms_mm)
