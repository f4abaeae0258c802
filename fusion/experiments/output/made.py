"""An experiment that has been made: what it came to, how long it took, and its pictures."""

from __future__ import annotations

from dataclasses import dataclass

from fusion.experiments.experiment import Experiment
from fusion.experiments.outcome import Outcome


@dataclass(frozen=True, slots=True)
class Made:
    """One experiment's result, ready to be written."""

    experiment: Experiment
    outcome: Outcome
    took_s: float
    pictures: dict[str, dict[str, bytes]]
    """By the picture's name, then by kind: "png", "svg"."""


@dataclass(frozen=True, slots=True)
class Origin:
    """How a page was made, so that it can be made again."""

    command: str
    seed: int
    version: str
    recordings: bool
    """Whether real recordings were given."""
