"""How far a shoulder that nobody hitches rises with its arm, and what is left of it where that is taken off."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from fusion.kinematics.shoulder import NATURAL_RISE_M
from fusion.messages import Floats
from fusion.metrics.record import JOINTS, SessionRecord

ELEVATION = JOINTS.index("elevation")


@dataclass(frozen=True, slots=True)
class Rise:
    """Of one recording."""

    recording: str
    elevation_rad: tuple[float, float]
    """2nd and 98th percentile of the true arm's."""
    true_m: float
    """Range of the true shoulder's height, from percentile to percentile."""
    told_m: float
    """The most that the fused shoulder seemed to rise after the session's beginning, nothing taken off."""
    left_m: float
    """The same as `shoulder_hitch` tells it."""


def rise_of(name: str, told: SessionRecord, true: SessionRecord) -> Rise:
    """Told and true session of one recording."""
    low, high = np.nanpercentile(true.healthy_rad[:, ELEVATION], [2, 98])
    bottom, top = np.nanpercentile(whole_rise_m(true), [2, 98])
    return Rise(name, (float(low), float(high)), float(top - bottom), _most(whole_rise_m(told)), _most(_hitch_m(told)))


def fitted_rise_m(sessions: Sequence[SessionRecord]) -> float:
    """The factor of 1 − cos elevation that fits all sessions' shoulders best, each about its own mean."""
    parts = [(_lift(one), whole_rise_m(one)) for one in sessions]
    known = [np.isfinite(lift) & np.isfinite(rise) for lift, rise in parts]
    lifts = np.concatenate([lift[k] - lift[k].mean() for (lift, _), k in zip(parts, known, strict=True)])
    rises = np.concatenate([rise[k] - rise[k].mean() for (_, rise), k in zip(parts, known, strict=True)])
    return float(lifts @ rises / (lifts @ lifts))


def whole_rise_m(session: SessionRecord) -> Floats:
    """(T,) the shoulder's rise since the session began, with what the arm's elevation brings with it."""
    lift = _lift(session)
    rise: Floats = _hitch_m(session) + NATURAL_RISE_M * (lift - lift[np.flatnonzero(np.isfinite(lift))[0]])
    return rise


def _lift(session: SessionRecord) -> Floats:
    lift: Floats = 1.0 - np.cos(session.healthy_rad[:, ELEVATION])
    return lift


def _hitch_m(session: SessionRecord) -> Floats:
    return np.full(len(session.t_s), np.nan) if session.shoulder_hitch_m is None else session.shoulder_hitch_m


def _most(rise_m: Floats) -> float:
    return float(np.nanmax(rise_m))
