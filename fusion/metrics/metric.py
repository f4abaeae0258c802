"""One figure of a session, as it is stored and shown."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Final

from fusion.skeleton import Side

PASSIVE_DRIVE: Final = "caveat.passive_drive"
"""The exoskeleton moved the arm, so the figure measures the drive and not the patient."""
ESTIMATED_TORQUE: Final = "caveat.estimated_torque"
"""The arm's torque is what the drive's own does not explain: it is as good as the model of the arm."""
CARRIED_WEIGHT: Final = "caveat.carried_weight"
"""The drive's part contains carrying the arm's weight."""
SENSOR_NOISE: Final = "caveat.sensor_noise"
"""The sensors' noise is a good part of the figure; compare within one set-up only."""
UNRELIABLE: Final = "caveat.unreliable"
"""Depth cameras are known not to measure it well; at most its trend over many sessions says something."""
SLOW: Final = "caveat.slow"
"""The movements were so slow that the sensors' noise is as fast: it breaks them up and adds to their speed."""
ONE_SENSOR: Final = "caveat.one_sensor"
"""One depth camera saw it alone: what it cannot see it guesses."""
ADAPTED: Final = "caveat.adapted"
"""The games' difficulty is adapted so that this stays where it is; the level shows what has changed."""


@dataclass(frozen=True, slots=True)
class Metric:
    """A figure; docs/metrics.md defines each by its name."""

    name: str
    value: float
    unit: str
    """SI: m, s, rad, m/s, Hz, N m, J; min for minutes, 1 for counts and ratios."""
    joint: str | None = None
    """The exoskeleton joint it is of, the sensor's name in a sensor's figures, or the game's in a game's."""
    side: Side | None = None
    caveat_key: str | None = None
    """String key of what must be said beside it."""
    sem: float | None = None
    """Standard error of the value, from how much it varied within the session; None where that is not known, or where
    it is a count or a time that is simply so."""

    @property
    def label_key(self) -> str:
        """String key of its name."""
        return f"metric.{self.name}"
