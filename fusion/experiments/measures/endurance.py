"""A method fed for very long, with trouble in what it is fed: whether its sets stay sets."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from dataclasses import dataclass, replace
from typing import Final

import numpy as np

from fusion.estimation import METHODS
from fusion.experiments.measures.carried_sets import carried
from fusion.messages import AlignedSample, Flags, Floats, FusedFrame
from fusion.skeleton import TrackingState

ASKED_EVERY: Final = 10
"""Steps from one look at the sets to the next."""
GAP_S: Final = 3.0
TROUBLE_STEPS: Final = 200
"""Something goes wrong about this often."""


@dataclass(frozen=True, slots=True)
class Endured:
    """What was found after so many steps."""

    steps: int
    looks: int
    not_a_number: int
    """Looks at which a joint once seen had a position, set or bound that is not a number, told or carried."""
    not_symmetric: int
    """Looks at which a set or covariance was not, of those told and those carried from step to step."""
    not_positive: int
    worst_condition: float
    """Least eigenvalue over the largest, of the worst matrix ever seen."""
    largest_bound_m: float


def endured(
    method: str, samples: tuple[AlignedSample, ...], steps: int, seed: int, progress: Callable[[float], None]
) -> Endured:
    """Feed `steps` samples and look at every tenth frame.

    The samples come round and round, on a clock that goes on. About every two hundredth brings trouble: joints lost or
    not a number, or metres away, or everybody is silent for three seconds.
    """
    estimator = METHODS[method]()
    seen = np.zeros(len(samples[0].state), dtype=bool)
    faults = np.zeros(3, dtype=np.int64)
    looks, least, largest = 0, np.inf, 0.0
    for k, sample in enumerate(_for_ever(samples, np.random.default_rng(seed))):
        if k == steps:
            break
        estimator.update(sample)
        if k % ASKED_EVERY:
            continue
        frame = estimator.frame(sample.t_s)
        seen |= frame.state == TrackingState.TRACKED
        told = frame.shape_m2[seen], *(stack[seen] for stack in carried(estimator.snapshot()))
        condition, found = _looked_at(frame, seen, told)
        looks, faults = looks + 1, faults + found
        least, largest = min(least, condition), max(largest, float(frame.bound_m[seen].max(initial=0.0)))
        if k % (steps // 50 or 1) == 0:
            progress(k / steps)
    not_a_number, not_symmetric, not_positive = faults.tolist()
    return Endured(steps, looks, not_a_number, not_symmetric, not_positive, least, largest)


def _looked_at(frame: FusedFrame, seen: Flags, stacks: tuple[Floats, ...]) -> tuple[float, tuple[int, int, int]]:
    """The worst condition of all matrices of joints once seen, and whether anything is wrong with any."""
    numbers = (frame.positions_in_room[seen], frame.bound_m[seen], *stacks)
    if not all(np.isfinite(part).all() for part in numbers):
        return np.inf, (1, 0, 0)
    even = all(np.allclose(stack, stack.swapaxes(1, 2), rtol=1e-9, atol=1e-15) for stack in stacks)
    least = min(_condition(stack) for stack in stacks)
    return least, (0, int(not even), int(least <= 0))


def _condition(stack: Floats) -> float:
    """Least eigenvalue over the largest, the worst of (M, D, D)."""
    eigenvalues = np.linalg.eigvalsh(stack)
    return float((eigenvalues[:, 0] / eigenvalues[:, -1]).min(initial=np.inf))


def _for_ever(samples: tuple[AlignedSample, ...], rng: np.random.Generator) -> Iterator[AlignedSample]:
    """The samples again and again, with trouble now and then."""
    round_s = samples[-1].t_s - samples[0].t_s + 1 / 30
    later_s = 0.0
    while True:
        for sample in samples:
            moved = replace(sample, t_s=sample.t_s + later_s)
            if rng.random() < 1 / TROUBLE_STEPS:
                later_s += GAP_S * (rng.random() < 0.1)
                moved = _spoilt(moved, rng)
            yield moved
        later_s += round_s


def _spoilt(sample: AlignedSample, rng: np.random.Generator) -> AlignedSample:
    positions, state = sample.positions_in_room.copy(), sample.state.copy()
    hit = rng.random(len(state)) < 0.3
    kind = rng.integers(3)
    if kind == 0:
        state[hit] = TrackingState.LOST
    elif kind == 1:
        positions[hit] = np.nan
    else:
        positions[hit] += rng.normal(0, 5.0, (int(hit.sum()), 3))
    return replace(sample, positions_in_room=positions, state=state)
