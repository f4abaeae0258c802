"""The workspace of a session's games: what the healthy arm has shown, inside the limits, pushed gently outwards."""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from math import radians

from db.exercise import PlayedExercise
from db.limits import JointRange, PassiveRange
from db.workspace import SessionWorkspace
from games.difficulty import SUCCESS_WANTED
from server.messages import EXO_JOINTS, JointLimits

PUSHED_RAD = radians(3.0)
"""Every end moves outwards by this much in a session after one that succeeded."""
SUCCEEDED = SUCCESS_WANTED - 0.05
"""Share of successful attempts from which a session has succeeded; the games themselves aim at `SUCCESS_WANTED`."""
LEAST_ATTEMPTS = 20
"""Fewer tell nothing."""
LEAST_SPAN_RAD = radians(15.0)
"""A joint that has shown less gets this much about its middle: in a single pose there is no game."""

Ends = tuple[float, float]


def succeeded(played: Iterable[PlayedExercise]) -> bool:
    """Whether a session went so well that a little more may be asked for."""
    counted = [(one.hits, one.misses) for one in played]
    hits, misses = sum(hit for hit, _ in counted), sum(miss for _, miss in counted)
    return hits + misses >= LEAST_ATTEMPTS and hits >= SUCCEEDED * (hits + misses)


def inside(limits: Iterable[JointLimits], margin_rad: float) -> PassiveRange:
    """The limits less the margin that commands keep of them; the middle where nothing is left of a joint."""
    return _range({joint.joint: _less(joint, margin_rad) for joint in limits})


def first_workspace(
    last: SessionWorkspace | None, played: Iterable[PlayedExercise], allowed: PassiveRange
) -> SessionWorkspace:
    """What a session begins with: the last one's, else all that is allowed.

    Args:
        last: the workspace of the patient's last session.
        played: what became of that session.
        allowed: the limits less what commands keep of them.
    """
    pushed = succeeded(played)
    if last is None or last.source == "limits":
        return SessionWorkspace(source="limits", pushed=pushed, used=allowed)
    return SessionWorkspace(source="last", pushed=pushed, used=_within(last.used, pushed, allowed))


def shown_workspace(shown: PassiveRange, begun: SessionWorkspace, allowed: PassiveRange) -> SessionWorkspace:
    """What the healthy arm has shown, in place of what the session began with."""
    used = _within(shown, begun.pushed, allowed)
    return SessionWorkspace(source="shown", shown=shown, pushed=begun.pushed, used=used)


def _within(wanted: PassiveRange, pushed: bool, allowed: PassiveRange) -> PassiveRange:
    push_rad = PUSHED_RAD if pushed else 0.0
    return _range({name: _clipped(_widened(ends(wanted, name), push_rad), ends(allowed, name)) for name in EXO_JOINTS})


def _widened(shown: Ends, push_rad: float) -> Ends:
    missing_rad = max(0.0, LEAST_SPAN_RAD - (shown[1] - shown[0])) / 2
    return shown[0] - missing_rad - push_rad, shown[1] + missing_rad + push_rad


def _clipped(wanted: Ends, allowed: Ends) -> Ends:
    """The part of `wanted` that is allowed, widened to the least range, or to all that is allowed if that is less."""
    low = min(max(wanted[0], allowed[0]), max(allowed[1] - LEAST_SPAN_RAD, allowed[0]))
    return low, max(min(wanted[1], allowed[1]), min(low + LEAST_SPAN_RAD, allowed[1]))


def _less(joint: JointLimits, margin_rad: float) -> Ends:
    low, high = joint.min_rad + margin_rad, joint.max_rad - margin_rad
    if low < high:
        return low, high
    middle = (joint.min_rad + joint.max_rad) / 2
    return middle - SLIGHT_RAD, middle + SLIGHT_RAD


SLIGHT_RAD = 1e-3
"""Half of the range of a joint that has none: a range may not be empty."""


def ends(ranges: PassiveRange, joint: str) -> Ends:
    """Both ends of a joint's range."""
    found: JointRange = getattr(ranges, joint)
    return found.min_rad, found.max_rad


def _range(joints: Mapping[str, Ends]) -> PassiveRange:
    return PassiveRange(**{name: JointRange(min_rad=low, max_rad=high) for name, (low, high) in joints.items()})
