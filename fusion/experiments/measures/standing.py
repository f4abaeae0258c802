"""When somebody stands: the spine hardly moves, and every sensor sees it."""

from __future__ import annotations

from typing import Final

import numpy as np
from numpy.typing import NDArray

from fusion.experiments.measures.scene import Scene, seen_alone
from fusion.messages import Floats
from fusion.skeleton import INDEX

SPINE: Final = [INDEX[name] for name in ("SpineBase", "SpineMid", "SpineShoulder")]
SPAN_S: Final = 0.5
"""The speed is taken over this long, so that noise is no walk."""
SLOW_M_S: Final = 0.15
SETTLE_S: Final = 2.0
"""Filters settle and bones are learnt: not looked at."""
SHORTEST_S: Final = 1.0


def standing_stretches(scene: Scene) -> tuple[slice, ...]:
    """Stretches of the grid of at least a second in which the patient stands and every sensor sees them.

    The spine is the mean of what the sensors say, so no estimator has a word in it.
    """
    t_s, step_s = scene.t_s, float(scene.t_s[1] - scene.t_s[0])
    spine = np.mean([seen_alone(scene, sensor)[0][:, SPINE].mean(axis=1) for sensor in scene.alignments], axis=0)
    stands = (_speed(spine, step_s) < SLOW_M_S) & (t_s >= t_s[0] + SETTLE_S)  # not seen: NaN, which is not slow
    return tuple(part for part in runs_of(stands) if (part.stop - part.start) * step_s >= SHORTEST_S)


def runs_of(flags: NDArray[np.bool_]) -> tuple[slice, ...]:
    """Runs of true values, as slices."""
    edges = np.flatnonzero(np.diff(np.concatenate([[False], flags, [False]]).astype(np.int8)))
    return tuple(slice(int(a), int(b)) for a, b in zip(edges[::2], edges[1::2], strict=True))


def _speed(positions: Floats, step_s: float) -> Floats:
    """(T,) m/s of (T, 3) over `SPAN_S` around each instant; NaN at the ends."""
    half = max(1, round(SPAN_S / 2 / step_s))
    speed = np.full(len(positions), np.nan)
    speed[half:-half] = np.linalg.norm(positions[2 * half :] - positions[: -2 * half], axis=1) / (2 * half * step_s)
    return speed
