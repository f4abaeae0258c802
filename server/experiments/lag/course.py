"""One noise's course: what was seen of a reaching arm, and what ours made of it."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Final

from fusion.virtual_patient.sensor import NoiseLevel
from server.config import StationConfig
from server.experiments.lag.filters import Moved, ours
from server.experiments.lag.linear import best_linear
from server.experiments.lag.reaching import reaching
from server.experiments.lag.response import JOINTS
from server.experiments.lag.scores import JUDGED, Score, score
from server.experiments.lag.seen import Seen, seen
from server.station.exo.patient_range import boxes

DEVICE: Final = boxes(StationConfig().device, StationConfig().gate)
"""What the built-in exoskeleton allows."""


@dataclass(frozen=True, slots=True)
class Course:
    """Angles of the arm and set-points, tick by tick."""

    seen: Seen
    whole: Moved
    """From the estimator's angles."""
    alone: Moved
    """From the angles of the sensors' mean."""

    def scores(self, moved: Moved) -> dict[str, Score]:
        """By the angle's name."""
        return {name: score(moved.angle_rad[:, j], self.seen.truth_rad[:, j]) for name, j in JOINTS.items()}

    def best(self, joint: int, calm_s4: float = 0.0, punctual: bool = False) -> Score:
        """Of the best linear filter on the angle of the sensors' mean."""
        truth = self.seen.truth_rad[:, joint]
        return score(best_linear(self.seen.sensors_rad[:, joint], truth, JUDGED, calm_s4, punctual), truth)


def course(seed: int, length_s: float, noise: NoiseLevel) -> Course:
    """Reach, see and follow.

    Args:
        seed: of everything random.
        length_s: how long.
        noise: of both sensors.
    """
    known = seen(reaching(seed, length_s, noise))
    return Course(known, ours(known.estimated_rad, DEVICE), ours(known.sensors_rad, DEVICE))
