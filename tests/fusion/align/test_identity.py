"""One person is followed; everybody else is refused."""

from __future__ import annotations

import numpy as np
import pytest

from fusion.align.identity import Expected, PatientFinder
from fusion.messages import SkeletonSample
from fusion.skeleton import JOINT_COUNT

TRACKED = np.full(JOINT_COUNT, 2, dtype=np.uint8)


@pytest.fixture
def body(bodies):
    def make(name, t_s, at=(0.0, 0.0, 2.0)):
        return SkeletonSample("k", name, t_s, t_s, bodies.BODY + np.asarray(at), TRACKED)

    return make


def unknown():
    return None


def run(finder, seen, expected=unknown):
    """Who is taken for the patient, over samples in order."""
    return [sample.body for sample in seen if finder.is_patient(sample, sample.t_s, expected)]


def test_the_nearest_to_the_lens_is_chosen_when_nobody_is_known(body):
    seen = [s for t in np.arange(0, 1, 1 / 30) for s in (body("far", t, (0.5, 0, 3.0)), body("near", t))]
    assert set(run(PatientFinder(), seen)) == {"near"}


def test_a_person_passing_nearer_does_not_become_the_patient(body):
    finder = PatientFinder()
    run(finder, [body("patient", t) for t in np.arange(0, 1, 1 / 30)])
    passing = [s for t in np.arange(1, 2, 1 / 30) for s in (body("other", t, (t - 1.5, 0, 1.2)), body("patient", t))]
    assert set(run(finder, passing)) == {"patient"}


def test_somebody_seen_beside_the_patient_is_not_taken_when_the_patient_is_hidden(body):
    finder = PatientFinder()
    both = [s for t in np.arange(0, 1, 1 / 30) for s in (body("patient", t), body("other", t, (0.6, 0, 2.4)))]
    run(finder, both)
    here = Expected(np.array([0.0, 0.0, 2.0]), 0.6)
    hidden = [body("other", t) for t in np.arange(1, 4, 1 / 30)]
    assert run(finder, hidden, lambda: here) == []
    assert run(finder, [body("patient", 4.0)], lambda: here) == ["patient"]


@pytest.fixture
def beside(body):
    """A finder whose patient has left; the other one stays."""
    finder = PatientFinder()
    run(finder, [s for t in np.arange(0, 1, 1 / 30) for s in (body("patient", t), body("other", t, (0.6, 0, 2.4)))])
    gone = Expected(np.array([0.0, 0.0, 2.0]), 20.0)
    assert run(finder, [body("other", t) for t in np.arange(1, 6, 1 / 30)], lambda: gone) == []
    return finder, gone


def test_the_number_of_somebody_who_was_away_for_long_may_be_the_patients(beside, body):
    finder, gone = beside
    assert set(run(finder, [body("other", t) for t in np.arange(12, 13, 1 / 30)], lambda: gone)) == {"other"}


def test_who_stood_beside_the_last_patient_may_be_the_next_one(beside, body):
    finder, gone = beside
    finder.begin_session()
    assert set(run(finder, [body("other", t) for t in np.arange(6, 7, 1 / 30)], lambda: gone)) == {"other"}


def test_a_new_number_where_the_patient_was_is_the_patient(body):
    finder = PatientFinder()
    run(finder, [body("7", t) for t in np.arange(0, 1, 1 / 30)])
    again = [body("8", t, (0.2, 0, 2.1)) for t in np.arange(1.8, 2.5, 1 / 30)]
    assert set(run(finder, again, lambda: Expected(np.array([0.0, 0.3, 2.0]), 0.8))) == {"8"}


def test_a_new_number_far_from_where_the_patient_was_is_somebody_else(body):
    finder = PatientFinder()
    run(finder, [body("7", t) for t in np.arange(0, 1, 1 / 30)])
    entering = [body("8", t, (2.5, 0, 3.5)) for t in np.arange(1.8, 2.5, 1 / 30)]
    assert run(finder, entering, lambda: Expected(np.array([0.0, 0.3, 2.0]), 0.8)) == []


def test_a_number_that_jumps_to_another_place_has_gone_to_somebody_else(body):
    finder = PatientFinder()
    run(finder, [body("0", t) for t in np.arange(0, 1, 1 / 30)])
    here = Expected(np.array([0.0, 0.3, 2.0]), 0.0)
    jumped = [s for t in np.arange(1, 1.3, 1 / 30) for s in (body("0", t, (1.8, 0, 2.8)), body("1", t))]
    assert set(run(finder, jumped, lambda: here)) == {"1"}


def test_a_persons_choice_wins(body):
    finder = PatientFinder()
    both = [s for t in np.arange(0, 1, 1 / 30) for s in (body("a", t), body("b", t, (0.8, 0, 2.5)))]
    assert set(run(finder, both)) == {"a"}
    finder.follow("k", "b")
    later = [s for t in np.arange(1, 2, 1 / 30) for s in (body("a", t), body("b", t, (0.8, 0, 2.5)))]
    assert set(run(finder, later)) == {"b"}


def test_a_body_without_a_seen_joint_is_nobody(body):
    blind = SkeletonSample("k", "a", 0.0, 0.0, np.full((JOINT_COUNT, 3), np.nan), np.zeros(JOINT_COUNT, np.uint8))
    assert run(PatientFinder(), [blind]) == []
