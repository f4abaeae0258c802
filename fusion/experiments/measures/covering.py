"""How far a fused joint moves when one of the sensors is covered while the patient stands.

At random moments of standing the course of things is split: one goes on as recorded, in the other a sensor says nothing
for a second. The fused joints of the same instants are compared.

Whoever coasts (holds the last position and hears nobody) does not move at all, so coasting is told beside: by the
state, and by whether the fused joint follows when the sensor that is left sees the whole body sway by 0.1 m.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace
from typing import Final

import numpy as np
from numpy.typing import NDArray

from fusion.experiments.measures.scene import Scene, Told, WhatIf, seen_alone, told
from fusion.experiments.measures.standing import standing_stretches
from fusion.messages import Flags, Floats, SkeletonSample
from fusion.offline import GRID_HZ
from fusion.skeleton import TrackingState, arm

COVERED_S: Final = 1.0
BEFORE_S: Final = 0.5
"""The patient stands at least this long before the sensor is covered."""
SWAY_M: Final = 0.1
HEARD_WITHIN_S: Final = 0.05
FRAMES: Final = round(COVERED_S * GRID_HZ)


@dataclass(frozen=True, slots=True)
class Covering:
    """One sensor covered at M moments of standing; N joint-frames in which another one gave the joint just then."""

    sensor: str
    """The one that was covered."""
    moments_s: Floats  # (M,) when each covering began
    moved_m: Floats  # (N,) from the fused joint with every sensor to that without this one
    coasted: Flags  # (N,) held or predicted although another sensor gave the joint
    half_apart_m: Floats  # (N,) half the sensors' own distance, its median difference in the stretch taken off
    follows: float
    """Share of a sway seen by the sensors left that the fused arm follows: 0 = coasts, 1 = follows."""


def covering(scene: Scene, method: str, moments: int = 30, seed: int = 3) -> tuple[Covering, ...]:
    """Cover each sensor in turn at random moments of standing.

    Args:
        scene: one patient, at least two sensors.
        method: a name in `fusion.estimation.METHODS`.
        moments: how many for each sensor; fewer where the standing is too short.
        seed: of the moments; with equal seeds every method meets the same ones.

    Returns:
        One per sensor; none where nobody stands for a second and a half.
    """
    stretches = standing_stretches(scene)
    starts = _starts(stretches)
    if not len(starts):
        return ()
    rng = np.random.default_rng(seed)
    chosen = {s: np.sort(rng.choice(starts, min(moments, len(starts)), replace=False)) for s in scene.alignments}
    forks = [
        (start, what_if)
        for sensor, when in chosen.items()
        for start in when.tolist()
        for what_if in (_covered(sensor), _covered_and_swaying(scene, sensor, start))
    ]
    whole, courses = told(scene, method, forks, FRAMES)
    parts, at = [], 0
    for sensor, when in chosen.items():
        own = courses[at : at + 2 * len(when)]
        parts.append(_compared(scene, sensor, when, whole, own[::2], own[1::2], stretches))
        at += 2 * len(when)
    return tuple(parts)


def _starts(stretches: Sequence[slice]) -> NDArray[np.int64]:
    """Grid indices at which a covering may begin: the patient stands before and all the while."""
    before = round(BEFORE_S * GRID_HZ)
    parts = [np.arange(s.start + before, s.stop - FRAMES + 1) for s in stretches]
    return np.concatenate([np.zeros(0, np.int64), *parts])


def _covered(sensor: str) -> WhatIf:
    """The sensor says nothing."""
    return lambda sample, t_s: None if sample.sensor == sensor else sample


def _covered_and_swaying(scene: Scene, sensor: str, start: int) -> WhatIf:
    """The sensor says nothing, and the others see the whole body sway along the reference's x."""
    start_s = float(scene.t_s[start])

    def swayed(sample: SkeletonSample, t_s: float) -> SkeletonSample | None:
        if sample.sensor == sensor:
            return None
        along = scene.alignments[sample.sensor].rotation_sensor_to_reference[0]  # that x in the sensor's frame
        shift = float(_sway(np.array([t_s]), start_s)[0]) * along
        return replace(sample, positions_in_sensor=sample.positions_in_sensor + shift)

    return swayed


def _sway(t_s: Floats, start_s: float | Floats) -> Floats:
    """m, of the shape of `t_s`: there and back within the second, at most 0.31 m/s."""
    sway: Floats = SWAY_M * np.sin(np.pi * np.clip((t_s - start_s) / COVERED_S, 0, 1)) ** 2
    return sway


def _compared(
    scene: Scene,
    sensor: str,
    starts: NDArray[np.int64],
    whole: Told,
    covered: Sequence[Told],
    swaying: Sequence[Told],
    stretches: Sequence[slice],
) -> Covering:
    joints = list(arm(scene.healthy_side)[:3])
    rows = starts[:, None] + np.arange(FRAMES)  # (M, F)
    given = _given(scene, sensor)[rows][..., joints]
    alone = np.array([course.positions for course in covered])[..., joints, :]
    moved_m = _norm(alone - whole.positions[rows][..., joints, :])
    state = np.array([course.state for course in covered])[..., joints]
    apart = _half_apart(scene, sensor, stretches)[rows][..., joints]
    went = (np.array([course.positions for course in swaying])[..., joints, :] - alone)[..., 0][given]
    sway = _sway(scene.t_s[rows], scene.t_s[starts][:, None])
    meant = np.broadcast_to(sway[..., None], given.shape)[given]
    follows = float(meant @ went / (meant @ meant))
    coasted = state[given] != TrackingState.TRACKED
    return Covering(sensor, scene.t_s[starts], moved_m[given], coasted, apart[given], follows)


def _given(scene: Scene, covered: str) -> Flags:
    """(T, 25) whether any of the other sensors gave the joint within the last 50 ms."""
    flags = []
    for sensor in scene.alignments:
        if sensor != covered:
            positions, age_s = seen_alone(scene, sensor)
            flags.append(np.isfinite(positions).all(axis=2) & (age_s <= HEARD_WITHIN_S)[:, None])
    return np.asarray(np.any(flags, axis=0))


def _half_apart(scene: Scene, covered: str, stretches: Sequence[slice]) -> Floats:
    """(T, 25) m, half the distance to the mean of the others, less the median difference of the stretch."""
    others = [seen_alone(scene, sensor)[0] for sensor in scene.alignments if sensor != covered]
    difference = seen_alone(scene, covered)[0] - np.mean(others, axis=0)
    halves = np.full(difference.shape[:2], np.nan)
    for stretch in stretches:
        halves[stretch] = _norm(difference[stretch] - np.median(difference[stretch], axis=0)) / 2
    return halves


def _norm(difference: Floats) -> Floats:
    length: Floats = np.linalg.norm(difference, axis=-1)
    return length
