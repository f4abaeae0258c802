"""Boxes that hold the joints, and the cuts that what is known of a body makes in them.

Interval analysis (Jaulin, Kieffer, Didrit, Walter: Applied Interval Analysis, Springer 2001, ch. 4): a contractor takes
boxes and returns boxes inside them that still hold every body that was in them and obeys its rule. Contractors are
monotone: smaller boxes in, smaller boxes out. So another piece of evidence never widens a set, and one that falls
silent widens it and nothing else. A cut that would leave nothing is not made, and is told.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from fusion.joined.contractors import DISTANCE, OFFSET, PLACE, contract
from fusion.messages import Floats
from fusion.skeleton import JOINT_COUNT


@dataclass(frozen=True, slots=True)
class Boxes:
    """Each joint lies in low..high on each of the room's axes; ±inf where nothing is known."""

    low: Floats  # (J, 3) m
    high: Floats  # (J, 3) m


@dataclass(frozen=True, slots=True, eq=False)
class Offset:
    """A bone whose vector is known: child = parent + `offset` + e with |e| <= `tolerance_m`."""

    parent: int
    child: int
    offset: Floats  # (3,) m in room
    tolerance_m: float


@dataclass(frozen=True, slots=True, eq=False)
class Distance:
    """Two joints whose distance is known to lie in `least_m`..`most_m`."""

    first: int
    second: int
    least_m: float
    most_m: float


@dataclass(frozen=True, slots=True, eq=False)
class Place:
    """A joint that lies within `tolerance_m` of a position."""

    joint: int
    position: Floats  # (3,) m in room
    tolerance_m: float


Rule = Offset | Distance | Place


def anywhere() -> Boxes:
    """Nothing known."""
    endless = np.full((JOINT_COUNT, 3), np.inf)
    return Boxes(-endless, endless)


def contracted(boxes: Boxes, rules: Sequence[Rule], sweeps: int = 2) -> tuple[Boxes, tuple[Rule, ...]]:
    """Apply all rules, forth and back, `sweeps` times.

    Returns:
        The boxes, and the rules that would have left nothing and were therefore not used.
    """
    if not rules:
        return boxes, ()
    low, high = boxes.low.copy(), boxes.high.copy()
    kind, joints, vector, limits = (np.array(column) for column in zip(*map(_row, rules), strict=True))
    unused = contract(low, high, kind, joints, vector, limits, sweeps)
    return Boxes(low, high), tuple(rule for rule, left_out in zip(rules, unused.tolist(), strict=True) if left_out)


def _row(rule: Rule) -> tuple[int, tuple[int, int], Sequence[float] | Floats, tuple[float, float]]:
    """A rule as `contract` takes it."""
    if isinstance(rule, Place):
        return PLACE, (rule.joint, rule.joint), rule.position, (0.0, rule.tolerance_m)
    if isinstance(rule, Offset):
        return OFFSET, (rule.parent, rule.child), rule.offset, (0.0, rule.tolerance_m)
    return DISTANCE, (rule.first, rule.second), (0.0, 0.0, 0.0), (rule.least_m, rule.most_m)
