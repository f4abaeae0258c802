"""Tracing: take up a light and carry it along a path through space to its end.

A trial is one path. It begins when a path lies there and ends when the light is at the end, or when its time is over.
The light goes with the hand while the hand is inside the tube about the path, and only forwards: to the point nearest
to the hand, as far as all of the path up to there is within the tube's radius of it. Where the hand leaves the tube the
light waits. So the whole path is followed inside the tube, or it is not finished; nothing is taken back.

Things: `light` at the light's place, its radius the tube's, its progress the share of the path that is done, its state
"waiting" (not taken up yet), "led" (the hand has it) or "left" (it waits for the hand); `end` at the path's end, its
progress the share of the time that is left. The way is the whole path. Feedback: "steady" for a light that was hardly
left on the whole way.
"""

from __future__ import annotations

from dataclasses import dataclass, replace
from math import ceil
from typing import Final

import numpy as np

from games.game import Point, ThingView, Workspace
from games.levels import between
from games.rules import Ended, PlayInput, SceneView
from games.trace.paths import path
from games.trace.polyline import Polyline
from games.workspace import distance_m

EASY_LENGTH_M, HARD_LENGTH_M = 0.35, 0.75
EASY_RADIUS_M, HARD_RADIUS_M = 0.09, 0.03
EASY_WINDING, HARD_WINDING = 1.05, 2.2
EASY_CORNERS, HARD_CORNERS = 3, 5
EASY_TIME_S, HARD_TIME_S = 14.0, 3.0
"""From the light's being taken up."""
EASY_PATIENCE_S, HARD_PATIENCE_S = 9.0, 5.0
"""How long a light waits to be taken up."""
BREATH_S: Final = 0.8
"""Between two paths: to see what was done, and what comes."""
SUBSTEP_M: Final = 0.01
"""A hand's way from one step to the next is gone in such pieces, so that few pictures count as many."""
MOST_SUBSTEPS: Final = 200
NEARLY_M: Final = 0.01
"""So near its end a path is done: nobody has to overshoot it."""
LEAD_M: Final = 0.08
"""The aim runs so far before the light."""
POINTS, LARGEST_BONUS = 10, 5
STEADY: Final = 0.95
"""Share of the time inside the tube that is called steady."""


@dataclass(frozen=True, slots=True)
class Demands:
    """What one path asks. Time to steer along a path grows with length over width [Accot and Zhai 1997]."""

    length_m: float
    radius_m: float
    """Of the tube about the path."""
    winding: float
    """The path's length over the straight way between its ends."""
    corners: int
    time_s: float
    patience_s: float


@dataclass(frozen=True, slots=True)
class Tracing:
    """The path that lies there, and how it goes."""

    number: int
    line: Polyline
    demands: Demands
    hand: Point
    """As it was at the last step."""
    way: tuple[Point, ...]
    """The path as it is drawn."""
    taken_up: bool = False
    done_m: float = 0.0
    """How far along the path the light is."""
    waited_s: float = 0.0
    led_s: float = 0.0
    inside_s: float = 0.0
    """Of `led_s`, inside the tube."""
    off_m_s: float = 0.0
    """The hand's distance from the path, summed over `led_s`."""
    away_m: float = 0.0
    """Of the hand from the path where the light is."""

    @property
    def inside(self) -> bool:
        """Whether the hand is in the tube where the light is."""
        return self.away_m <= self.demands.radius_m


def demands(level: float) -> Demands:
    """What a path asks at a level in 0..1: longer, narrower, more winding, less patient."""
    return Demands(
        length_m=between(EASY_LENGTH_M, HARD_LENGTH_M, level),
        radius_m=between(EASY_RADIUS_M, HARD_RADIUS_M, level),
        winding=between(EASY_WINDING, HARD_WINDING, level),
        corners=round(between(EASY_CORNERS, HARD_CORNERS, level)),
        time_s=between(EASY_TIME_S, HARD_TIME_S, level),
        patience_s=between(EASY_PATIENCE_S, HARD_PATIENCE_S, level),
    )


class TraceRules:
    """The rules in progress.

    Args:
        workspace: where the hand can go.
        rng: makes the paths.
    """

    def __init__(self, workspace: Workspace, rng: np.random.Generator) -> None:
        self._workspace, self._rng = workspace, rng
        self._trial: Tracing | None = None
        self._paths = 0
        self._breath_s = 0.0

    def step(self, given: PlayInput) -> tuple[Ended, ...]:
        """Advance by `given.dt_s`; the path that was finished or given up, if one was."""
        if self._trial is None:
            self._breath_s -= given.dt_s
            if self._breath_s <= 0.0:
                self._trial = self._drawn(given)
            return ()
        trial = self._trial = _followed(self._trial, given.hand, given.dt_s)
        if not (_is_finished(trial) or _is_late(trial)):
            return ()
        self.clear()
        return (_ended(trial),)

    def scene(self) -> SceneView:
        """The path with its light, or nothing between two."""
        trial = self._trial
        if trial is None:
            return SceneView(0, (), None)
        return SceneView(trial.number, _things(trial), _aim(trial), trial.way)

    def clear(self) -> None:
        """Take the path away."""
        self._trial, self._breath_s = None, BREATH_S

    def _drawn(self, given: PlayInput) -> Tracing:
        self._paths += 1
        asked = demands(given.level)
        line = path(self._workspace, asked.length_m, asked.winding, asked.corners, given.hand, self._rng)
        way = tuple((round(x, 4), round(y, 4), round(z, 4)) for x, y, z in line.points.tolist())
        return Tracing(self._paths, line, asked, given.hand, way)


def _followed(trial: Tracing, hand: Point, dt_s: float) -> Tracing:
    """One step later, the hand's way gone piece by piece until the path is finished or its time over."""
    pieces = min(max(ceil(distance_m(trial.hand, hand) / SUBSTEP_M), 1), MOST_SUBSTEPS)
    for x, y, z in np.linspace(trial.hand, hand, pieces + 1)[1:].tolist():
        trial = _moved(replace(trial, hand=(x, y, z)), dt_s / pieces)
        if _is_finished(trial) or _is_late(trial):
            break
    return trial


def _moved(trial: Tracing, dt_s: float) -> Tracing:
    """One piece later: the light goes on with a hand inside the tube."""
    until_m = trial.line.stays_until(trial.hand, trial.done_m, trial.demands.radius_m)
    along_m, away_m = trial.line.nearest(trial.hand, trial.done_m, until_m)
    trial = replace(trial, away_m=away_m, taken_up=trial.taken_up or away_m <= trial.demands.radius_m)
    if not trial.taken_up:
        return replace(trial, waited_s=trial.waited_s + dt_s)
    _, off_m = trial.line.nearest(trial.hand, 0.0, trial.line.length_m)
    return replace(
        trial,
        done_m=along_m if trial.inside else trial.done_m,
        led_s=trial.led_s + dt_s,
        inside_s=trial.inside_s + (dt_s if trial.inside else 0.0),
        off_m_s=trial.off_m_s + off_m * dt_s,
    )


def _is_finished(trial: Tracing) -> bool:
    return trial.taken_up and trial.done_m >= trial.line.length_m - NEARLY_M


def _is_late(trial: Tracing) -> bool:
    return trial.led_s >= trial.demands.time_s or trial.waited_s >= trial.demands.patience_s


def _ended(trial: Tracing) -> Ended:
    """What became of a path; the more of the time was inside the tube, the more points."""
    inside = trial.inside_s / trial.led_s if trial.led_s > 0.0 else 0.0
    error_m = trial.off_m_s / trial.led_s if trial.led_s > 0.0 else None
    if not _is_finished(trial):
        return Ended(success=False, points=0, error_m=error_m)
    said = ("steady",) if inside >= STEADY else ()
    return Ended(success=True, points=POINTS + round(LARGEST_BONUS * inside), error_m=error_m, feedback=said)


def _aim(trial: Tracing) -> Point:
    """Ahead of a light that is led, else the light itself."""
    led = trial.taken_up and trial.inside
    return trial.line.at(trial.done_m + (LEAD_M if led else 0.0))


def _things(trial: Tracing) -> tuple[ThingView, ThingView]:
    radius_m, length_m = trial.demands.radius_m, trial.line.length_m
    state = "waiting" if not trial.taken_up else "led" if trial.inside else "left"
    left = 1.0 - min(trial.led_s / trial.demands.time_s, 1.0)
    light = ThingView(2 * trial.number, "light", trial.line.at(trial.done_m), radius_m, trial.done_m / length_m, state)
    return light, ThingView(2 * trial.number + 1, "end", trial.line.at(length_m), radius_m, left)
