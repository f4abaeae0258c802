"""What the browser is sent over the stream: the newest tick, the game's picture and the open session."""

from __future__ import annotations

from datetime import datetime
from enum import StrEnum

import msgspec

from fusion.skeleton import Side
from games.game import GameView
from server.messages import LiveTick


class SessionPhase(StrEnum):
    """Where the open session stands, for people."""

    PREPARING = "preparing"
    """Open, not begun: the arm may not move."""
    RUNNING = "running"
    HELD = "held"
    STOPPED = "stopped"
    """Stopped or at fault, latched until somebody resets."""
    INTERRUPTED = "interrupted"
    """The station died and was started again; the session can only be ended."""
    SAVING = "saving"


class AuthorityView(msgspec.Struct, frozen=True, kw_only=True):
    """Who is in charge of the open session (SR-11)."""

    account: str
    client: str
    """What the page in charge calls itself."""
    connected: bool
    """Whether that page is there; while it is not, nobody is in charge and an engaged arm holds."""


class ExerciseView(msgspec.Struct, frozen=True, kw_only=True):
    """One exercise of the open session, as it begins."""

    game: str
    minutes: float
    level: float
    pinned: bool


class SessionView(msgspec.Struct, frozen=True, kw_only=True):
    """The open session in a line."""

    id: int
    patient: str
    exercises: tuple[ExerciseView, ...]
    affected_side: Side
    started: datetime
    elapsed_s: float
    phase: SessionPhase
    assist_level_most: float
    """The most help that this patient is allowed, 0..1."""
    authority: AuthorityView | None
    patient_screens: int
    """How many pages show the games to the patient now."""
    screen_lost: bool
    """The patient's screen was there and has gone: the games wait for it, or for a person to say that they go on."""


class LiveMessage(msgspec.Struct, frozen=True, kw_only=True):
    """One message of `/api/stream`; answered by `Acknowledgement` once it is drawn."""

    tick: LiveTick
    game: GameView | None
    session: SessionView | None


class Screen(StrEnum):
    """What kind of page looks."""

    PATIENT = "patient"
    DASHBOARD = "dashboard"


class Acknowledgement(msgspec.Struct, frozen=True, kw_only=True):
    """The page has taken the tick of that index and wants the next."""

    ack: int
    drawn_on: Screen | None = None
    """Where it has been drawn; None in a hidden window, which draws nothing and measures nothing."""
