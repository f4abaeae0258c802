"""What some seconds of truth teach: the links' biases, the ranges' common time lag, how the tags are mounted."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Final

import numpy as np

from fusion.errors import InputError
from fusion.messages import Floats
from fusion.ranging.links import HARMONICS, LinkModel, harmonics, unknown_links
from fusion.ranging.ranges import Ranges
from fusion.ranging.rig import Rig, learn_rig

OUTLIER_M: Final = 0.4
MOST_INSTANTS: Final = 1500
SHRINK: Final = 0.1
"""Ridge on the pattern, per row: some seconds visit few bearings, and what they do not show is better thought small."""
LAGS_S: Final = np.arange(-0.2, 0.3001, 0.02)
LEAST_SIGMA_M: Final = 0.03


@dataclass(frozen=True, slots=True)
class Calibration:
    """What is known before the first range is used."""

    links: LinkModel
    lag_s: float = 0.0
    """A range stamped t was true at t + lag on the truth's clock."""
    rig: Rig | None = None
    """None where each tag moves on its own."""


def uncalibrated(ranges: Ranges) -> Calibration:
    """No truth: no biases, no lag, every tag on its own."""
    return Calibration(unknown_links(*ranges.range_m.shape[1:]))


def calibrate(ranges: Ranges, truth_t_s: Floats, truth: Floats) -> Calibration:
    """Learn from true positions.

    The lag is where the link model leaves least, on a grid refined by a parabola. It is loosely determined: on
    something that drives straight ahead, a lag and an antenna that sits further ahead look the same (docs/ranging.md).

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
    left = np.array([_learn(thinned, truth_t_s, truth, rig, lag)[1] for lag in LAGS_S])
    lag_s = _lowest(LAGS_S, left)
    return Calibration(_learn(thinned, truth_t_s, truth, rig, lag_s)[0], lag_s, rig)


def _lowest(at: Floats, values: Floats) -> float:
    """Where the parabola through the least value and its neighbours has its foot."""
    i = int(np.clip(values.argmin(), 1, len(at) - 2))
    before, here, after = values[i - 1 : i + 2]
    bend = before - 2 * here + after
    shift = 0.5 * (before - after) / bend if bend > 0 else 0.0
    return float(at[i] + np.clip(shift, -1, 1) * (at[1] - at[0]))


def _learn(ranges: Ranges, truth_t_s: Floats, truth: Floats, rig: Rig | None, lag_s: float) -> tuple[LinkModel, float]:
    """Least squares per tag for the link model at one lag; and the deviation of what it leaves."""
    positions = interpolated(truth_t_s, truth, ranges.t_s + lag_s)  # (E, K, 3)
    from_anchor = positions[:, None] - ranges.anchors[None, :, None]  # (E, A, K, 3)
    excess = ranges.range_m - np.linalg.norm(from_anchor, axis=-1)
    bearing = _bearings(from_anchor, positions, rig)
    tags = [_learn_tag(excess[..., k], None if rig is None else bearing[..., k]) for k in range(positions.shape[1])]
    residual = np.stack([left for _, _, left in tags], axis=-1)
    bias, pattern = np.stack([b for b, _, _ in tags], axis=-1), np.stack([p for _, p, _ in tags])
    left_m = float(np.nanstd(residual))
    sigma = max(left_m, LEAST_SIGMA_M)
    # Means over a second waver by 0.6 sigma in the seconds learnt from, and by more where nothing was learnt.
    return LinkModel(bias, pattern, sigma, wander_m=sigma), left_m


def _bearings(from_anchor: Floats, positions: Floats, rig: Rig | None) -> Floats:  # (E, A, K)
    to_anchor = np.arctan2(-from_anchor[..., 1], -from_anchor[..., 0])
    if rig is None:
        return to_anchor
    known = np.isfinite(positions).all(axis=(1, 2))
    yaws = np.full(len(positions), np.nan)
    yaws[known] = [rig.pose(tags)[1] for tags in positions[known]]
    return np.asarray(to_anchor - yaws[:, None, None])


def _learn_tag(excess: Floats, bearing: Floats | None) -> tuple[Floats, Floats, Floats]:
    """Biases (A,), pattern (2 · HARMONICS,) and what is left (E, A), NaN where it was not used."""
    anchors = excess.shape[1]
    if not np.isfinite(excess).any(axis=0).all():
        raise InputError("a link has no range while there is truth", "ranges of every link", "calibrate for longer")
    near = np.abs(excess - np.nanmedian(excess, axis=0)) < OUTLIER_M
    if bearing is not None:
        near &= np.isfinite(bearing)
    _, link = np.nonzero(near)
    waves = np.zeros((len(link), 2 * HARMONICS)) if bearing is None else harmonics(bearing[near])
    rows = np.hstack([np.eye(anchors)[link], waves])
    ridge = np.concatenate([np.full(anchors, 1e-6), np.full(2 * HARMONICS, SHRINK * len(link) + 1e-6)])
    solved = np.linalg.solve(rows.T @ rows + np.diag(ridge), rows.T @ excess[near])
    left = np.full(excess.shape, np.nan)
    left[near] = excess[near] - rows @ solved
    return np.asarray(solved[:anchors]), np.asarray(solved[anchors:]), left


def interpolated(t_s: Floats, positions: Floats, at_s: Floats) -> Floats:
    """Positions (T, K, 3) at other instants, (N, K, 3); NaN outside and where the truth is."""
    flat = positions.reshape(len(t_s), -1)
    columns = [np.interp(at_s, t_s, column, left=np.nan, right=np.nan) for column in flat.T]
    return np.stack(columns, axis=-1).reshape(len(at_s), *positions.shape[1:])
