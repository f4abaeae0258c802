"""One body seen by one sensor over time, and the pairs that two such tracks make at common instants."""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from fusion.align.loops import interpolated, moved_around, paired
from fusion.messages import Floats, SkeletonSample, States

LONGEST_BRIDGE_S = 0.11
"""Interpolate over at most two missed frames of a 30 Hz sensor."""
VELOCITY_SPAN_S = 0.1
"""Half the span of the central difference that gives a joint's velocity: a centimetre of noise makes 7 cm/s."""
USUAL_RATE_HZ = 30.0
PATH_STEP_S, JITTER_M = 0.5, 0.01
STATE_WEIGHT = np.array([0.0, 1.0 / 16.0, 1.0])
"""Lost, inferred, tracked: inverse variances, an inferred joint being about four times as far off."""


@dataclass(frozen=True, slots=True)
class BodyTrack:
    """Frames of one body in time order."""

    t_s: Floats  # (N,)
    positions: Floats  # (N, J, 3) m, in the sensor's frame
    state: States  # (N, J)

    @staticmethod
    def of(samples: Iterable[SkeletonSample]) -> BodyTrack:
        """Stack samples of one body, on the sensor's own clock."""
        ordered = sorted(samples, key=lambda sample: sample.t_s)
        return BodyTrack(
            np.array([sample.t_s for sample in ordered]),
            np.array([sample.positions_in_sensor for sample in ordered]),
            np.array([sample.state for sample in ordered]),
        )

    def part(self, which: slice) -> BodyTrack:
        """The chosen frames."""
        return BodyTrack(self.t_s[which], self.positions[which], self.state[which])

    def thinned(self, most: int) -> BodyTrack:
        """At most so many frames, evenly."""
        few = self.part(slice(None, None, max(1, -(-len(self.t_s) // most))))
        return BodyTrack(*map(np.ascontiguousarray, (few.t_s, few.positions, few.state)))

    def since(self, t_s: float) -> BodyTrack:
        """The frames after an instant."""
        return self.part(slice(int(np.searchsorted(self.t_s, t_s, side="right")), None))

    def at(self, t_s: Floats) -> tuple[Floats, States]:
        """Positions (M, J, 3) and states (M, J), linear between the two frames around each instant [Du2016 §2.1].

        State 0 (and NaN) where there is no frame on both sides near enough, or the joint is lost in either.
        """
        return interpolated(self.t_s, self.positions, self.state, t_s, LONGEST_BRIDGE_S)

    def moved_around(self, t_s: Floats, half_s: float) -> tuple[NDArray[np.float32], States]:
        """How far each joint moved (J, M) from `half_s` before to `half_s` after each instant, and the least states."""
        return moved_around(self.t_s, self.positions, self.state, t_s, half_s, LONGEST_BRIDGE_S)

    def path_m(self) -> float:
        """How far the joints went, on average, in steps of half a second; jitter is taken off."""
        if len(self.t_s) < 2:
            return 0.0
        positions, _ = self.at(np.arange(self.t_s[0], self.t_s[-1], PATH_STEP_S))
        went = np.linalg.norm(np.diff(positions, axis=0), axis=2)
        return float(np.maximum(went[np.isfinite(went)] - JITTER_M, 0.0).sum() / self.positions.shape[1])

    def velocities_at(self, t_s: Floats) -> Floats:
        """Central differences (M, J, 3) m/s; NaN where a joint is not seen around the instant."""
        ahead, _ = self.at(t_s + VELOCITY_SPAN_S)
        behind, _ = self.at(t_s - VELOCITY_SPAN_S)
        velocities: Floats = (ahead - behind) / (2 * VELOCITY_SPAN_S)
        return velocities


@dataclass(frozen=True, slots=True)
class Pairs:
    """The same joints at the same instants as the reference and another sensor saw them."""

    reference: Floats  # (N, J, 3) m
    sensor: Floats  # (N, J, 3) m
    velocity: Floats  # (N, J, 3) m/s, of the reference's joints; 0 where unknown
    weight: Floats  # (N, J) 0 where either does not see the joint (positions there are 0)

    def __len__(self) -> int:
        return len(self.weight)

    @property
    def frames(self) -> int:
        """Frames with at least four common joints, the fewest that determine a mounting well [Du2016 §2.2]."""
        return int(np.count_nonzero((self.weight > 0).sum(axis=1) >= 4))


def _frames_stood_for(t_s: Floats) -> float:
    """How many frames of a 30 Hz sensor each frame of a thinned track stands for."""
    return max(1.0, float(np.median(np.diff(t_s))) * USUAL_RATE_HZ) if len(t_s) > 1 else 1.0


def pair(reference: BodyTrack, sensor: BodyTrack, offset_s: float, most: int | None = None) -> Pairs:
    """Bring the sensor's joints to the reference's instants, given t_reference = t_sensor - offset.

    The velocity is the reference's: taken around its own frames it shares no noise with their positions, where one
    taken between the sensor's frames would, and would pull the offset.

    Args:
        reference: whose instants count.
        sensor: interpolated to them.
        offset_s: of the sensor's clock.
        most: how many frames to take, evenly; all of them when None.
    """
    few = reference.thinned(most or len(reference.t_s))
    positions, state = sensor.at(few.t_s + offset_s)
    velocity = reference.velocities_at(few.t_s)
    weight = STATE_WEIGHT[few.state] * STATE_WEIGHT[state] * _frames_stood_for(few.t_s)
    return Pairs(*paired(few.positions, positions, velocity, weight))
