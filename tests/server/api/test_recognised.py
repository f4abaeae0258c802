"""A log-in that the database has confirmed a moment ago needs no second question."""

import pytest

from db.account import Account
from server.api import recognised
from server.api.recognised import LATELY_S, Recognised

LIN = Account(name="lin")


@pytest.fixture
def clock():
    return [100.0]


@pytest.fixture
def known(clock):
    return Recognised(lambda: clock[0])


def test_whoever_was_there_a_moment_ago_is_known_without_asking(known, clock):
    known.note("token", LIN)
    clock[0] += LATELY_S
    assert known.lately("token") is LIN
    clock[0] += 0.1
    assert known.lately("token") is None
    assert known.ever("token") is LIN


def test_a_log_out_is_known_at_once(known):
    known.note("token", LIN)
    known.note("token", None)
    assert known.lately("token") is None
    assert known.ever("token") is None


def test_strangers_are_not_known(known):
    assert known.lately("token") is None


def test_of_very_many_those_longest_not_asked_for_are_forgotten(known, monkeypatch):
    monkeypatch.setattr(recognised, "KEPT", 2)
    for token in ("a", "b", "a", "c"):
        known.note(token, LIN)
    assert [token for token in "abc" if known.ever(token)] == ["a", "c"]
