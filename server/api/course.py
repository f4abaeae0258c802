"""The open session while it lasts: its phase and its games, stepped with every tick. No database, no clock."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from datetime import datetime
from math import dist, inf
from pathlib import Path

from db.exercise import Exercise, PlayedExercise
from db.limits import PassiveRange
from db.workspace import SessionWorkspace
from fusion.skeleton import Side
from games.catalogue import GAMES
from games.game import GameSettings, GameView, Trial, Wish, Workspace
from games.programme import Exercise as GameExercise
from games.programme import Programme
from games.replay import GameRecord
from server.api.game_log_writer import GameLogWriter
from server.api.live import AuthorityView, ExerciseView, SessionPhase, SessionView
from server.api.measured_range import RangeMeter
from server.api.playing import Playing, as_games
from server.api.screen_watch import ScreenWatch
from server.api.workspace import ends
from server.api.workspace_meter import WorkspaceMeter
from server.messages import DriveState, JointLimits, LiveTick

_PHASES = {
    DriveState.OFF: SessionPhase.PREPARING,
    DriveState.READY: SessionPhase.PREPARING,
    DriveState.ENGAGED: SessionPhase.RUNNING,
    DriveState.HOLD: SessionPhase.HELD,
    DriveState.FAULT: SessionPhase.STOPPED,
    DriveState.STOPPED: SessionPhase.STOPPED,
}

ASKED_S = 3.0
"""So long after somebody last looked at what has been shown, the patient is still asked to show it."""


@dataclass(frozen=True, slots=True)
class Opening:
    """What was decided when the session was opened."""

    id: int
    patient: str
    affected_side: Side
    exercises: tuple[Exercise, ...]
    seed: int
    limits: tuple[JointLimits, ...]
    assist_level_most: float
    """The most help that this patient is allowed, 0..1."""
    allowed: PassiveRange
    """The limits less what the gate keeps of them; things must lie inside."""
    workspace: SessionWorkspace
    """Where things are placed unless the healthy arm shows otherwise."""
    game_log: Path
    started: datetime
    t_started_s: float
    """Monotonic."""


class Course:
    """What has become of the session so far."""

    def __init__(self, opening: Opening) -> None:
        self.opening = opening
        self.saving = False
        self.interrupted = False
        self.closed = False
        """The station has let go of the patient; only storing is left."""
        self.meter: RangeMeter | None = None
        """Measures the patient's own range, once somebody has asked for it."""
        self.shown = WorkspaceMeter()
        self.workspace = opening.workspace
        self.screens = ScreenWatch()
        self.playing: Playing | None = None
        """The games; they are opened when the arm is first engaged."""
        self.games_asked = False
        """The games are being opened, or open: what they begin with is decided."""
        self.games_broke = False
        """A game made a mistake of its own: the games stand still, and what was played is kept."""
        self._state = DriveState.OFF
        self._t_s = opening.t_started_s
        self._asked_s = -inf

    @property
    def picture(self) -> GameView | None:
        """How the games stand; None until the arm was first engaged."""
        return None if self.playing is None else self.playing.picture

    @property
    def played(self) -> tuple[PlayedExercise, ...]:
        """What has been played so far."""
        return () if self.playing is None else self.playing.played

    @property
    def trials(self) -> tuple[Trial, ...]:
        """Every attempt so far."""
        return () if self.playing is None else self.playing.trials

    def step(self, tick: LiveTick) -> GameView | None:
        """Take a tick; the games' picture, None until they are open."""
        dt_s, self._t_s, self._state = max(0.0, tick.t_s - self._t_s), tick.t_s, tick.state
        self.shown.take(tick)
        if self.meter is not None:
            self.meter.take(tick)
        engaged = tick.state is DriveState.ENGAGED
        if self.playing is not None and not self.saving and not self.games_broke:
            self.playing.step(tick, dt_s, active=engaged and not self.screens.is_lost)
        return self.picture

    def ask_to_show(self) -> None:
        """Somebody looks how far the healthy arm can go."""
        self._asked_s = self._t_s

    @property
    def is_asked_to_show(self) -> bool:
        """Whether the patient should show now how far the healthy arm can go."""
        return self.phase is SessionPhase.PREPARING and self._t_s - self._asked_s <= ASKED_S

    @property
    def lacks_games(self) -> bool:
        """The arm is engaged, and nobody has opened the games yet."""
        return self._state is DriveState.ENGAGED and not self.games_asked and not self.saving

    def open_games(self, tick: LiveTick) -> Playing:
        """The games at their beginning. Takes a while, as each thinks out what it will ask: call it in a thread."""
        opening = self.opening
        record = GameRecord(as_games(opening.exercises), _workspace(opening, self.workspace, tick), opening.seed)
        return Playing(record, GameLogWriter(opening.game_log, record))

    def see_screens(self, count: int) -> bool:
        """So many screens show the games now; True where the last of them has just gone, and the game pauses."""
        has_gone = self.screens.take(count)
        if has_gone and self.playing is not None:
            self.playing.wish(Wish.PAUSE)
        return has_gone

    @property
    def phase(self) -> SessionPhase:
        """Where the session stands."""
        if self.saving:
            return SessionPhase.SAVING
        return SessionPhase.INTERRUPTED if self.interrupted else _PHASES[self._state]

    def view(self, authority: AuthorityView | None) -> SessionView:
        """The session in a line."""
        opening = self.opening
        return SessionView(
            id=opening.id,
            patient=opening.patient,
            exercises=_listed(opening.exercises),
            affected_side=opening.affected_side,
            started=opening.started,
            elapsed_s=max(0.0, self._t_s - opening.t_started_s),
            phase=self.phase,
            assist_level_most=opening.assist_level_most,
            authority=authority,
            patient_screens=self.screens.count,
            screen_lost=self.screens.is_lost,
        )


def warm_up() -> None:
    """Open every game once: what the first one loads and compiles must make no heartbeat late (SR-9)."""
    shoulder, reach_rad = (0.2, 0.0, 0.0), (0.1, 1.0)
    workspace = Workspace(Side.RIGHT, shoulder, 0.3, 0.3, reach_rad, reach_rad, reach_rad, reach_rad)
    Programme(tuple(GameExercise(name, GameSettings()) for name in GAMES), workspace, 0)


def counted(picture: GameView | None) -> tuple[int, int]:
    """Which exercise it is, and how many attempts have ended in it."""
    return (0, 0) if picture is None else (picture.exercise, picture.hits + picture.misses)


def _listed(exercises: Sequence[Exercise]) -> tuple[ExerciseView, ...]:
    return tuple(
        ExerciseView(game=one.game, minutes=one.minutes, level=one.level or 0.0, pinned=one.pinned) for one in exercises
    )


def _workspace(opening: Opening, workspace: SessionWorkspace, tick: LiveTick) -> Workspace:
    shoulder, elbow, _, hand = tick.affected.points_in_trunk
    return Workspace(
        side=opening.affected_side,
        shoulder=shoulder,
        upper_arm_m=dist(shoulder, elbow),
        forearm_m=dist(elbow, hand),
        plane_rad=ends(workspace.used, "plane"),
        elevation_rad=ends(workspace.used, "elevation"),
        rotation_rad=ends(workspace.used, "rotation"),
        elbow_rad=ends(workspace.used, "elbow"),
    )
