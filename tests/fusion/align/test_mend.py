"""Exchanged sides are put back, or left out, by the predicted body."""

from __future__ import annotations

import numpy as np

from fusion.align.mend import SIDED, Mending, mend
from fusion.messages import AlignedSample, FusedFrame
from fusion.skeleton import INDEX, JOINT_COUNT, SIDES_SWAPPED

TRACKED = np.full(JOINT_COUNT, 2, dtype=np.uint8)


def sample(positions):
    return AlignedSample("k", 0.0, 0.0, positions, TRACKED, np.zeros(3), np.eye(3))


def predicted(positions):
    return FusedFrame(0.0, positions, np.tile(np.eye(3), (JOINT_COUNT, 1, 1)), np.ones(JOINT_COUNT), TRACKED)


def test_exchanged_sides_are_put_back(bodies):
    body = bodies.body_at(2.0)
    mended, what = mend(sample(body[SIDES_SWAPPED]), predicted(body))
    assert what is Mending.SWAPPED_BACK
    np.testing.assert_array_equal(mended.positions_in_room, body)


def test_a_body_that_moves_is_left_alone(bodies):
    now = sample(bodies.body_at(2.05))
    mended, what = mend(now, predicted(bodies.body_at(2.0)))
    assert what is Mending.NONE
    assert mended is now


def test_a_reversed_trunk_that_exchanging_does_not_explain_loses_its_sides_only(bodies):
    body = bodies.body_at(2.0)
    strange = body.copy()
    strange[SIDED] = body[SIDES_SWAPPED][SIDED] + [0.0, 0.0, 0.6]
    mended, what = mend(sample(strange), predicted(body))
    assert what is Mending.SIDES_REFUSED
    assert (mended.state[SIDED] == 0).all()
    assert mended.state[INDEX["SpineMid"]] == 2


def test_nothing_is_judged_without_a_prediction(bodies):
    now = sample(bodies.body_at(0.0)[SIDES_SWAPPED])
    assert mend(now, None) == (now, Mending.NONE)
