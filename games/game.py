"""What every game is: pure rules stepped with the hand's position, and a picture of the result for the browser.

A game never reads a clock and never draws. The same seed, settings and inputs give the same score.
Positions are in the patient's trunk frame (metres; x right, y up, z from chest to back), so −z is ahead.
"""

from __future__ import annotations

from dataclasses import dataclass, field
from enum import StrEnum
from typing import Final, Protocol

from fusion.skeleton import Side

Point = tuple[float, float, float]

LONGEST_STEP_S: Final = 0.1
"""A longer step counts as this much: a stalled machine is not the patient's miss."""


class Phase(StrEnum):
    """Where a game stands."""

    WAITING = "waiting"
    """Not begun: a gesture, a person or a moment's patience begins it."""
    PLAYING = "playing"
    REST = "rest"
    PAUSED = "paused"
    BETWEEN = "between"
    """One exercise is over and the next has not begun."""
    OVER = "over"


class Wish(StrEnum):
    """What a person wants of the game."""

    NONE = ""
    START = "start"
    PAUSE = "pause"
    GO_ON = "go_on"
    """Ends a pause or a rest."""
    NEXT = "next"
    """On to the next exercise."""
    REST = "rest"
    QUIT = "quit"
    PIN = "pin"
    """The level becomes `GameInput.level` and stays there."""
    ADAPT = "adapt"
    """The level follows success again."""


@dataclass(frozen=True, slots=True)
class Workspace:
    """Where the shown hand can go: joint ranges that both the healthy arm (mirrored) and the exoskeleton reach."""

    side: Side
    """The affected side, whose arm is shown."""
    shoulder: Point
    upper_arm_m: float
    forearm_m: float
    """Elbow to the hand's centre."""
    plane_rad: tuple[float, float]
    elevation_rad: tuple[float, float]
    rotation_rad: tuple[float, float]
    elbow_rad: tuple[float, float]


@dataclass(frozen=True, slots=True)
class GameSettings:
    """What a therapist may choose before a game."""

    rounds: int = 6
    round_s: float = 60.0
    rest_s: float = 20.0
    start_level: float = 0.2
    """Difficulty 0..1 at the start; adapted towards 75 % success."""
    pinned: bool = False
    """The difficulty stays, where the therapist wants no adaptation."""


@dataclass(frozen=True, slots=True)
class GameInput:
    """What a game sees at one step. It is all that a replay needs, so nothing else may steer a game."""

    dt_s: float
    hand: Point
    """The shown (affected) hand."""
    active: bool
    """False while the exoskeleton is not engaged: the game pauses."""
    healthy_hand: Point | None = None
    """The healthy hand where it is, not mirrored; None = not seen."""
    trunk_lean_m: float = 0.0
    shoulder_hitch_m: float = 0.0
    wish: Wish = Wish.NONE
    level: float = 0.0
    """Read with `Wish.PIN`."""


@dataclass(frozen=True, slots=True)
class ThingView:
    """One thing to draw. What `kind` and `state` may be is said in the rules that make it."""

    id: int
    """Never used twice in a game."""
    kind: str
    position: Point
    radius_m: float
    progress: float
    """0..1 of what is asked of it."""
    state: str = ""
    turn_rad: float = 0.0


@dataclass(frozen=True, slots=True)
class ChoiceView:
    """A spot in space that is chosen by staying there."""

    id: Wish
    position: Point
    radius_m: float
    progress: float


@dataclass(frozen=True, slots=True)
class Trial:
    """One attempt that succeeded or failed: what figures are made of. Unknown values are None."""

    number: int
    """From 1 within its game."""
    game: str
    success: bool
    level: float
    duration_s: float
    """From the moment it was shown to its end."""
    reaction_s: float | None
    """From the moment it was shown until the hand set out."""
    movement_s: float | None
    """From the hand's setting out to the end."""
    path_ratio: float | None
    """Way of the hand over the straight line from its place at the beginning to that at the end."""
    error_m: float | None
    """Distance from the ideal, as the game defines it."""
    hold_m: float | None
    """Root mean square of the hand about its mean while it was to be still."""


@dataclass(frozen=True, slots=True)
class GameView:
    """Everything a scene needs to draw one instant."""

    game: str
    phase: Phase
    score: int
    streak: int
    round: int
    rounds: int
    things: tuple[ThingView, ...]
    hand: Point
    time_left_s: float
    """Left in this round, this rest, or before the game begins by itself."""
    hits: int
    misses: int
    level: float
    """Difficulty 0..1."""
    way: tuple[Point, ...] = ()
    """A line to trace."""
    aim: Point | None = None
    """Where the hand is best brought now."""
    pinned: bool = False
    choices: tuple[ChoiceView, ...] = ()
    posture: str = ""
    """"lean" or "hitch" while the trunk or the shoulder helps along too much."""
    rest_suggested: bool = False
    exercise: int = 1
    exercises: int = 1
    next_game: str = ""
    """What comes after this exercise; "" = nothing."""
    total_score: int = 0
    """Of all exercises so far, this one included."""
    feedback: tuple[str, ...] = field(default=())
    """What just happened, as string keys: "hit", "missed", "streak", "rest", "round", "paused", "over", and the
    game's own words."""


class Game(Protocol):
    """A game in progress."""

    @property
    def trials(self) -> tuple[Trial, ...]:
        """Every attempt that has ended, in order."""
        ...

    def step(self, given: GameInput) -> GameView:
        """Advance by `given.dt_s` and say what is to be drawn."""
        ...

    def view(self) -> GameView:
        """The picture as it stands."""
        ...
