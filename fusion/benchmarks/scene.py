"""Made-up samples of any number of joints and sensors, for timing: a body that sways, seen from all round."""

from __future__ import annotations

from collections.abc import Iterator
from math import cos, pi, sin
from typing import Final

import numpy as np

from fusion.messages import AlignedSample, Floats
from fusion.skeleton import TrackingState

FRAME_S: Final = 1 / 30
NOISE_M: Final = 0.01
DISTANCE_M: Final = 2.0


def frames(joints: int, sensors: int, seed: int = 1) -> Iterator[tuple[AlignedSample, ...]]:
    """For ever: one sample of each sensor, spread evenly over a frame of 1/30 s."""
    rng = np.random.default_rng(seed)
    rest = np.stack([0.3 * rng.uniform(-1, 1, joints), np.linspace(0.1, 1.7, joints), np.full(joints, 2.5)], axis=1)
    state = np.full(joints, TrackingState.TRACKED, np.uint8)
    poses = [_pose(k, sensors) for k in range(sensors)]
    number = 0
    while True:
        times_s = [(number + k / sensors) * FRAME_S for k in range(sensors)]
        yield tuple(
            AlignedSample(f"sensor-{k + 1}", t_s, t_s, _seen(rest, t_s, rng), state, *poses[k])
            for k, t_s in enumerate(times_s)
        )
        number += 1


def _pose(number: int, sensors: int) -> tuple[Floats, Floats]:
    """Where a sensor stands, and its rotation to the room; it looks at the body from its side of the circle."""
    angle = 2 * pi * number / max(sensors, 2) / 2
    lens = np.array([DISTANCE_M * sin(angle), 0.8, 2.5 - DISTANCE_M * cos(angle)])
    turn = np.array([[cos(angle), 0.0, -sin(angle)], [0.0, 1.0, 0.0], [sin(angle), 0.0, cos(angle)]])
    return lens, turn


def _seen(rest: Floats, t_s: float, rng: np.random.Generator) -> Floats:
    return rest + 0.2 * sin(2.0 * t_s) + rng.normal(0.0, NOISE_M, rest.shape)
