"""Whether a patient's figure has changed over the sessions by more than chance."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from enum import StrEnum

from fusion.metrics.measure import Better, Measure, Trust
from fusion.metrics.metric import PASSIVE_DRIVE
from fusion.metrics.uncertainty import minimal_detectable_change


class Verdict(StrEnum):
    """What can be said of the change from the first session to the last."""

    BETTER = "better"
    WORSE = "worse"
    CHANGED = "changed"
    """By more than chance, where neither direction is better."""
    UNCHANGED = "unchanged"
    """Not by more than chance."""
    UNKNOWN = "unknown"
    """Too few sessions, nobody knows how sure they are, or the figure cannot carry a verdict."""


@dataclass(frozen=True, slots=True)
class SessionValue:
    """A figure in one session."""

    value: float
    sem: float | None = None
    caveat_key: str | None = None


@dataclass(frozen=True, slots=True)
class Change:
    """A figure from the first session to the last."""

    difference: float | None
    """Last minus first; None with fewer than two sessions."""
    mdc: float | None
    """The least difference that is more than chance: published, or else from the sessions themselves."""
    verdict: Verdict


def change_of(measure: Measure, values: Sequence[SessionValue]) -> Change:
    """What became of a measure over a patient's sessions, in the order of time.

    No verdict is given on what the drive did, nor on what these sensors measure poorly.
    """
    own = minimal_detectable_change((one.sem for one in values), measure.camera_error)
    mdc = own if measure.mdc is None else measure.mdc.value
    if len(values) < 2:
        return Change(None, mdc, Verdict.UNKNOWN)
    difference = values[-1].value - values[0].value
    driven = any(one.caveat_key == PASSIVE_DRIVE for one in (values[0], values[-1]))
    if mdc is None or driven or measure.trust is Trust.POOR:
        return Change(difference, mdc, Verdict.UNKNOWN)
    return Change(difference, mdc, _verdict(measure.better, difference, mdc))


def _verdict(better: Better, difference: float, mdc: float) -> Verdict:
    if abs(difference) <= mdc:
        return Verdict.UNCHANGED
    if better is Better.NEITHER:
        return Verdict.CHANGED
    return Verdict.BETTER if (difference > 0) is (better is Better.MORE) else Verdict.WORSE
