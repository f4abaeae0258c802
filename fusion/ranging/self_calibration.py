"""The link model from the ranges alone, with no known position of any tag."""

from __future__ import annotations

from dataclasses import replace
from typing import Final

import numpy as np

from fusion.errors import InputError
from fusion.messages import Floats
from fusion.ranging.calibration import Calibration, calibrate
from fusion.ranging.ranges import Ranges

WINDOW_S: Final = 0.1
ROUNDS: Final = 30
SMOOTH: Final = 7
"""Windows over which the positions are averaged before they teach."""
EXPECTED_BIAS_M: Final = 0.3
"""How large a bias may be; holds what the ranges alone leave open."""
LEAST_ANCHORS: Final = 4
LEFT_OPEN_M: Final = 0.1
"""What the biases found this way may still be off by, per link; half of what they may be unlearnt."""


def self_calibrate(ranges: Ranges, height_m: float) -> Calibration:
    """Find every link's bias and, beside, where each tag was, so that both explain the ranges.

    With p the positions and b the biases of one tag, min Σ (r − |p − a| − b)² + λ Σ b²: Gauss-Newton in which each
    instant's position is eliminated, M = I − U (U'U)⁻¹ U' with the unit vectors U. Then the positions, smoothed, stand
    in for the truth once, which brings what grows with distance and the antennas' patterns. A lag moves everything
    alike and cannot be found this way; nor can a rig.

    Raises:
        InputError: fewer than four anchors: three ranges and two unknowns leave one equation for three biases.
    """
    if len(ranges.anchors) < LEAST_ANCHORS:
        raise InputError("three anchors cannot calibrate themselves", "four or more", "use --calibrate with truth")
    t_s, medians = _medians(ranges)
    found = [_smoothed(_of_one_tag(ranges.anchors, medians[:, :, k], height_m)) for k in range(medians.shape[2])]
    positions = np.stack([np.column_stack([flat, np.full(len(flat), height_m)]) for flat in found], axis=1)
    links = calibrate(ranges, t_s, positions).links
    return Calibration(replace(links, wander_m=LEFT_OPEN_M))


def _medians(ranges: Ranges) -> tuple[Floats, Floats]:
    """Times (W,) and links' medians (W, A, K) over a tenth of a second, which no single wrong echo moves."""
    window = np.floor((ranges.t_s - ranges.t_s[0]) / WINDOW_S).astype(np.int64)
    parts = [(ranges.t_s[window == w].mean(), ranges.range_m[window == w]) for w in np.unique(window)]
    whole = [(t_s, part) for t_s, part in parts if np.isfinite(part).any(axis=0).all()]
    if not whole:
        raise InputError("no instant has ranges of every link", "all anchors in sight", "calibrate for longer")
    return np.array([t_s for t_s, _ in whole]), np.array([np.nanmedian(part, axis=0) for _, part in whole])


def _smoothed(flat: Floats) -> Floats:
    """Means over SMOOTH windows, (W, 2)."""
    padded = np.pad(flat, ((SMOOTH // 2, SMOOTH // 2), (0, 0)), mode="edge")
    return np.stack([np.convolve(column, np.ones(SMOOTH) / SMOOTH, "valid") for column in padded.T], axis=-1)


def _of_one_tag(anchors: Floats, range_m: Floats, height_m: float) -> Floats:  # (W, 2)
    positions = np.tile(anchors[:, :2].mean(axis=0), (len(range_m), 1))
    bias = np.zeros(len(anchors))
    for _ in range(ROUNDS):
        away = np.concatenate([positions, np.full((len(positions), 1), height_m)], axis=1)[:, None] - anchors
        distance = np.linalg.norm(away, axis=-1)  # (W, A)
        unit = away[..., :2] / distance[..., None]
        left = range_m - distance
        to_position = np.linalg.pinv(unit)  # (W, 2, A)
        free = np.eye(len(anchors)) - unit @ to_position
        weight = 1e-3 * len(range_m) / EXPECTED_BIAS_M**2 * np.eye(len(anchors))
        bias = np.linalg.solve(free.sum(axis=0) + weight, np.einsum("wij,wj->i", free, left))
        positions = positions + np.einsum("wia,wa->wi", to_position, left - bias)
    return positions
