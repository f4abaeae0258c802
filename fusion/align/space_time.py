"""Mounting and clock offset of a sensor together: each is only as good as the other.

Given the mounting, an offset δ too small leaves e = δ v between the joints, v being their velocity; least squares over
all joints gives δ = Σ w e·v / Σ w v·v (Gauss-Newton). Given the offset, `fusion.align.space` gives the mounting. A few
rounds of both settle.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from fusion.align.alignment import SensorAlignment
from fusion.align.loops import offset_sums
from fusion.align.space import POINTS_PER_INDEPENDENT, Mounting, RobustFit, fit_robustly
from fusion.align.timeline import OffsetCandidate, offset_candidates
from fusion.align.track import BodyTrack, Pairs, pair

OFFSET_CUTOFF_M = 0.25
"""Tukey's width where the offset is fitted: fixed and wide, as it is the moving joints that tell, and they err most."""
OFFSET_NOISE_M = 0.02
"""No pair of sensors agrees better than this on a moving joint."""
CORRELATION_STD_S = 0.03
"""How far the best correlation of speeds is usually off; it steadies the fit where there was little motion."""
LEAST_CORRELATION = 0.4
"""On clocks known to be close, a weaker agreement of speeds (somebody stands still) is worth less than no offset."""
SETTLED_S = 2e-4
MOST_FRAMES = 1200
"""A long recording is thinned to this many frames, evenly."""
COARSE_FRAMES = 300
"""As many are enough until mounting and offset have nearly settled."""
FEWEST_FRAMES = 15


@dataclass(frozen=True, slots=True)
class OffsetStep:
    """What the pairs say of the remaining offset."""

    change_s: float
    information: float
    """1/s²: inverse variance of the step, from how much motion there was to tell by."""

    def steadied(self, towards_s: float, std_s: float) -> float:
        """The step once a prior belief of that deviation, `towards_s` away, has its share."""
        prior = 1.0 / std_s**2
        return (self.information * self.change_s + prior * towards_s) / (self.information + prior)


def offset_step(pairs: Pairs, under: Mounting, weight: np.ndarray) -> OffsetStep:
    """The offset's Gauss-Newton step under a mounting.

    Args:
        pairs: joints at the offset reached so far.
        under: the mounting.
        weight: (N, J), 0 for frames that were found swapped.
    """
    told, pull, square, total = offset_sums(under.errors(pairs), pairs.velocity, weight, OFFSET_CUTOFF_M)
    variance = square / (3 * max(total, 1e-9))
    information = told / (max(variance, OFFSET_NOISE_M**2) * POINTS_PER_INDEPENDENT)
    return OffsetStep(pull / max(told, 1e-9), information)


def fit_space_time(
    reference: BodyTrack,
    sensor: BodyTrack,
    longest_s: float = np.inf,
    candidates: int = 5,
    rounds: int = 10,
    most: int = MOST_FRAMES,
) -> SensorAlignment | None:
    """Mounting and clock offset of a sensor from everything two tracks hold; None where they never saw a body together.

    The offset is sought among the best correlations of the joints' speeds (for somebody who keeps still: the clocks as
    they are); the one whose joints then agree best is refined.

    Args:
        reference: the patient as the reference sensor saw them, on its clock.
        sensor: the same person as the other sensor saw them, on its own clock.
        longest_s: the largest absolute offset to consider.
        candidates: how many offsets to try.
        rounds: how often at most to alternate between mounting and offset.
        most: how many frames to look at, evenly.
    """
    if min(len(reference.t_s), len(sensor.t_s)) < FEWEST_FRAMES:
        return None
    starts = offset_candidates(reference, sensor, longest_s, candidates)
    if not starts or (np.isfinite(longest_s) and starts[0].correlation < LEAST_CORRELATION):
        starts = (OffsetCandidate(0.0, 1.0),)
    few = min(most, COARSE_FRAMES) // 4
    best = min(starts, key=lambda start: _unlikeness(refine(reference, sensor, start.offset_s, 2, few), start))
    coarse = refine(reference, sensor, best.offset_s, rounds, min(most, COARSE_FRAMES))
    if coarse is None or most <= COARSE_FRAMES:
        return coarse
    return refine(reference, sensor, coarse.clock_offset_s, rounds, most, mounting_of(coarse), best.offset_s)


def clear_offset(reference: BodyTrack, sensor: BodyTrack, longest_s: float) -> float | None:
    """The offset on which the joints' speeds agree clearly; None while nobody has moved enough."""
    best = next(iter(offset_candidates(reference, sensor, longest_s, 1)), None)
    return best.offset_s if best is not None and best.correlation >= LEAST_CORRELATION else None


def _unlikeness(found: SensorAlignment | None, start: OffsetCandidate) -> float:
    """How badly joints and speeds agree; fewer common frames make a small residual less telling."""
    return np.inf if found is None else found.residual_m / (start.correlation * float(np.sqrt(found.frames)))


def refine(
    reference: BodyTrack,
    sensor: BodyTrack,
    offset_s: float,
    rounds: int,
    most: int = MOST_FRAMES,
    start: Mounting | None = None,
    prior_s: float | None = None,
) -> SensorAlignment | None:
    """Settle mounting and offset near a first offset; None where the tracks have too few frames in common.

    Args:
        reference: the patient as the reference sensor saw them.
        sensor: the same person in the other sensor.
        offset_s: where to start.
        rounds: how often at most to alternate.
        most: how many frames to look at.
        start: the mounting to start from.
        prior_s: the offset that the speeds gave, which steadies the result; `offset_s` when None.
    """
    prior_s = offset_s if prior_s is None else prior_s
    cutoff_m = np.inf
    for _ in range(rounds):
        pairs = pair(reference, sensor, offset_s, most)
        if pairs.frames < FEWEST_FRAMES:
            return None
        fit = fit_robustly(pairs, None, start, cutoff_m)
        start, cutoff_m = fit.mounting, fit.cutoff_m
        step = offset_step(pairs, fit.mounting, np.where(fit.swapped[:, None], 0.0, pairs.weight))
        change_s = step.steadied(prior_s - offset_s, CORRELATION_STD_S)
        offset_s += change_s
        if abs(change_s) < SETTLED_S:
            break
    return alignment_of(fit, offset_s, pairs.frames)


def alignment_of(fit: RobustFit, offset_s: float, frames: int) -> SensorAlignment:
    """The value that others see of a fit."""
    found = fit.mounting
    return SensorAlignment(
        found.rotation,
        found.translation_m,
        offset_s,
        fit.residual_m,
        frames,
        found.rotation_std_rad,
        found.position_std_m,
    )


def mounting_of(alignment: SensorAlignment) -> Mounting:
    """Where the sensor stands, without its clock."""
    return Mounting(
        alignment.rotation_sensor_to_reference,
        alignment.translation_m,
        alignment.rotation_std_rad,
        alignment.position_std_m,
    )
