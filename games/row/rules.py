"""Rowing: both hands reach ahead and pull back together, and the boat glides on; alike hands steer it straight.

An attempt is one stroke. It succeeds where the shown hand came to both ends in time and the two hands went alike: the
mean distance between the shown hand and the mirror image of the healthy one is what the level allows. Where the healthy
hand was not seen most of the time, nothing is said about likeness and the shown hand alone decides.

While the exoskeleton moves the shown hand after the healthy one (passive mode), likeness measures the drive.

Things of its scene:
    "catch": where the stroke begins, ahead. "finish": where it ends. `radius_m`: so near is there. `progress` 0..1 of
        the time for the stroke that has passed. `state` "now" for the end to go to, "done", or "later". Both are the
        shown hand's; the healthy hand's are their mirror images.
    "boat": `position` (0, 0, −metres gone), `progress` its speed over the fastest there is, `turn_rad` where its bow
        points (to the left is positive), `state` "even", "left" or "right" for the hand that hangs back, or "unseen"
        while the healthy hand is not seen.

Feedback of its own: "even" for a stroke much more alike than was asked, "uneven" where only likeness was missing.
"""

from __future__ import annotations

from typing import Final

import numpy as np

from fusion.skeleton import Side
from games.even_steps import STEP_S, EvenSteps, Moment
from games.game import Point, ThingView, Workspace
from games.row.boat import FASTEST_M_S, Boat
from games.row.course import longest_course
from games.row.stroke import Stroke, demands
from games.rules import Ended, PlayInput, SceneView

PAUSE_S: Final = 0.8
"""The boat glides between two strokes."""
POINTS, EVEN_POINTS = 10, 2
EVEN_SHARE: Final = 0.5
"""Less than this share of what is allowed is called even."""
HANGS_BACK_M: Final = 0.05
"""A hand this far behind the other is said to hang back."""
BOAT_ID: Final = 1


class RowRules:
    """The strokes, one after the other, and the boat they drive.

    Args:
        workspace: where the hand can go.
        rng: draws the course, which stays the same: rowing is a rhythm.
    """

    def __init__(self, workspace: Workspace, rng: np.random.Generator) -> None:
        self._course = longest_course(workspace, rng)
        self._shown = workspace.side
        self._steps = EvenSteps()
        self._boat = Boat()
        self._stroke: Stroke | None = None
        self._count = 0
        self._pause_steps = 0
        self._way: tuple[Point, ...] = ()
        """From end to end of the newest stroke."""
        self._ahead_m: float | None = None
        """How much further on its way the shown hand is than the healthy one; None = not seen."""

    def step(self, given: PlayInput) -> tuple[Ended, ...]:
        """Advance by `given.dt_s`; the strokes that ended."""
        ended = [self._stepped(moment, given.level) for moment in self._steps.take(given)]
        return tuple(one for one in ended if one is not None)

    def scene(self) -> SceneView:
        """What is to be drawn now."""
        boat, stroke = self._boat_view(), self._stroke
        if stroke is None:
            return SceneView(0, (boat,), None, self._way)
        return SceneView(stroke.number, (boat, *_end_views(stroke)), stroke.aim, self._way)

    def clear(self) -> None:
        """The round is over: the boat lies still."""
        self._stroke, self._ahead_m, self._pause_steps = None, None, 0
        self._boat = Boat(self._boat.gone_m)
        self._steps.forget()

    def _stepped(self, moment: Moment, level: float) -> Ended | None:
        """One even step."""
        if self._stroke is None:
            self._boat = self._boat.later(0.0, 0.0, STEP_S)
            self._pause_steps -= 1
            if self._pause_steps <= 0:
                self._stroke = self._next_stroke(level)
            return None
        stroke = self._stroke.later(moment)
        self._drive(self._stroke, stroke, moment)
        ended = _outcome(stroke, moment.hand)
        self._stroke = stroke if ended is None else None
        if ended is not None:
            self._pause_steps = round(PAUSE_S / STEP_S)
        return ended

    def _next_stroke(self, level: float) -> Stroke:
        self._count += 1
        asked = demands(level)
        catch, finish = self._course.ends(asked.length)
        self._way = (catch, finish)
        return Stroke(self._count, catch, finish, asked)

    def _drive(self, before: Stroke, after: Stroke, moment: Moment) -> None:
        """Pulling drives the boat; the hand that has pulled more turns it to the other side."""
        self._ahead_m = _ahead_m(after, moment)
        pulled_m = (after.pulled - before.pulled) * after.length_m
        leftwards_m = (self._ahead_m or 0.0) * (1.0 if self._shown is Side.RIGHT else -1.0)
        self._boat = self._boat.later(pulled_m, leftwards_m if after.has_caught else 0.0, STEP_S)

    def _boat_view(self) -> ThingView:
        boat = self._boat
        share = boat.speed_m_s / FASTEST_M_S
        return ThingView(BOAT_ID, "boat", (0.0, 0.0, -boat.gone_m), 0.0, share, self._hanging_back(), boat.turn_rad)

    def _hanging_back(self) -> str:
        """Which hand hangs back, if any."""
        if self._ahead_m is None:
            return "unseen" if self._stroke is not None and self._stroke.steps > 0 else "even"
        if abs(self._ahead_m) < HANGS_BACK_M:
            return "even"
        return str(self._shown.other if self._ahead_m > 0.0 else self._shown)


def _ahead_m(stroke: Stroke, moment: Moment) -> float | None:
    """How much further the shown hand is than the healthy one, on the way ahead or, pulling, on the way back."""
    if moment.healthy_hand is None:
        return None
    further_back_m = moment.hand[2] - moment.healthy_hand[2]
    return further_back_m if stroke.has_caught else -further_back_m


def _outcome(stroke: Stroke, hand: Point) -> Ended | None:
    """Whole and alike, not so, or None while the stroke goes on."""
    whole = stroke.is_at_finish(hand)
    if not whole and stroke.time_share < 1.0:
        return None
    error_m = stroke.apart_m
    if not whole or not stroke.is_alike:
        return Ended(False, 0, error_m=error_m, feedback=("uneven",) if whole else ())
    is_even = error_m is not None and error_m <= EVEN_SHARE * stroke.demands.apart_m
    points, said = (POINTS + EVEN_POINTS, ("even",)) if is_even else (POINTS, ())
    return Ended(True, points, error_m=error_m, feedback=said)


def _end_views(stroke: Stroke) -> tuple[ThingView, ThingView]:
    """The two ends of a stroke; their ids follow its number, after the boat's."""
    first_id, share = 2 * stroke.number, stroke.time_share
    states = ("done", "now") if stroke.has_caught else ("now", "later")
    catch = ThingView(first_id, "catch", stroke.catch, stroke.radius_m, share, states[0])
    return catch, ThingView(first_id + 1, "finish", stroke.finish, stroke.radius_m, share, states[1])
