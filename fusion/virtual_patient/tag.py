"""A radio tag at the virtual patient's waist and anchors on the walls, with ranges that err as real ones do."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Final

import numpy as np
from scipy.signal import lfilter
from scipy.spatial.transform import Rotation

from fusion.messages import Floats
from fusion.recording.recording import RangeStream
from fusion.skeleton import INDEX

TAG: Final = "waist"
ANCHORS_IN_WORLD: Final = np.array(
    [[-2.5, 2.2, -3.0], [2.5, 0.4, -3.0], [2.6, 2.3, 1.5], [-2.4, 0.3, 1.6], [0.2, 2.4, -3.2], [-2.6, 1.2, -0.5]]
)
"""(A, 3) m, y up: on the walls of a room, at heights that differ."""
_TURN_WORLD_TO_ANCHORS: Final = Rotation.from_euler("ZX", [0.6, np.pi / 2])
"""The surveyor's frame: z up, turned against the room; nobody tells anyone by how much."""
_ORIGIN_IN_ANCHORS_M: Final = np.array([3.0, 2.0, 0.0])
_BEHIND_M: Final = 0.1
"""The tag sits on the belt, behind SpineBase."""
_EVERY: Final = 5
"""An epoch per so many steps of the patient."""


@dataclass(frozen=True, slots=True)
class TagErrors:
    """One sigma of each error of a range; `fusion/ranging` found the like in `uwb-fast`."""

    bias_m: float = 0.10
    """Drawn once per link."""
    white_m: float = 0.04
    slow_m: float = 0.04
    """Changes within `slow_s`."""
    slow_s: float = 1.0
    blocked_share: float = 0.05
    """Share of the time that something stands between tag and anchor."""
    blocked_s: float = 2.0
    longer_m: float = 0.3
    """How much a blocked range is too long."""


def in_anchors(positions_in_world: Floats) -> Floats:
    """(..., 3) m in the anchors' frame, z up."""
    flat = positions_in_world.reshape(-1, 3)
    turned: Floats = _TURN_WORLD_TO_ANCHORS.apply(flat) + _ORIGIN_IN_ANCHORS_M
    return turned.reshape(positions_in_world.shape)


def tag_ranges(positions: Floats, trunk_backs: Floats, t_s: Floats, errors: TagErrors, seed: int) -> RangeStream:
    """The ranges of a tag worn at the waist.

    Args:
        positions: (T, 25, 3) m in the world, an even step apart.
        trunk_backs: (T, 3) unit vectors from the chest to the back.
        t_s: (T,).
        errors: of the ranges.
        seed: of everything random.
    """
    rng = np.random.default_rng([seed, 99])
    tag = (positions[:, INDEX["SpineBase"]] + _BEHIND_M * trunk_backs)[::_EVERY]
    epochs_s, step_s = t_s[::_EVERY], _EVERY * float(t_s[1] - t_s[0])
    distance = np.linalg.norm(tag[:, None] - ANCHORS_IN_WORLD, axis=-1)  # (E, A)
    count, anchors = distance.shape
    measured = distance + _errors(rng, (count, anchors), step_s, errors)
    names = tuple(f"A{number}" for number in range(anchors))
    return RangeStream(
        names,
        in_anchors(ANCHORS_IN_WORLD),
        (TAG,),
        np.repeat(epochs_s, anchors),
        np.tile(np.arange(anchors), count),
        np.zeros(count * anchors, dtype=np.int64),
        np.maximum(measured, 0.0).ravel(),
    )


def _errors(rng: np.random.Generator, shape: tuple[int, int], step_s: float, errors: TagErrors) -> Floats:
    bias = rng.normal(0.0, errors.bias_m, shape[1])
    slow = errors.slow_m * _wandering(rng, shape, step_s / errors.slow_s)
    blocked = errors.longer_m * _blocked(rng, shape, step_s, errors)
    return bias + slow + blocked + rng.normal(0.0, errors.white_m, shape)


def _wandering(rng: np.random.Generator, shape: tuple[int, int], rate: float) -> Floats:
    """A first-order process of unit size along the first axis."""
    keep = float(np.exp(-rate))
    drive = np.sqrt(1 - keep**2) * rng.standard_normal(shape)
    drive[0] = rng.standard_normal(shape[1])
    return np.asarray(lfilter([1.0], [1.0, -keep], drive, axis=0))


def _blocked(rng: np.random.Generator, shape: tuple[int, int], step_s: float, errors: TagErrors) -> Floats:
    """(E, A) 1 while a link is blocked: spells of `blocked_s` on average, `blocked_share` of the time."""
    ends = step_s / errors.blocked_s
    begins = ends * errors.blocked_share / (1 - errors.blocked_share)
    chance = rng.uniform(size=shape)
    blocked = np.zeros(shape)
    for k in range(1, shape[0]):
        blocked[k] = np.where(blocked[k - 1] > 0, chance[k] >= ends, chance[k] < begins)
    return blocked
