"""Whether the patient's screen is there: a game that nobody sees waits."""

from __future__ import annotations


class ScreenWatch:
    """Remembers whether a screen that was there has gone."""

    def __init__(self) -> None:
        self.count = 0
        """How many screens show the games to the patient now."""
        self.is_lost = False
        """The last of them has gone, and neither has one come back nor has a person said to go on without."""

    def take(self, count: int) -> bool:
        """How many there are now; True where the last of them has just gone."""
        before, self.count = self.count, count
        has_gone = count == 0 and before > 0
        self.is_lost = has_gone or (self.is_lost and count == 0)
        return has_gone

    def go_on_without(self) -> None:
        """A person says that it goes on though no screen is there."""
        self.is_lost = False
