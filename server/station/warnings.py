"""What people are warned of: counters that should stand still, each told once and then at most every ten seconds."""

from __future__ import annotations

from dataclasses import dataclass

from server.messages import Warned

REPEAT_S = 10.0


@dataclass(frozen=True, slots=True)
class Trouble:
    """One thing that should not happen, and how often it has."""

    code: str
    count: int
    text: str
    """For a person; `{more}` is how often it happened since it was last told."""


class Warnings:
    """Turns growing counters into warnings."""

    def __init__(self) -> None:
        self._told: dict[str, tuple[int, float, str]] = {}

    def step(self, troubles: tuple[Trouble, ...], now_s: float) -> list[Warned]:
        """The warnings that are due now."""
        due = []
        for trouble in troubles:
            count, told_s, _ = self._told.get(trouble.code, (0, float("-inf"), ""))
            if trouble.count > count and now_s - told_s >= REPEAT_S:
                text = trouble.text.format(more=trouble.count - count)
                self._told[trouble.code] = (trouble.count, now_s, text)
                due.append(Warned(t_s=now_s, code=trouble.code, text=text))
        return due

    def recent(self, now_s: float) -> tuple[str, ...]:
        """The texts of the last ten seconds."""
        return tuple(text for _, told_s, text in self._told.values() if now_s - told_s < REPEAT_S)
