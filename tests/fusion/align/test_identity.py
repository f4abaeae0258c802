"""One person is followed; everybody else is refused."""

from __future__ import annotations

import numpy as np
import pytest

from fusion.align.bodies import Expected, Verdict
from fusion.align.identity import PatientFinder
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
    return [sample.body for sample in seen if finder.judge(sample, sample.t_s, expected) is Verdict.PATIENT]


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


CHILD = 0.8
"""Of an adult's size."""


@pytest.fixture
def built(bodies):
    """A body of any size, about its pelvis."""

    def make(name, t_s, at=(0.0, 0.0, 2.0), size=1.0, sensor="k"):
        return SkeletonSample(sensor, name, t_s, t_s, size * bodies.BODY + np.asarray(at), TRACKED)

    return make


def times(from_s, to_s):
    return np.arange(from_s, to_s, 1 / 30)


def verdicts(finder, seen, expected=unknown):
    return [finder.judge(sample, sample.t_s, expected) for sample in seen]


def test_a_number_that_goes_over_to_somebody_of_another_build_is_let_go(built):
    """They cross, and the number walks away with the other one: nothing jumps."""
    finder = PatientFinder()
    run(finder, [built("1", t) for t in times(0, 6)])
    handed_over = [built("1", t, (0.5 * (t - 6), 0, 2.0), CHILD) for t in times(6, 11)]
    told = verdicts(finder, handed_over)
    assert told[-1] is Verdict.BONES
    assert told.count(Verdict.PATIENT) < 3.5 * 30


def test_somebody_of_another_build_who_takes_the_patients_place_is_let_go(built):
    finder = PatientFinder()
    here = Expected(np.array([0.0, 0.3, 2.0]), 0.8)
    run(finder, [built("1", t) for t in times(0, 6)])
    told = verdicts(finder, [built("2", t, size=CHILD) for t in times(6.6, 11)], lambda: here)
    assert told[-1] is Verdict.BONES
    assert told.count(Verdict.PATIENT) < 2 * 30
    again = verdicts(finder, [built("3", t) for t in times(11, 13)], lambda: here)
    assert again[-1] is Verdict.PATIENT


def test_a_therapist_who_comes_into_view_before_the_patient_and_leans_over_is_refused(built):
    """The patient's own number is lost behind the therapist, and a new one is given after."""
    finder = PatientFinder()
    here = Expected(np.array([0.0, 0.3, 2.0]), 0.0)
    both = [
        s for t in times(0, 6) for s in (built("patient", t), built("therapist", t, (1.2 - t / 8, 0, 1.9), size=1.15))
    ]
    assert set(run(finder, both, lambda: here)) == {"patient"}
    leaning = [built("therapist", t, (0.2, 0, 1.8), size=1.15) for t in times(6, 9)]
    assert run(finder, leaning, lambda: here) == []
    back = [s for t in times(9, 11) for s in (built("new", t), built("therapist", t, (0.4, 0, 1.8), size=1.15))]
    assert set(run(finder, back, lambda: here)) == {"new"}


def test_a_choice_is_kept_though_the_bones_look_different_for_a_moment(built):
    finder = PatientFinder()
    both = [s for t in times(0, 2) for s in (built("a", t), built("b", t, (0.8, 0, 2.5)))]
    run(finder, both)
    finder.follow("k", "b")
    badly_seen = [built("b", t, (0.8, 0, 2.5), 0.92) for t in times(2, 5)]
    assert set(verdicts(finder, badly_seen)) == {Verdict.PATIENT}


def paired(finder, seen, expected):
    """Samples of two sensors whose frames are the room's: which bodies are used."""
    for sample in seen:
        verdict = finder.judge(sample, sample.t_s, expected)
        at = sample.positions_in_sensor[0]
        if verdict is Verdict.PATIENT and finder.agrees(sample.sensor, sample.t_s, at, expected):
            yield sample.sensor, sample.body


def test_a_sensor_that_follows_somebody_else_is_not_used_and_comes_back_to_the_patient(built):
    """Its number for the patient leaves with a visitor of the same build; the patient gets a new one in it."""
    finder = PatientFinder()
    here = Expected(np.array([0.0, 0.4, 2.0]), 0.0)
    list(paired(finder, [built("1", t, sensor=s) for t in times(0, 2) for s in "ab"], lambda: here))
    leaving = [
        sample
        for t in times(2, 6)
        for sample in (
            built("1", t, sensor="a"),
            built("1", t, (0.6 * (t - 2), 0, 2.0), sensor="b"),
            *((built("9", t, sensor="b"),) if t > 3 else ()),
        )
    ]
    used = list(paired(finder, leaving, lambda: here))
    assert ("b", "1") not in used[90:]
    assert ("b", "9") in used
    assert used[-1] == ("b", "9")
    assert {body for sensor, body in used if sensor == "a"} == {"1"}


def test_everybody_in_view_is_told_with_a_reason(built):
    finder = PatientFinder()
    run(finder, [s for t in times(0, 1) for s in (built("a", t), built("b", t, (0.8, 0, 2.5)))])
    told = {seen.body: (seen.verdict, seen.confirmed) for seen in finder.bodies(1.0)}
    assert told == {"a": (Verdict.PATIENT, False), "b": (Verdict.BESIDE, False)}
    finder.follow("k", "b")
    run(finder, [s for t in times(1, 1.2) for s in (built("a", t), built("b", t, (0.8, 0, 2.5)))])
    told = {seen.body: (seen.verdict, seen.confirmed) for seen in finder.bodies(1.2)}
    assert told == {"a": (Verdict.BESIDE, False), "b": (Verdict.PATIENT, True)}
    assert finder.bodies(9.0) == ()


def test_a_body_that_sinks_through_the_floor_is_not_used_and_is_the_patient_again_when_it_comes_back(built):
    """What a Kinect shows when it loses somebody."""
    finder = PatientFinder()
    run(finder, [built("1", t) for t in times(0, 2)])
    sinking = verdicts(finder, [built("1", t, (0.0, -20 * (t - 2) ** 2, 2.0)) for t in times(2, 2.4)])
    assert sinking[-1] is Verdict.SWIFT
    assert verdicts(finder, [built("1", t) for t in times(3, 3.2)])[-1] is Verdict.PATIENT


def test_frames_that_were_held_up_and_come_in_a_bunch_are_still_the_patients(built):
    """A busy computer reads three frames at once; each is a thirtieth of a second's movement and noise further."""
    noise = np.random.default_rng(2).normal(0.0, 0.012, (90, 3))
    bunched = [built("1", k // 3 / 10 + k % 3 * 0.001, np.array([0.03 * k / 3, 0, 2.0]) + noise[k]) for k in range(90)]
    assert set(verdicts(PatientFinder(), bunched)[6:]) == {Verdict.PATIENT}
