"""What some seconds of truth teach: the links' biases, the ranges' common time lag, how the tags are mounted."""

from __future__ import annotations

from dataclasses import dataclass, replace
from typing import Final

import numpy as np

from fusion.messages import Floats
from fusion.ranging.link_fit import coherence_s, fit_links
from fusion.ranging.links import LinkModel, growth, harmonics, unknown_links
from fusion.ranging.ranges import Ranges, interpolated
from fusion.ranging.rig import Rig, learn_rig
from fusion.ranging.travel import directions

MOST_INSTANTS: Final = 400
"""Enough for a fit: neighbouring ranges err alike."""
LAG_S: Final = 0.05
"""What is plausible of a lag (one sigma)."""
LAGS_S: Final = np.arange(-0.2, 0.3001, 0.02)


@dataclass(frozen=True, slots=True)
class Calibration:
    """What is known before the first range is used."""

    links: LinkModel
    lag_s: float = 0.0
    """A range stamped t was true at t + lag on the truth's clock."""
    rig: Rig | None = None
    """None where each tag moves on its own."""


@dataclass(frozen=True, slots=True)
class _Seen:
    """What the ranges of some seconds should have been, had they a lag; (E, A, K) each."""

    excess: Floats
    distance: Floats
    bearing: Floats


def uncalibrated(ranges: Ranges) -> Calibration:
    """No truth: no biases, no lag, every tag on its own."""
    return Calibration(unknown_links(*ranges.range_m.shape[1:]))


def calibrate(ranges: Ranges, truth_t_s: Floats, truth: Floats) -> Calibration:
    """Learn from true positions.

    The lag is the most plausible with its best link model, on a grid refined by a parabola. It is loosely determined:
    on something that drives straight ahead, a lag and an antenna that sits further ahead look the same.

    Args:
        ranges: of the same seconds as the truth; others are left alone.
        truth_t_s: (T,) rising.
        truth: (T, K, 3) m, NaN where unknown.

    Raises:
        InputError: a link has no range while there is truth.
    """
    step = max(1, len(ranges.t_s) // MOST_INSTANTS)
    thinned = Ranges(ranges.anchors, ranges.t_s[::step], ranges.range_m[::step])
    rig = learn_rig(truth[:: max(1, len(truth) // MOST_INSTANTS)])
    seen = [_seen(thinned, truth_t_s, truth, rig, lag) for lag in LAGS_S]
    costs = np.array([fit_links(s.excess, s.distance, s.bearing).cost for s in seen])
    lag_s = _lowest(LAGS_S, costs + (LAGS_S / LAG_S) ** 2)
    now = _seen(thinned, truth_t_s, truth, rig, lag_s)
    links = fit_links(now.excess, now.distance, now.bearing).links
    return Calibration(_with_coherence(links, ranges, _seen(ranges, truth_t_s, truth, rig, lag_s)), lag_s, rig)


def _lowest(at: Floats, values: Floats) -> float:
    """Where the parabola through the least value and its neighbours has its foot."""
    i = int(np.clip(values.argmin(), 1, len(at) - 2))
    before, here, after = values[i - 1 : i + 2]
    bend = before - 2 * here + after
    shift = 0.5 * (before - after) / bend if bend > 0 else 0.0
    return float(at[i] + np.clip(shift, -1, 1) * (at[1] - at[0]))


def _seen(ranges: Ranges, truth_t_s: Floats, truth: Floats, rig: Rig | None, lag_s: float) -> _Seen:
    at_s = ranges.t_s + lag_s
    positions = interpolated(truth_t_s, truth, at_s)  # (E, K, 3)
    from_anchor = positions[:, None] - ranges.anchors[None, :, None]  # (E, A, K, 3)
    distance = np.linalg.norm(from_anchor, axis=-1)
    to_anchor = np.arctan2(-from_anchor[..., 1], -from_anchor[..., 0])
    points = directions(truth_t_s, truth, at_s) if rig is None else _yaws(rig, positions)[:, None]
    return _Seen(ranges.range_m - distance, distance, to_anchor - points[:, None])


def _yaws(rig: Rig, positions: Floats) -> Floats:  # (E,)
    known = np.isfinite(positions).all(axis=(1, 2))
    yaws = np.full(len(positions), np.nan)
    yaws[known] = [rig.pose(tags)[1] for tags in positions[known]]
    return yaws


def _with_coherence(links: LinkModel, ranges: Ranges, seen: _Seen) -> LinkModel:
    pattern = np.einsum("eakm,km->eak", np.nan_to_num(harmonics(seen.bearing)), links.pattern_m)
    left = seen.excess - links.bias_m - growth(seen.distance) @ links.growth_m - pattern
    step_s = float(ranges.t_s[-1] - ranges.t_s[0]) / max(len(ranges.t_s) - 1, 1)
    return replace(links, coherence_s=coherence_s(left.reshape(len(left), -1), step_s))
