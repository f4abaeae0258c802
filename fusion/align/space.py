"""A sensor's mounting from paired joints: exact at any angle, robust, and recursive through running sums.

The rotation solves Wahba's problem, ``min Σ w |r - R s - T|²``, in closed form (Kabsch 1976; Umeyama, IEEE PAMI 13(4),
1991): with H = Σ w (r - r̄)(s - s̄)', R is the rotation nearest to H and T = r̄ - R s̄. Only sums enter, so they can
be added up frame by frame, forgotten, and joined in any order. Robustness is Huber's weight, which lets a joint that
errs systematically count a little, times Tukey's biweight, which cuts a lost one off; the biweight's width is annealed
from wide to narrow so that the start does not matter (graduated non-convexity).
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from fusion.align.loops import clearly_crossed, distances, robust_weights, turned, weighted_sums
from fusion.align.track import Pairs
from fusion.geometry import nearest_rotation
from fusion.messages import Floats
from fusion.skeleton import SIDES_SWAPPED

HUBER_WIDTHS = 1.0
"""In median distances: half of the joints count fully. Found to agree best with fits to truth of every kind."""
TUKEY_WIDTHS = 25.0
"""In median distances: what is further off than this is not that joint."""
NARROWEST_M = 0.002
"""A median is never taken for smaller than this, so that clean data are not cut to nothing."""
CLEARLY_CROSSED = 0.6
"""A frame whose joints are less than this share as far apart with left and right exchanged has them exchanged."""
MOST_SWAPPED = 0.5
"""A sensor with more exchanged frames than this has its sides exchanged altogether (`plausible` says so)."""
MOST_ROUNDS = 40
SETTLED = 1e-5
"""Radians and metres: no sensor is mounted more exactly."""
POINTS_PER_INDEPENDENT = 50.0
"""A skeleton's joints err together and for a second or so: this many points count as one when a deviation is stated."""


@dataclass(frozen=True, slots=True)
class Moments:
    """Weighted sums of paired points: all that the closed form needs."""

    weight: float
    mean_reference: Floats  # (3,)
    mean_sensor: Floats  # (3,)
    cross: Floats  # (3, 3) Σ w (r - r̄)(s - s̄)'
    scatter: Floats  # (3, 3) Σ w (s - s̄)(s - s̄)'
    square: float
    """Σ w |r - r̄|²."""

    @staticmethod
    def nothing() -> Moments:
        """The sums over no point."""
        return Moments(0.0, np.zeros(3), np.zeros(3), np.zeros((3, 3)), np.zeros((3, 3)), 0.0)

    @staticmethod
    def of(reference: Floats, sensor: Floats, weight: Floats) -> Moments:
        """Sums over points (N, 3), (N, 3) with weights (N,)."""
        return Moments(*weighted_sums(reference, sensor, weight))

    def joined(self, other: Moments) -> Moments:
        """The sums over both sets of points (Chan et al. 1979); the order does not matter."""
        total = self.weight + other.weight
        if total <= 0.0:
            return self
        share = other.weight / total
        d_reference, d_sensor = other.mean_reference - self.mean_reference, other.mean_sensor - self.mean_sensor
        lever = self.weight * share
        return Moments(
            total,
            self.mean_reference + share * d_reference,
            self.mean_sensor + share * d_sensor,
            self.cross + other.cross + lever * np.outer(d_reference, d_sensor),
            self.scatter + other.scatter + lever * np.outer(d_sensor, d_sensor),
            self.square + other.square + lever * float(d_reference @ d_reference),
        )

    def faded(self, factor: float) -> Moments:
        """The same sums with every weight multiplied by `factor`."""
        return Moments(
            self.weight * factor,
            self.mean_reference,
            self.mean_sensor,
            self.cross * factor,
            self.scatter * factor,
            self.square * factor,
        )


@dataclass(frozen=True, slots=True)
class Mounting:
    """A rotation and a translation with their deviations: ``p_reference = R p_sensor + T``."""

    rotation: Floats  # (3, 3) sensor to reference
    translation_m: Floats  # (3,)
    rotation_std_rad: float
    position_std_m: float

    def errors(self, pairs: Pairs) -> Floats:
        """Reference minus aligned joint (N, J, 3), m."""
        errors: Floats = pairs.reference - self.aligned(pairs)
        return errors

    def aligned(self, pairs: Pairs) -> Floats:
        """The sensor's joints in the reference's frame (N, J, 3), m."""
        return turned(pairs.sensor.reshape(-1, 3), self.rotation, self.translation_m).reshape(pairs.sensor.shape)


def mounting(moments: Moments) -> Mounting:
    """The mounting that fits the sums best, and how well they determine it."""
    rotation, translation = _closed_form(moments)
    return Mounting(rotation, translation, *_deviations(moments, rotation))


def _closed_form(moments: Moments) -> tuple[Floats, Floats]:
    rotation = nearest_rotation(moments.cross)
    return rotation, moments.mean_reference - rotation @ moments.mean_sensor


def _deviations(moments: Moments, rotation: Floats) -> tuple[float, float]:
    """Standard deviations of rotation (rad) and of the body's middle (m), from the residual and the spread.

    A small turn ε moves a point by ε × u, so its information is Σ w (|u|² 1 - u u') / σ² with u = R (s - s̄).
    """
    if moments.weight <= 0.0:
        return float("inf"), float("inf")
    square = moments.square + np.trace(moments.scatter) - 2 * np.trace(rotation.T @ moments.cross)
    variance = max(float(square), 0.0) / (3 * moments.weight) * POINTS_PER_INDEPENDENT
    lever = np.linalg.eigvalsh(np.trace(moments.scatter) * np.eye(3) - moments.scatter)
    rotation_variance = float((variance / np.maximum(lever, 1e-9)).sum())
    return float(np.sqrt(rotation_variance)), float(np.sqrt(3 * variance / moments.weight))


@dataclass(frozen=True, slots=True)
class RobustFit:
    """A mounting, the weight that each joint kept, and what is left over."""

    mounting: Mounting
    weight: Floats  # (N, J)
    residual_m: float
    """Median distance over all weighted joints."""
    cutoff_m: float
    swapped: NDArray[np.bool_]  # (N,) frames whose left and right were found exchanged

    def moments(self, pairs: Pairs) -> Moments:
        """The sums of the pairs as weighted in this fit, to be settled into a recursion."""
        return Moments.of(pairs.reference.reshape(-1, 3), pairs.sensor.reshape(-1, 3), self.weight.ravel())


def fit_robustly(
    pairs: Pairs, settled: Moments | None = None, start: Mounting | None = None, cutoff_m: float = np.inf
) -> RobustFit:
    """Fit a mounting to pairs and to sums settled before.

    Frames whose left and right are exchanged (they fit far better with `SIDES_SWAPPED`) take no part; lost and
    wandering joints are weighed down.

    Args:
        pairs: at least four weighted joints in all.
        settled: sums of earlier frames, already weighted.
        start: where to start; the plain least-squares fit when None.
        cutoff_m: where the cut-off's width starts, as far as any joint is off: that of an earlier fit where `start` is
            one to nearly the same pairs.
    """
    base = settled or Moments.nothing()
    first = start or mounting(base.joined(_moments(pairs, pairs.weight)))
    fit = _anneal(pairs, pairs.weight, base, first, 2 * cutoff_m)
    swapped = swapped_frames(pairs, fit.mounting)
    if not swapped.any() or swapped.mean() > MOST_SWAPPED:
        return fit
    again = _anneal(pairs, np.where(swapped[:, None], 0.0, pairs.weight), base, fit.mounting, 2 * fit.cutoff_m)
    return RobustFit(again.mounting, again.weight, again.residual_m, again.cutoff_m, swapped)


def swapped_frames(pairs: Pairs, under: Mounting) -> NDArray[np.bool_]:
    """Frames (N,) bool that fit far better once the sensor's left and right are exchanged."""
    return clearly_crossed(pairs.reference, under.aligned(pairs), pairs.weight, SIDES_SWAPPED, CLEARLY_CROSSED)


def _moments(pairs: Pairs, weight: Floats) -> Moments:
    return Moments.of(pairs.reference.reshape(-1, 3), pairs.sensor.reshape(-1, 3), weight.ravel())


def _anneal(pairs: Pairs, weight: Floats, base: Moments, start: Mounting, cutoff: float) -> RobustFit:
    """Iterate weights and the closed form, halving the cut-off down to its final width."""
    used = np.flatnonzero(weight > 0)
    r, s, given = pairs.reference.reshape(-1, 3)[used], pairs.sensor.reshape(-1, 3)[used], weight.ravel()[used]
    rotation, translation, sums = start.rotation, start.translation_m, base
    kept, median = given, 0.0
    for _ in range(MOST_ROUNDS):
        distance = distances(r, s, rotation, translation)
        median = _middle(distance)
        scale = max(median, NARROWEST_M)
        wanted = TUKEY_WIDTHS * scale
        cutoff = max(wanted, min(cutoff / 2, 2 * float(distance.max(initial=wanted))))
        kept = robust_weights(given, distance, cutoff, HUBER_WIDTHS * scale)
        sums = base.joined(Moments.of(r, s, kept))
        before, (rotation, translation) = (rotation, translation), _closed_form(sums)
        if cutoff <= 1.01 * wanted and _same(before, (rotation, translation)):
            break
    full = np.zeros(weight.size)
    full[used] = kept
    return RobustFit(mounting(sums), full.reshape(weight.shape), median, cutoff, np.zeros(len(weight), dtype=bool))


def _middle(distance: Floats) -> float:
    """The upper median; 0 of nothing."""
    half = len(distance) // 2
    return float(np.partition(distance, half)[half]) if len(distance) else 0.0


def _same(a: tuple[Floats, Floats], b: tuple[Floats, Floats]) -> bool:
    return all(bool(np.abs(x - y).max() < SETTLED) for x, y in zip(a, b, strict=True))
