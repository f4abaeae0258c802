"""What a figure of a session means: its unit, formula and source, and how far these sensors can be trusted for it."""

from __future__ import annotations

from dataclasses import dataclass
from enum import StrEnum
from typing import Final

NOT_FILTERED: Final = "none"
HAND_FILTER: Final = (
    "50 Hz by linear interpolation, unbroken stretches of 1 s or more; Butterworth low-pass, second order, 3 Hz, "
    "forward and backward; velocity by central differences"
)
"""How the hand's path is prepared (docs/metrics.md)."""
OURS: Final = "ours"
"""Where no publication defines it in this way."""
SRRR_2: Final = "Kwakkel et al., Neurorehabil Neural Repair 33:951–958, 2019 (SRRR 2)"
SCHWARZ: Final = "Schwarz et al., Stroke 50:718–727, 2019"
ALT_MURPHY: Final = "Alt Murphy et al., Neurorehabil Neural Repair 25:71–80, 2011"


class Trust(StrEnum):
    """How far a figure of these sensors can be trusted; the rule is in docs/metrics.md."""

    GOOD = "good"
    FAIR = "fair"
    POOR = "poor"


class Better(StrEnum):
    """In which direction a patient gets better; of the healthy hand's skill and of plain facts nothing is said."""

    MORE = "more"
    LESS = "less"
    NEITHER = ""


@dataclass(frozen=True, slots=True)
class PublishedChange:
    """A difference between two measurements that somebody has published."""

    value: float
    source: str
    of_whom: str = ""


@dataclass(frozen=True, slots=True)
class Measure:
    """One entry of the catalogue."""

    name: str
    unit: str
    """SI, as in `Metric.unit`."""
    formula: str
    """In words."""
    source: str
    trust: Trust
    """With two depth cameras or more, where it comes from them."""
    trust_key: str
    """String key of the sentence that says why."""
    better: Better = Better.NEITHER
    filter: str = NOT_FILTERED
    mdc: PublishedChange | None = None
    """None = not published for this sensor: it comes from the patient's own sessions."""
    mcid: PublishedChange | None = None
    """The smallest change that mattered to patients; None = not published for this sensor."""
    trust_of_one: Trust | None = None
    """With one depth camera alone; None = the same."""
    camera_error: float = 0.0
    """Standard deviation of a session's figure about the truth before two cameras, from session to session; 0 where no
    camera has a part in it. No session tells it by itself (`mirrorlimb experiments measures-trust`).
    """

    @property
    def label_key(self) -> str:
        """String key of its name."""
        return f"metric.{self.name}"
