"""The two experiments of [Shi] by simulation: standing while somebody walks around, and a walk around a square.

`python -m fusion.ranging.experiment` prints their figures.
"""

from __future__ import annotations

from dataclasses import dataclass, replace
from typing import Final

import numpy as np

from fusion.messages import Floats
from fusion.ranging.calibration import Calibration
from fusion.ranging.links import unknown_links
from fusion.ranging.locate import locate
from fusion.ranging.paper import least_squares_position, standing, stepped
from fusion.ranging.pushes import integrated
from fusion.ranging.ranges import Ranges

ANCHORS: Final = np.array([[0.0, 0.0, 1.0], [0.0, 2.7, 1.0], [2.7, 0.0, 1.0]])
"""A, B above and C to the right of it, as in the paper's fig. 3; the distances are ours."""
MIDDLE: Final = np.array([1.35, 1.35, 1.0])
RATE_HZ: Final = 50.0
RANGE_SIGMA_M: Final = 0.03
OBSTACLE_M: Final = 0.30
"""How much a body between tag and anchor lengthens a range; scattered by a third."""
BODY_M: Final = 0.25
"""Half a person's breadth: nearer to the line of sight than that, they block it."""
ACCEL_SIGMA_M_S2: Final = 0.05
ACCEL_BIAS_M_S2: Final = 0.02
SQUARE_M: Final = 2.4


@dataclass(frozen=True, slots=True)
class Outcome:
    """One run: where the tag was, and where each method put it, (T, 3) m each."""

    t_s: Floats  # (T,)
    truth: Floats
    radio_alone: Floats
    """Least squares of all three ranges, instant by instant."""
    joined: Floats
    """The paper's rule as docs/ranging.md restates it."""
    mended: Floats
    """The same evidence joined by honest variances: what `locate` does."""


def somebody_walks_around(seed: int, lap_s: float = 20.0, radius_m: float = 0.8) -> Outcome:
    """The tag stands at (135, 135) cm; a person walks once around it and blocks each anchor in turn."""
    t_s = np.arange(0.0, lap_s, 1 / RATE_HZ)
    phase = 2 * np.pi * t_s / lap_s
    person = MIDDLE + radius_m * np.stack([np.cos(phase), np.sin(phase), 0 * phase], axis=-1)
    return _run(np.tile(MIDDLE, (len(t_s), 1)), person, seed)


def walk_around_a_square(seed: int, speed_m_s: float = 0.6) -> Outcome:
    """The tag is carried anticlockwise once around a 2.4 m square; the bearer's own body, behind it, blocks anchors."""
    truth = _square(speed_m_s)
    ahead = np.gradient(truth, axis=0)
    length = np.maximum(np.linalg.norm(ahead, axis=1, keepdims=True), 1e-9)
    return _run(truth, truth - 0.3 * ahead / length, seed)


def _square(speed_m_s: float) -> Floats:
    """Around the square with corners rounded over half a second, so that accelerations stay those of a person."""
    low, high = 1.35 - SQUARE_M / 2, 1.35 + SQUARE_M / 2
    corners = np.array([[low, low], [high, low], [high, high], [low, high], [low, low]])
    at = np.arange(0.0, 4 * SQUARE_M, speed_m_s / RATE_HZ)
    flat = np.stack([np.interp(at, SQUARE_M * np.arange(5), corners[:, axis]) for axis in (0, 1)], axis=-1)
    taps = int(RATE_HZ / 2)
    held = np.concatenate([np.repeat(flat[:1], taps, 0), flat, np.repeat(flat[-1:], taps, 0)])
    for _ in range(2):
        held = np.stack([np.convolve(held[:, axis], np.ones(taps) / taps, "valid") for axis in (0, 1)], axis=-1)
    return np.column_stack([held, np.full(len(held), MIDDLE[2])])


def _run(truth: Floats, person: Floats, seed: int) -> Outcome:
    rng = np.random.default_rng(seed)
    dt_s = 1 / RATE_HZ
    t_s = np.linspace(0.0, dt_s * (len(truth) - 1), len(truth))
    range_m = _ranges(truth, person, rng)
    acceleration = np.gradient(np.gradient(truth, dt_s, axis=0), dt_s, axis=0)
    acceleration += rng.normal(0, ACCEL_SIGMA_M_S2, truth.shape) + ACCEL_BIAS_M_S2 * rng.uniform(-1, 1, 3)
    acceleration[:, 2] = 0.0
    alone = np.array([least_squares_position(ANCHORS, ranges, MIDDLE) for ranges in range_m])
    joined = _by_the_paper(truth[0], range_m, acceleration, dt_s)
    return Outcome(t_s, truth, alone, joined, _mended(t_s, range_m, acceleration))


def _by_the_paper(start: Floats, range_m: Floats, acceleration: Floats, dt_s: float) -> Floats:
    state, found = standing(start), []
    for ranges, accel in zip(range_m, acceleration, strict=True):
        state = stepped(state, ANCHORS, ranges, RANGE_SIGMA_M, accel, dt_s)
        found.append(state.position)
    return np.array(found)


def _mended(t_s: Floats, range_m: Floats, acceleration: Floats) -> Floats:
    """The heading is known, as the paper's sensors have a magnetometer and its anchors the same axes."""
    links = replace(unknown_links(len(ANCHORS), 1), sigma_m=RANGE_SIGMA_M, coherence_s=1e-3, wander_m=0.0)
    pushes = integrated(t_s, acceleration, heading_rad=0.0)
    ranges = Ranges(ANCHORS, t_s, range_m[:, :, None])
    return locate(ranges, Calibration(links), float(MIDDLE[2]), inertial=[pushes]).positions[:, 0]


def _ranges(truth: Floats, person: Floats, rng: np.random.Generator) -> Floats:  # (T, 3)
    away = ANCHORS - truth[:, None]
    distance = np.linalg.norm(away, axis=-1)
    to_person = person - truth
    along = np.einsum("tad,td->ta", away, to_person) / distance
    aside = np.sqrt(np.maximum(np.sum(to_person**2, axis=1)[:, None] - along**2, 0.0))
    blocked = (along > 0) & (along < distance) & (aside < BODY_M)
    longer = np.where(blocked, OBSTACLE_M * (1 + rng.normal(0, 1 / 3, distance.shape)), 0.0)
    return np.asarray(distance + rng.normal(0, RANGE_SIGMA_M, distance.shape) + np.maximum(longer, 0.0))


def figures(outcome: Outcome) -> str:
    """Each method's rms (cm), and between what x and y stayed 99 % of the time (cm)."""
    parts = []
    for name in ("radio_alone", "joined", "mended"):
        found = getattr(outcome, name)
        rms_cm = 100 * np.sqrt(np.mean(np.sum((found - outcome.truth) ** 2, axis=1)))
        (x0, y0), (x1, y1) = np.percentile(100 * found[:, :2], [0.5, 99.5], axis=0)
        parts.append(f"{name} {rms_cm:.1f} (x {x0:.0f} to {x1:.0f}, y {y0:.0f} to {y1:.0f})")
    return "; ".join(parts)


if __name__ == "__main__":
    for experiment in (somebody_walks_around, walk_around_a_square):
        for seed in range(10):
            print(f"{experiment.__name__}, seed {seed}, cm: {figures(experiment(seed))}")
