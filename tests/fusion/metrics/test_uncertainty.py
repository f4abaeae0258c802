"""A figure's standard error is what repeating the session would show, and the detectable change follows from it."""

from __future__ import annotations

from math import sqrt

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from fusion.metrics.uncertainty import (
    BATCHES,
    FEWEST,
    SHORTEST_BATCH,
    batch_sem,
    bootstrap_sem,
    mean_sem,
    minimal_detectable_change,
    share_sem,
    wandering_sem,
)

sems = st.floats(1e-6, 1e3)


def test_a_bootstrapped_error_is_the_spread_of_the_medians_of_many_sessions() -> None:
    rng = np.random.default_rng(5)
    sessions = rng.normal(0.8, 0.2, (300, 40))
    told = np.mean([bootstrap_sem(session) for session in sessions])
    assert told == pytest.approx(np.median(sessions, axis=1).std(), rel=0.2)


def test_a_batched_error_knows_that_neighbouring_ticks_say_the_same() -> None:
    rng = np.random.default_rng(6)
    said_once = rng.normal(size=(200, 30))
    ticks = np.repeat(said_once, 100, axis=1)  # everything is told for a hundred ticks
    told = [batch_sem(session, lambda batch: float(batch.mean())) for session in ticks]
    assert np.sqrt(np.mean(np.square(told))) == pytest.approx(said_once.mean(axis=1).std(), rel=0.2)
    assert mean_sem(ticks[0]) < 0.3 * said_once.mean(axis=1).std()  # what a plain error would have claimed


def test_of_too_little_no_error_is_told() -> None:
    assert bootstrap_sem(np.ones(FEWEST - 1)) is None
    assert mean_sem(np.ones(FEWEST - 1)) is None
    assert share_sem(FEWEST - 1, FEWEST - 1) is None
    assert batch_sem(np.ones(BATCHES * SHORTEST_BATCH - 1), lambda batch: float(batch.mean())) is None
    assert batch_sem(np.ones(BATCHES * SHORTEST_BATCH), lambda batch: None) is None


@given(hits=st.integers(0, 200), more=st.integers(FEWEST, 200))
def test_a_share_is_never_quite_sure(hits: int, more: int) -> None:
    sem = share_sem(hits, hits + more)
    assert sem is not None
    assert 0.0 < sem < 0.5001 / sqrt(hits + more)


def test_the_same_session_always_has_the_same_error() -> None:
    values = np.random.default_rng(7).normal(size=30)
    assert bootstrap_sem(values) == bootstrap_sem(values)


@given(sem=sems, sessions=st.integers(1, 9))
def test_equal_errors_give_the_textbooks_detectable_change(sem: float, sessions: int) -> None:
    assert minimal_detectable_change([sem] * sessions) == pytest.approx(1.96 * sqrt(2) * sem)


@given(known=st.lists(sems, min_size=1))
def test_sessions_without_an_error_change_nothing(known: list[float]) -> None:
    assert minimal_detectable_change([None, *known, None]) == minimal_detectable_change(known)


def test_the_cameras_error_adds_to_what_the_sessions_tell() -> None:
    alone = minimal_detectable_change([0.3, 0.3])
    assert minimal_detectable_change([0.3, 0.3], camera_error=0.4) == pytest.approx(1.96 * sqrt(2) * 0.5)
    assert alone == pytest.approx(1.96 * sqrt(2) * 0.3)
    assert minimal_detectable_change([None], camera_error=0.4) is None


def test_a_value_that_wanders_is_less_sure_than_one_that_does_not() -> None:
    rng = np.random.default_rng(9)
    wandering = np.cumsum(rng.normal(size=(200, 40)), axis=1) / 6.0
    told = np.array([wandering_sem(walk) for walk in wandering])
    plain = np.array([mean_sem(walk) for walk in wandering])
    assert np.median(told / plain) > 1.8
    assert wandering_sem(np.ones(2 * FEWEST - 1)) is None


def test_nothing_known_nothing_detectable() -> None:
    assert minimal_detectable_change([None, None]) is None


def test_two_sessions_of_the_same_person_differ_by_more_than_the_detectable_change_one_time_in_twenty() -> None:
    rng = np.random.default_rng(8)
    sessions = rng.normal(0.8, 0.2, (400, 2, 30))
    beyond = 0
    for first, second in sessions:
        mdc = minimal_detectable_change([bootstrap_sem(first), bootstrap_sem(second)])
        assert mdc is not None
        beyond += abs(np.median(first) - np.median(second)) > mdc
    assert beyond / len(sessions) == pytest.approx(0.05, abs=0.035)
