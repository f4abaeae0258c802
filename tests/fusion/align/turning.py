"""A person who turns and walks, and sensors that take every back for a front, for the tests of left and right."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass

import numpy as np
from scipy.spatial.transform import Rotation

from fusion.messages import AlignedSample
from fusion.skeleton import INDEX, JOINT_COUNT, SIDES_SWAPPED

TRACKED = np.full(JOINT_COUNT, 2, dtype=np.uint8)
LENSES = {"front": np.array([0.0, 0.3, -2.5]), "right": np.array([2.5, 0.3, -0.3])}
"""Two sensors nearly at right angles about a person at the origin who faces the first one at ψ = π."""
PERIOD_S = 1 / 30


@dataclass(frozen=True)
class Seen:
    """A frame, and the body as it is, with its true names."""

    frame: AlignedSample
    body: np.ndarray


def sample(sensor, t_s, positions, lens=LENSES["front"]):
    """A frame in the room, every joint tracked."""
    return AlignedSample(sensor, t_s, t_s, positions, TRACKED, lens, np.eye(3))


def turned(body, facing_rad, place=(0.0, 0.0)):
    """A body that faced −z, facing ψ (0 along z, positive towards x), at a place (x, z)."""
    facing = Rotation.from_euler("y", facing_rad - np.pi)
    return facing.apply(body) + np.array([place[0], 0.0, place[1]])


def as_a_kinect_names(body, lens):
    """Left and right exchanged where the back is seen."""
    across = body[INDEX["ShoulderRight"]] - body[INDEX["ShoulderLeft"]]
    facing = np.cross([0.0, 1.0, 0.0], across)
    return body if facing @ (lens - body[INDEX["SpineBase"]]) > 0 else body[SIDES_SWAPPED]


def watched(body, path, length_s, sensors=("front", "right"), names=as_a_kinect_names, noise_m=0.0) -> Iterator[Seen]:
    """Frames of the sensors in turn while the body follows `path(t) = (facing, (x, z))`."""
    rng = np.random.default_rng(4)
    for k in range(int(length_s / PERIOD_S)):
        for n, sensor in enumerate(sensors):
            t_s = (k + n / len(sensors)) * PERIOD_S
            now = turned(body, *path(t_s))
            shown = names(now, LENSES[sensor]) + rng.normal(0.0, noise_m, now.shape)
            yield Seen(sample(sensor, t_s, shown, LENSES[sensor]), now)


def rightly_named(frame, body):
    """Whether a frame's shoulder line points as the body's, not against it."""
    left, right = INDEX["ShoulderLeft"], INDEX["ShoulderRight"]
    ours, true = (p[right] - p[left] for p in (frame.positions_in_room, body))
    return bool(ours[[0, 2]] @ true[[0, 2]] > 0)
