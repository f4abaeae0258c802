"""The open session while it lasts: its phase and its game, stepped with every tick. No database, no clock."""

from __future__ import annotations

from dataclasses import dataclass
from datetime import datetime
from math import dist

from fusion.skeleton import Side
from games.catalogue import GAMES, open_game
from games.game import GameInput, GameSettings, GameView, Workspace
from games.programme import Exercise, Programme
from server.api.live import AuthorityView, SessionPhase, SessionView
from server.api.measured_range import RangeMeter
from server.messages import DemoGoal, DriveState, JointLimits, LiveTick, Point

_PHASES = {
    DriveState.OFF: SessionPhase.PREPARING,
    DriveState.READY: SessionPhase.PREPARING,
    DriveState.ENGAGED: SessionPhase.RUNNING,
    DriveState.HOLD: SessionPhase.HELD,
    DriveState.FAULT: SessionPhase.STOPPED,
    DriveState.STOPPED: SessionPhase.STOPPED,
}


@dataclass(frozen=True, slots=True)
class Plan:
    """What was decided when the session was opened."""

    id: int
    patient: str
    affected_side: Side
    game: str
    seed: int
    level: float
    limits: tuple[JointLimits, ...]
    assist_level_most: float
    """The most help that this patient is allowed, 0..1."""
    soft_margin_rad: float
    """The gate keeps commands so far inside the limits; targets must lie inside too."""
    started: datetime
    t_started_s: float
    """Monotonic."""


class Course:
    """What has become of the plan so far."""

    def __init__(self, plan: Plan) -> None:
        self.plan = plan
        self.saving = False
        self.interrupted = False
        self.closed = False
        """The station has let go of the patient; only storing is left."""
        self.picture: GameView | None = None
        self.meter: RangeMeter | None = None
        """Measures the patient's own range, once somebody has asked for it."""
        self._state = DriveState.OFF
        self._t_s = plan.t_started_s
        self._game: Programme | None = None

    def step(self, tick: LiveTick) -> GameView | None:
        """Take a tick; the game's picture, None until the arm was first engaged."""
        dt_s, self._t_s, self._state = max(0.0, tick.t_s - self._t_s), tick.t_s, tick.state
        if self.meter is not None:
            self.meter.take(tick)
        active = tick.state is DriveState.ENGAGED
        if self._game is None and active:
            self._game = _opened(self.plan, tick)
        if self._game is not None and not self.saving:
            hand = tick.affected.points_in_trunk[3]
            self.picture = self._game.step(GameInput(dt_s=dt_s, hand=hand, active=active))
        return self.picture

    @property
    def phase(self) -> SessionPhase:
        """Where the session stands."""
        if self.saving:
            return SessionPhase.SAVING
        return SessionPhase.INTERRUPTED if self.interrupted else _PHASES[self._state]

    def view(self, authority: AuthorityView | None) -> SessionView:
        """The session in a line."""
        plan = self.plan
        return SessionView(
            id=plan.id,
            patient=plan.patient,
            game=plan.game,
            affected_side=plan.affected_side,
            started=plan.started,
            elapsed_s=max(0.0, self._t_s - plan.t_started_s),
            phase=self.phase,
            assist_level_most=plan.assist_level_most,
            authority=authority,
        )


def warm_up() -> None:
    """Open every game once: what the first one loads and compiles must make no heartbeat late (SR-9)."""
    shoulder, reach_rad = (0.2, 0.0, 0.0), (0.1, 1.0)
    workspace = Workspace(Side.RIGHT, shoulder, 0.3, 0.3, reach_rad, reach_rad, reach_rad, reach_rad)
    for name in GAMES:
        open_game(name, workspace, 0, GameSettings())


def counted(picture: GameView | None) -> int:
    """How many targets the game has counted, collected or not."""
    return 0 if picture is None else picture.hits + picture.misses


def goal(course: Course | None, tick: LiveTick) -> DemoGoal:
    """Where the virtual patient's healthy hand should go, and where the exoskeleton holds the other."""
    sought = None if course is None else _sought(course.picture, tick)
    return DemoGoal(
        hand_in_trunk=None if sought is None else (-sought[0], sought[1], sought[2]),
        healthy_side=tick.healthy_side if course is None else course.plan.affected_side.other,
        exo_rad=tick.exo.angle_rad,
    )


def _sought(picture: GameView | None, tick: LiveTick) -> Point | None:
    """What the healthy hand mirrors: the game's aim, or the held arm, near which a movement may begin; None = rest."""
    if picture is None:
        return None
    if tick.state is not DriveState.ENGAGED:
        return tick.affected.points_in_trunk[-1]
    return picture.aim


def _opened(plan: Plan, tick: LiveTick) -> Programme:
    exercises = (Exercise(plan.game, GameSettings(start_level=plan.level)),)
    return Programme(exercises, _workspace(plan, tick), plan.seed)


def _workspace(plan: Plan, tick: LiveTick) -> Workspace:
    shoulder, elbow, _, hand = tick.affected.points_in_trunk
    ranges = {limits.joint: _inside(limits, plan.soft_margin_rad) for limits in plan.limits}
    return Workspace(
        side=plan.affected_side,
        shoulder=shoulder,
        upper_arm_m=dist(shoulder, elbow),
        forearm_m=dist(elbow, hand),
        plane_rad=ranges["plane"],
        elevation_rad=ranges["elevation"],
        rotation_rad=ranges["rotation"],
        elbow_rad=ranges["elbow"],
    )


def _inside(limits: JointLimits, margin_rad: float) -> tuple[float, float]:
    low, high = limits.min_rad + margin_rad, limits.max_rad - margin_rad
    middle = (limits.min_rad + limits.max_rad) / 2
    return (low, high) if low < high else (middle, middle)
