"""The baselines do the work that they are timed for: they follow the same body as our own filter."""

from itertools import islice

import numpy as np
from numpy.testing import assert_allclose

from fusion.benchmarks.filterpy_filter import FilterPyBody
from fusion.benchmarks.fused_frame import fused_by
from fusion.benchmarks.rounds import Candidate, take_turns
from fusion.benchmarks.scene import frames
from fusion.benchmarks.stonesoup_filter import StoneSoupBody
from fusion.estimation import METHODS
from fusion.skeleton import JOINT_COUNT

SECONDS_2 = 60


def test_both_baselines_follow_the_body_as_our_gated_filter_does() -> None:
    seen = list(islice(frames(JOINT_COUNT, 2), SECONDS_2))
    filterpy, stonesoup, ours = FilterPyBody(JOINT_COUNT), StoneSoupBody(JOINT_COUNT), fused_by(METHODS["kalman"]())
    for samples in seen:
        told = filterpy.take(samples), stonesoup.take(samples), ours(samples).positions_in_room
    for positions in told[:2]:
        assert_allclose(positions, told[2], atol=0.02)


def test_a_baseline_refuses_what_is_beyond_its_gate() -> None:
    seen = list(islice(frames(JOINT_COUNT, 1), SECONDS_2))
    for body in (FilterPyBody(JOINT_COUNT), StoneSoupBody(JOINT_COUNT)):
        for samples in seen[:-1]:
            before = body.take(samples)
        wild = seen[-1][0]
        wild.positions_in_room[0] += 1.0
        assert np.abs(body.take(seen[-1])[0] - before[0]).max() < 0.1


def test_every_candidate_is_done_as_often_as_asked_and_in_turn() -> None:
    done: list[str] = []
    timings = take_turns(
        {"a": Candidate(lambda: done.append("a"), 2), "b": Candidate(lambda: done.append("b"))}, rounds=3
    )
    assert done == ["a", "a", "b"] * 4
    assert [len(timings[name].per_piece_us) for name in "ab"] == [6, 3]
