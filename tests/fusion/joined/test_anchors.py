"""The anchors' frame is found from a pelvis that cameras see beside the tag."""

from __future__ import annotations

import numpy as np
from hypothesis import given, settings
from hypothesis import strategies as st
from scipy.spatial.transform import Rotation

from fusion.joined import anchors
from fusion.joined.anchors import AnchorFrame
from fusion.messages import PositionSample

SEEDS = st.integers(0, 2**32 - 1)
STAND = np.array([[0.0, 0.0, 2.2], [4.0, 0.0, 0.4], [4.0, 3.0, 2.3], [0.0, 3.0, 0.3], [2.0, 3.0, 2.5], [2.0, 0.0, 1.2]])
BIAS_M = np.array([0.1, -0.05, 0.2, 0.0, 0.15, -0.1])
OFF_M = np.array([0.04, -0.03, 0.05])
NO_RANGES = np.zeros((0, 3)), np.zeros(0)


def said(t_s: float, tag: np.ndarray, longer_m: np.ndarray | float = 0.0) -> PositionSample:
    """A tag whose links are biased, and whose own position is off by a few centimetres for it."""
    range_m = np.linalg.norm(tag - STAND, axis=1) + BIAS_M + longer_m
    return PositionSample("waist", t_s, tag + OFF_M, STAND, range_m)


def frame_learnt(
    rng: np.random.Generator, stroll_m: float, with_ranges: bool = True
) -> tuple[AnchorFrame, Rotation, np.ndarray]:
    """After 30 s of somebody who shifts about; the true turn and where the room's origin is."""
    upright = Rotation.from_matrix([[1.0, 0.0, 0.0], [0.0, 0.0, 1.0], [0.0, -1.0, 0.0]])
    to_room = Rotation.from_rotvec([0.0, rng.uniform(-3, 3), 0.0]) * upright
    origin, frame = rng.normal(0, 2, 3), anchors.unknown()
    for k in range(300):
        tag = np.array([2.0, 1.0, 0.9]) + stroll_m * np.sin([0.05 * k, 0.07 * k + 1, 0.0])
        pelvis = to_room.apply(tag) + origin + rng.normal(0, 0.02, 3)
        sample = said(0.1 * k, tag) if with_ranges else PositionSample("waist", 0.1 * k, tag, *NO_RANGES)
        frame = anchors.learn(frame, 0.1 * k, pelvis, (sample,))
    return frame, to_room, origin


def placed(frame: AnchorFrame, sample: PositionSample, t_s: float = 30.0) -> tuple[np.ndarray, float]:
    found = anchors.in_room(frame, (sample,), t_s)
    assert found is not None
    return found


@settings(max_examples=12)
@given(seed=SEEDS, far_m=st.floats(0.0, 1.5), with_ranges=st.booleans())
def test_the_tag_is_within_its_tolerance_wherever_it_goes(seed: int, far_m: float, with_ranges: bool) -> None:
    rng = np.random.default_rng(seed)
    frame, to_room, origin = frame_learnt(rng, 0.3, with_ranges)
    tag = np.array([2.0 + far_m, 1.0, 0.9])
    sample = said(30.0, tag) if with_ranges else PositionSample("waist", 30.0, tag, *NO_RANGES)
    place, tolerance_m = placed(frame, sample)
    assert np.linalg.norm(place - to_room.apply(tag) - origin) <= tolerance_m


def test_the_links_biases_are_learnt_and_a_blocked_link_does_not_pull() -> None:
    frame, to_room, origin = frame_learnt(np.random.default_rng(1), 0.3)
    tag = np.array([2.1, 1.1, 0.9])
    blocked = said(30.0, tag, np.array([0.0, 0.3, 0.0, 0.0, 0.0, 0.0]))
    place, _ = placed(frame, blocked)
    assert np.linalg.norm(place - to_room.apply(tag) - origin) < 0.05


def test_somebody_who_keeps_still_teaches_the_place_and_not_the_turn() -> None:
    frame, *_ = frame_learnt(np.random.default_rng(1), 0.0)
    here, far = (placed(frame, said(30.0, np.array([2.0 + away, 1.0, 0.9])))[1] for away in (0.0, 1.0))
    assert here < 0.15
    assert far > 1.0


def test_an_old_position_counts_for_less_and_none_before_the_frame_is_known() -> None:
    frame, *_ = frame_learnt(np.random.default_rng(1), 0.3)
    sample = said(30.0, np.array([2.0, 1.0, 0.9]))
    assert placed(frame, sample, 30.1)[1] > placed(frame, sample)[1] + 0.1
    assert anchors.in_room(anchors.unknown(), (sample,), 30.0) is None
    assert anchors.in_room(frame, (), 30.0) is None
