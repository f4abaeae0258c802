"""What every experiment is, and what it is given."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, field
from enum import IntEnum

from fusion.errors import RecordingError
from fusion.experiments.outcome import Outcome
from fusion.experiments.shelf import Shelf
from fusion.experiments.wire import Wire
from fusion.recording.recording import Recording

Progress = Callable[[float], None]
"""Told the share done, 0 to 1."""


class Chapter(IntEnum):
    """Whose experiment it is; the order of the page."""

    DU = 1
    YAO = 2
    LIU = 3
    SHI = 4
    OURS = 5
    SAFETY = 6


CHAPTER_TITLES = {
    Chapter.DU: "Du and others 2016: two Kinects and a set-membership filter",
    Chapter.YAO: "Yao and others: two Kinects, adaptive weights",
    Chapter.LIU: "Liu and others 2017: the inertial arm",
    Chapter.SHI: "Shi and Zhang: radio ranges and acceleration",
    Chapter.OURS: "Beyond the papers",
    Chapter.SAFETY: "The exoskeleton and its safety",
}


@dataclass(frozen=True, slots=True)
class Setup:
    """What an experiment may use."""

    seed: int = 1
    """Of everything random."""
    effort: float = 1.0
    """Share of the usual lengths and repetitions; a test takes little."""
    shelf: Shelf | None = None
    """Real recordings, where somebody has given them."""
    open_wire: Callable[[], Wire] | None = None
    """Opens a network connection to ourselves."""
    progress: Progress = field(default=lambda share: None)

    def many(self, usual: int, least: int = 1) -> int:
        """How often to repeat, at this effort."""
        return max(least, round(usual * self.effort))

    def long(self, usual_s: float, least_s: float = 6.0) -> float:
        """How long to simulate, at this effort."""
        return max(least_s, usual_s * self.effort)

    def recordings(self, pattern: str) -> tuple[Recording, ...]:
        """The given recordings whose name fits `pattern` ("dual-kinect-truth-*"), fewer at little effort.

        Raises:
            RecordingError: there are none; the message says how to give them.
        """
        found = () if self.shelf is None else self.shelf.recordings(pattern)
        if not found:
            raise RecordingError(f"no recording '{pattern}'", "real recordings", "--recordings FOLDER")
        return found[: self.many(len(found))]

    def has(self, pattern: str) -> bool:
        """Whether such recordings were given."""
        return self.shelf is not None and self.shelf.has(pattern)


@dataclass(frozen=True, slots=True)
class Experiment:
    """One experiment: a value in a file of its own in a catalogue."""

    name: str
    """What the command line calls it."""
    chapter: Chapter
    title: str
    paper: str
    """What the paper did and found; for ours, what the goal is."""
    done: str
    """What is done here."""
    run: Callable[[Setup], Outcome]
    needs: str = ""
    """Pattern of the recordings without which there is nothing to do."""
    order: int = 0
    """Its place within the chapter."""
    only_by_name: bool = False
    """Too long for everyday: made only when it is named."""
