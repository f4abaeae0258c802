"""A robot that is not where it is told to be is noticed, and not commanded from afar."""

from __future__ import annotations

import numpy as np

from server.station.exo.rosbridge.following import Following

NAMES = ("a", "b")
HERE = np.array([0.0, 1.0])


def _after(steps, moving=True, following=None):
    following = following or Following()
    for tick, measured in enumerate(steps):
        following = following.step(NAMES, HERE, np.asarray(measured), moving, 0.35, tick * 0.01)
    return following


def test_a_robot_near_what_it_is_told_is_joined() -> None:
    assert _after([(0.05, 0.95)]).joined


def test_sr6_a_robot_elsewhere_is_not_joined() -> None:
    assert not _after([(0.0, 1.2)]).joined


def test_one_that_stays_elsewhere_is_named_after_its_time() -> None:
    joined = _after([HERE])
    assert not _after([HERE] + [(0.0, 0.6)] * 25, following=joined).fault
    fault = _after([HERE] + [(0.0, 0.6)] * 40, following=joined).fault
    assert "'b'" in fault
    assert "0.40 rad" in fault


def test_a_robot_that_only_holds_may_be_moved_by_hand() -> None:
    assert not _after([HERE] + [(0.0, 0.2)] * 100, moving=False).fault


def test_it_is_well_again_when_it_is_near_again() -> None:
    assert not _after([HERE] + [(0.0, 0.5)] * 60 + [HERE]).fault
