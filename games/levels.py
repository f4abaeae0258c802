"""From a level to what it asks."""

from __future__ import annotations


def between(easy: float, hard: float, level: float) -> float:
    """The value at a level in 0..1: `easy` at 0, `hard` at 1, a straight line between."""
    return easy + level * (hard - easy)


def evenly_between(easy: float, hard: float, level: float) -> float:
    """The same, but every step of the level changes it by the same share: for times, of which halves are felt alike."""
    return float(easy * (hard / easy) ** level)
