"""Where the anchors' frame stands in the room, learnt from the pelvis while cameras see it beside the tag.

p_room = R p_anchors + T, R nearest to the sums of paired points (those of `fusion.align.space`), with the two frames'
up as a prior. Then every link's bias is what its range exceeds the way to that pelvis by; and what a located tag still
differs from the pelvis by, cameras' errors and the tag's together, says how far it may be off near the places where
both were seen. Farther away the turn's own uncertainty adds to it.
"""

from __future__ import annotations

from dataclasses import dataclass, replace
from typing import Final

import numpy as np

from fusion.align.space import POINTS_PER_INDEPENDENT, Moments, Mounting, mounting
from fusion.joined.bone_fit import UP_IN_ROOM
from fusion.joined.multilateration import position_of
from fusion.messages import Floats, PositionSample

MEMORY_S: Final = 60.0
FADE_AT_MOST_S: Final = 1.0
"""Nothing is forgotten while cameras see nothing."""
LEAST_SAMPLES: Final = 30.0
MEMORY_SAMPLES: Final = 300.0
STEP_MAX_M: Final = 0.15
"""No single range counts for more: while a link is blocked it is decimetres too long."""
SIGMAS: Final = 4.0
"""Of one axis: 99.9 % of a ball."""
LEAST_STD_M: Final = 0.02
UP_WEIGHT: Final = 30.0
"""The prior on up, in m²: so many pairs a metre above the middle."""
CORRELATED: Final = 4.0
"""So many pairs count as one; `mounting` reckons with whole skeletons at 30 Hz."""
UNTOLD_M: Final = 0.3
"""Doubt of a position that its own ranges do not bear out."""
USUAL_STD_M: Final = np.array([1.0, 0.15, 1.0])
"""A pelvis keeps its height but for sitting down, which is 2 or 3 of these; it goes where it likes."""
LARGEST_TURN: Final = 2.0
"""A chord of the unit circle is no longer."""
SPEED_M_S: Final = 1.5
"""A pelvis is no faster in therapy; what a position's age adds to its tolerance."""
UP_IN_ANCHORS: Final = np.array([0.0, 0.0, 1.0])
Lately = tuple[PositionSample, ...]
"""What the tag said lately, newest last."""


@dataclass(frozen=True, slots=True)
class AnchorFrame:
    """What is known of the anchors' frame and of the links."""

    t_s: float
    """When a camera last saw the pelvis beside the tag; -inf never."""
    moments: Moments
    mounting: Mounting | None
    bias_m: Floats  # (A,) of each link
    deviation_m: Floats  # (A,) mean absolute, of each link
    link_count: Floats  # (A,)
    square_m2: float
    """Mean square of what a located tag differs from the pelvis by, per axis."""
    count: float


def unknown(links: int = 0) -> AnchorFrame:
    """Before anything was seen of a tag with so many links."""
    zero = np.zeros(links)
    return AnchorFrame(-np.inf, Moments.nothing(), None, zero, zero, zero, 0.0, 0.0)


def learn(frame: AnchorFrame, t_s: float, pelvis_in_room: Floats, lately: Lately) -> AnchorFrame:
    """Take one instant at which cameras saw the pelvis (3,)."""
    if not lately:
        return frame
    if len(frame.bias_m) != len(lately[-1].anchors):
        frame = unknown(len(lately[-1].anchors))
    keep = float(np.exp(-min(t_s - frame.t_s, FADE_AT_MOST_S) / MEMORY_S))
    pair = Moments.of(pelvis_in_room[None], lately[-1].position_in_anchors[None], np.ones(1))
    moments = frame.moments.faded(keep).joined(pair)
    found = mounting(_with_up(moments)) if moments.weight >= LEAST_SAMPLES else None
    placed = replace(frame, t_s=t_s, moments=moments, mounting=found)
    return _judged(_links_learnt(placed, pelvis_in_room, lately[-1]), pelvis_in_room, lately)


def in_room(frame: AnchorFrame, lately: Lately, t_s: float) -> tuple[Floats, float] | None:
    """The tag's place (3,) in the room at `t_s` and how far the pelvis may be from it; None while nothing is known."""
    found = frame.mounting
    if found is None or not lately or frame.count < LEAST_SAMPLES:
        return None
    place, doubt_m = _place(frame, found, lately)
    noise_m = max(float(np.sqrt(frame.square_m2)), LEAST_STD_M)
    turn_std = found.rotation_std_rad * np.sqrt(CORRELATED / POINTS_PER_INDEPENDENT)
    turn = min(SIGMAS * turn_std, LARGEST_TURN)
    away_m = float(np.linalg.norm(place - frame.moments.mean_reference))
    return place, SIGMAS * noise_m + doubt_m + turn * away_m + SPEED_M_S * max(t_s - lately[-1].t_s, 0.0)


def _links_learnt(frame: AnchorFrame, pelvis: Floats, tag: PositionSample) -> AnchorFrame:
    """Follow what each range exceeds the way by: running means with bounded steps."""
    if frame.mounting is None:
        return frame
    way = np.linalg.norm(_anchors_in_room(frame.mounting, tag.anchors) - pelvis, axis=1)
    there = np.isfinite(tag.range_m)
    misfit = np.where(there, tag.range_m - way - frame.bias_m, 0.0)
    first = frame.link_count == 0
    share = there / np.minimum(frame.link_count + 1, MEMORY_SAMPLES)
    bounded = np.where(first, misfit, np.clip(misfit, -STEP_MAX_M, STEP_MAX_M))
    spread = np.where(first, 0.0, np.minimum(np.abs(misfit), STEP_MAX_M) - frame.deviation_m)
    return replace(
        frame,
        bias_m=frame.bias_m + share * bounded,
        deviation_m=frame.deviation_m + share * spread,
        link_count=frame.link_count + there,
    )


def _judged(frame: AnchorFrame, pelvis: Floats, lately: Lately) -> AnchorFrame:
    """Remember how far the located tag is from the pelvis that cameras see."""
    if frame.mounting is None or frame.link_count.min(initial=np.inf) < LEAST_SAMPLES:
        return frame
    off = _place(frame, frame.mounting, lately)[0] - pelvis
    share = 1.0 / min(frame.count + 1.0, MEMORY_SAMPLES)
    return replace(
        frame, square_m2=frame.square_m2 + share * (float(off @ off) / 3 - frame.square_m2), count=frame.count + 1.0
    )


def _place(frame: AnchorFrame, found: Mounting, lately: Lately) -> tuple[Floats, float]:
    """From the ranges with their biases taken off, each link's mean lately, else as told; and its doubt."""
    told: Floats = found.rotation @ lately[-1].position_in_anchors + found.translation_m
    if not len(frame.bias_m):
        return told, 0.0
    ranges = np.array([sample.range_m for sample in lately])
    there = np.isfinite(ranges)
    mean = np.where(there, ranges, 0.0).sum(axis=0) / np.where(there.any(axis=0), there.sum(axis=0), np.nan)
    sigma_m = np.maximum(1.25 * frame.deviation_m, LEAST_STD_M)
    stand = _anchors_in_room(found, lately[-1].anchors)
    usual = frame.moments.mean_reference
    return position_of(stand, mean - frame.bias_m, sigma_m, usual, USUAL_STD_M) or (told, UNTOLD_M)


def _anchors_in_room(found: Mounting, anchors: Floats) -> Floats:
    placed: Floats = anchors @ found.rotation.T + found.translation_m
    return placed


def _with_up(moments: Moments) -> Moments:
    """The sums, with pairs of points above and below the middle, which move no middle."""
    return replace(
        moments,
        cross=moments.cross + UP_WEIGHT * np.outer(UP_IN_ROOM, UP_IN_ANCHORS),
        scatter=moments.scatter + UP_WEIGHT * np.outer(UP_IN_ANCHORS, UP_IN_ANCHORS),
        square=moments.square + UP_WEIGHT,
    )
