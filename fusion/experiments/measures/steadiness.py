"""How steady a body is told: whether bones keep their lengths, and how much joints tremble while somebody stands."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Final

import numpy as np
from scipy.signal import butter, sosfiltfilt

from fusion.experiments.measures.scene import Scene, seen_alone, told
from fusion.experiments.measures.standing import SETTLE_S, standing_stretches
from fusion.messages import Floats
from fusion.offline import GRID_HZ
from fusion.skeleton import arm

ABOVE_HZ: Final = 5.0
"""No arm is moved on purpose faster than this."""
FILTER_ORDER: Final = 4


@dataclass(frozen=True, slots=True)
class Steadiness:
    """One way to see the healthy arm."""

    name: str
    """The method's or the sensor's."""
    bone_std_m: float
    """Standard deviation of the upper arm's and the forearm's length (root mean square of both)."""
    jitter_m: float
    """Root mean square of shoulder, elbow and wrist above 5 Hz while standing; NaN where nobody stands."""


def steadiness(scene: Scene, method: str) -> tuple[Steadiness, ...]:
    """The method first, then every sensor alone, over the instants at which all sensors see the arm."""
    joints = list(arm(scene.healthy_side)[:3])
    alone = {sensor: seen_alone(scene, sensor)[0] for sensor in scene.alignments}
    tracks = {method: told(scene, method)[0].positions} | alone
    seen = scene.t_s >= scene.t_s[0] + SETTLE_S
    for positions in alone.values():
        seen = seen & np.isfinite(positions[:, joints]).all(axis=(1, 2))
    stretches = standing_stretches(scene)
    return tuple(
        Steadiness(name, bone_std_m(track[seen][:, joints]), jitter_m(track[:, joints], stretches))
        for name, track in tracks.items()
    )


def bone_std_m(chain: Floats) -> float:
    """How much the bones of a chain of joints (T, N, 3) vary in length: root mean square over the bones, m."""
    lengths = np.linalg.norm(np.diff(chain, axis=1), axis=2)
    return float(np.sqrt(np.mean(lengths.std(axis=0) ** 2)))


def jitter_m(positions: Floats, stretches: Sequence[slice]) -> float:
    """Root mean square of what moves faster than 5 Hz, m.

    Args:
        positions: (T, N, 3) m on a 30 Hz grid.
        stretches: of the grid; a joint not known throughout one is left out there.
    """
    high = butter(FILTER_ORDER, ABOVE_HZ, "highpass", fs=GRID_HZ, output="sos")
    squares = [np.zeros(0)]
    for stretch in stretches:
        known = np.isfinite(positions[stretch]).all(axis=(0, 2))
        fast = sosfiltfilt(high, positions[stretch][:, known], axis=0)
        squares.append(np.sum(fast**2, axis=2).ravel())
    every = np.concatenate(squares)
    return float(np.sqrt(every.mean())) if len(every) else float("nan")
