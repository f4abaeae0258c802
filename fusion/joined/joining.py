"""One instant: the cameras' sets cut by every rule, the point inside them, and how far it may be off."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Sequence
from dataclasses import dataclass, replace
from typing import Final, TypeVar

import numpy as np
from numpy.typing import NDArray

from fusion.joined import point
from fusion.joined.boxes import Boxes, Distance, Offset, Place, Rule, contracted
from fusion.joined.contractors import shrink_balls
from fusion.messages import Flags, Floats, FusedFrame, Refusal, States
from fusion.skeleton import JOINT_COUNT, TrackingState

CAMERAS: Final = "cameras"
INERTIAL: Final = "inertial"
TAG: Final = "tag"
SWEEPS: Final = 2
SHARED_M: Final = 0.05
"""What the evidence may err in common, so that joining it takes nothing off: where a camera believes to stand, skin."""
Kind = TypeVar("Kind", Offset, Place, Distance)


@dataclass(frozen=True, slots=True)
class Cut:
    """The sets of one instant, and the rules that made them."""

    boxes: Boxes
    doubted: Flags  # (J,) joints that cameras put where their inertial neighbours cannot be
    offsets: tuple[Offset, ...]
    places: tuple[Place, ...]
    distances: tuple[Distance, ...]
    unused: tuple[Rule, ...]
    """They would have left nothing."""


def cut(told: FusedFrame, offsets: Sequence[Offset], places: Sequence[Place], distances: Sequence[Distance]) -> Cut:
    """Cut the cameras' sets with all that is known of the same instant.

    While every rule and the cameras' sets hold the truth, so do the boxes. A camera's joint that does not fit its
    inertial neighbour is left out, that of the two which is the less sure; a rule that would leave nothing is not used.
    """
    doubted = _doubted(told, offsets)
    boxes, unused = contracted(_boxes(told, doubted), (*places, *offsets, *distances))
    return Cut(boxes, doubted, _without(offsets, unused), _without(places, unused), _without(distances, unused), unused)


def joined(
    told: FusedFrame, offsets: Sequence[Offset], places: Sequence[Place], distances: Sequence[Distance]
) -> FusedFrame:
    """The body that cameras tell, joined with what the other evidence says of the same instant.

    `bound_m` is the least of two: how far the farthest point of the set is, and four standard deviations of the point
    with what the evidence may err in common. Like the cameras' ball, the second is no guarantee.
    """
    sets = cut(told, offsets, places, distances)
    camera_m = np.where(sets.doubted, np.inf, told.bound_m)
    solved, std_m = point.solve(told.positions_in_room, camera_m, sets.offsets, sets.places, bones_hold=bool(distances))
    positions = np.clip(solved, sets.boxes.low, sets.boxes.high)
    half = np.maximum(sets.boxes.high - positions, positions - sets.boxes.low)
    likely_m = point.BOUND_SIGMAS * std_m + SHARED_M
    bound_m = np.where(np.isfinite(positions).all(axis=1), np.fmin(held_m(told, sets, positions), likely_m), np.inf)
    return replace(
        told,
        positions_in_room=positions,
        bound_m=bound_m,
        shape_m2=_shape(half, bound_m),
        state=_state(told, sets),
        refusals=(*told.refusals, *_refusals(sets)),
    )


def held_m(told: FusedFrame, sets: Cut, positions: Floats) -> Floats:
    """(J,) m, the largest distance from `positions` (J, 3) to any point of the sets.

    By the boxes' corners, and by the triangle inequality from the cameras' balls along every rule.
    """
    low, high = sets.boxes.low, sets.boxes.high
    corner_m = np.linalg.norm(np.maximum(high - positions, positions - low), axis=1)
    away_m = np.linalg.norm(positions - told.positions_in_room, axis=1)
    ball_m = np.where(np.isfinite(away_m) & ~sets.doubted, told.bound_m + away_m, np.inf)
    for place in sets.places:
        reach_m = np.linalg.norm(positions[place.joint] - place.position) + place.tolerance_m
        ball_m[place.joint] = min(ball_m[place.joint], reach_m)
    first, second, slack_m = _links(positions, sets)
    near = np.isfinite(slack_m)
    shrink_balls(ball_m, first[near], second[near], slack_m[near], SWEEPS)
    return np.asarray(np.fmin(corner_m, ball_m))


def _links(positions: Floats, sets: Cut) -> tuple[NDArray[np.int64], NDArray[np.int64], Floats]:
    """Pairs of joints, and how much farther the one may be from its point than the other."""
    first = np.array([r.parent for r in sets.offsets] + [r.first for r in sets.distances], dtype=np.int64)
    second = np.array([r.child for r in sets.offsets] + [r.second for r in sets.distances], dtype=np.int64)
    vector = np.array([r.offset for r in sets.offsets] + [np.zeros(3) for _ in sets.distances]).reshape(-1, 3)
    slack_m = np.array([r.tolerance_m for r in sets.offsets] + [r.most_m for r in sets.distances])
    return first, second, slack_m + np.linalg.norm(positions[second] - positions[first] - vector, axis=1)


def _boxes(told: FusedFrame, doubted: Flags) -> Boxes:
    """Around both the set and the ball that cameras tell; endless where nothing was seen or is believed."""
    half = np.sqrt(np.einsum("jii->ji", told.shape_m2))
    half = np.fmin(half, told.bound_m[:, None])
    endless = doubted | ~np.isfinite(told.positions_in_room).all(axis=1)
    half = np.where(endless[:, None], np.inf, half)
    middle = np.where(endless[:, None], 0.0, told.positions_in_room)
    return Boxes(middle - half, middle + half)


def _doubted(told: FusedFrame, offsets: Iterable[Offset]) -> Flags:
    """(J,) joints that cameras put where their inertial neighbours cannot be."""
    doubted = np.zeros(JOINT_COUNT, dtype=bool)
    boxes = _boxes(told, doubted)
    for offset in offsets:
        a, b = offset.parent, offset.child
        apart = np.maximum(boxes.low[a] + offset.offset - boxes.high[b], boxes.low[b] - boxes.high[a] - offset.offset)
        if apart.max() > offset.tolerance_m and not (doubted[a] or doubted[b]):
            doubted[a if told.bound_m[a] > told.bound_m[b] else b] = True
    return doubted


def _shape(half: Floats, bound_m: Floats) -> Floats:
    """(J, 3, 3) m², the smaller of the ball and the ellipsoid around the box; NaN for a joint never seen."""
    is_ball = bound_m < np.linalg.norm(half, axis=1)
    squares = np.where(is_ball[:, None], bound_m[:, None] ** 2, 3 * half**2)
    return np.where(np.isfinite(bound_m), 1.0, np.nan)[:, None, None] * squares[:, :, None] * np.eye(3)


def _state(told: FusedFrame, sets: Cut) -> States:
    """What an inertial sensor or the tag follows is not lost, though no camera sees it."""
    followed = np.zeros(JOINT_COUNT, dtype=bool)
    followed[[place.joint for place in sets.places]] = True
    followed[[joint for rule in sets.offsets for joint in (rule.parent, rule.child)]] = True
    held = np.maximum(told.state, TrackingState.INFERRED)
    return np.where(followed & np.isfinite(told.bound_m), held, told.state).astype(np.uint8)


def _without(rules: Sequence[Kind], unused: Sequence[Rule]) -> tuple[Kind, ...]:
    return tuple(rule for rule in rules if rule not in unused)


def _refusals(sets: Cut) -> Iterator[Refusal]:
    for joint in np.flatnonzero(sets.doubted):
        yield Refusal(CAMERAS, int(joint), "not where the inertial sensors allow")
    for rule in sets.unused:
        if isinstance(rule, Place):
            yield Refusal(TAG, rule.joint, "does not meet the set")
        elif isinstance(rule, Offset):
            yield Refusal(INERTIAL, rule.child, "does not meet the set")
