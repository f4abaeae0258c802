"""A made-up person in front of two sensors at a right angle, for the estimators' tests."""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np

from fusion.compiled import Records
from fusion.estimation import motion_set
from fusion.messages import AlignedSample
from fusion.skeleton import INDEX, JOINT_COUNT

FRAME_S = 1 / 30
LENSES = {"front": np.array([0.0, 0.8, 0.0]), "side": np.array([2.5, 0.8, 2.5])}
FACING = {"front": np.eye(3), "side": np.array([[0.0, 0.0, -1.0], [0.0, 1.0, 0.0], [1.0, 0.0, 0.0]])}
WRIST, ELBOW, SHOULDER, HAND = (INDEX[name + "Right"] for name in ("Wrist", "Elbow", "Shoulder", "Hand"))


def body_at(t_s: float) -> np.ndarray:
    """(25, 3) m: joints spread over a person's size 2.5 m away; the right arm swings, its bones keep their length."""
    grid = np.linspace(-1, 1, JOINT_COUNT)
    positions = np.stack([0.3 * np.sin(7 * grid), 0.8 * grid + 0.8, 2.5 + 0.1 * np.cos(5 * grid)], axis=1)
    angle = 0.8 * np.sin(1.5 * t_s)
    along = np.array([np.sin(angle), -np.cos(angle), 0.0])
    positions[SHOULDER] = (0.2, 1.3, 2.5)
    for joint, length in ((ELBOW, 0.3), (WRIST, 0.55), (HAND, 0.63)):
        positions[joint] = positions[SHOULDER] + length * along
    return positions


def sample_at(
    t_s: float, sensor: str = "front", noise_m: float = 0.0, rng: np.random.Generator | None = None
) -> AlignedSample:
    """What a sensor sees of `body_at`, every joint tracked, each axis off by at most `noise_m`."""
    positions = body_at(t_s)
    if rng is not None:
        positions = positions + rng.uniform(-noise_m, noise_m, positions.shape)
    state = np.full(JOINT_COUNT, 2, np.uint8)
    return AlignedSample(sensor, t_s, t_s, positions, state, LENSES[sensor], FACING[sensor])


def both(seconds: float, noise_m: float = 0.02, seed: int = 1) -> Iterator[AlignedSample]:
    """Both sensors at 30 Hz, half a frame apart, in time order."""
    rng = np.random.default_rng(seed)
    for k in range(round(seconds * 30)):
        yield sample_at(k * FRAME_S, "front", noise_m, rng)
        yield sample_at((k + 0.5) * FRAME_S, "side", noise_m, rng)


def changed(sample: AlignedSample, joints: object, by_m: object = 0.0, state: int | None = None) -> AlignedSample:
    """The same sample with some joints moved, and their state set."""
    positions, states = sample.positions_in_room.copy(), sample.state.copy()
    positions[joints] += by_m
    if state is not None:
        states[joints] = state
    return AlignedSample(
        sample.sensor,
        sample.t_s,
        sample.t_received_s,
        positions,
        states,
        sample.lens_in_room,
        sample.rotation_sensor_to_room,
    )


def extents(joints: Records) -> tuple[np.ndarray, np.ndarray]:
    """(J, 3) m, the least and greatest position that is still possible."""
    pairs = np.array([[motion_set.extent(joint, k) for k in range(3)] for joint in joints])
    return pairs[..., 0], pairs[..., 1]
