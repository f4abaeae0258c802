"""Everyday tasks at a kitchen table: fill the cup, drink from it and put it back, build a tower of blocks.

No sensor tells whether a hand grasps. To take a thing is to stay at it; from then on it goes with the hand; to set it
down is to stay where it is wanted. A trial is one task with all its steps in its time: pour (take the jug, hold it over
the cup, put it back), drink (take the cup, hold it at the mouth, put it back), stack (take a block, set it on the
tower). Where the time is over the thing is back at its place and the next task comes; when all are done, another table
is set.

Things: "cup" (its progress is how full it is), "jug", and the blocks "cube", "barrel" and, on top, "roof"; state
"standing", "wanted" (to be taken now), "held" (it goes with the hand) or "stacked". "base": where the tower is to
stand. "goal" is where the hand is to stay
now, its progress the stay, its state the step: "take", "drink", "pour", "put" or "stack". "timer": its progress is the
share of the time that is gone. Feedback: "poured", "drunk", "stacked", and "tower" with the last block.
"""

from __future__ import annotations

from dataclasses import dataclass, replace
from typing import Final

import numpy as np

from games.dwell import spread_m
from games.even_steps import STEP_S, EvenSteps
from games.everyday.errand import Errand, Stay, time_for
from games.everyday.kitchen import Kitchen, kitchen
from games.game import Point, ThingView, Workspace
from games.levels import between
from games.rules import Ended, PlayInput, SceneView

EASY_RADIUS_M, HARD_RADIUS_M = 0.09, 0.04
EASY_TAKE_S, HARD_TAKE_S = 0.4, 0.5
EASY_HOLD_S, HARD_HOLD_S = 0.8, 2.0
"""At the mouth, and over the cup."""
EASY_PUT_S, HARD_PUT_S = 0.4, 0.8
EASY_PACE_M_S, HARD_PACE_M_S = 0.05, 0.6
"""The time of a task is what its ways take at this pace ..."""
EASY_SPARE_S, HARD_SPARE_S = 1.8, 0.3
"""... with its stays, and this for each of them."""
BREATH_S: Final = 0.8
"""Between two tasks: to see what was done, and what comes."""
POINTS: Final = {"pour": 15, "drink": 15, "stack": 10}
"""More for three steps than for two."""
SAID: Final = {"pour": "poured", "drink": "drunk", "stack": "stacked"}
SHAPES: Final = ("cube", "barrel")


@dataclass(frozen=True, slots=True)
class Thing:
    """What stands on the table."""

    id: int
    kind: str
    place: Point
    """Of the hand that takes it, or that has set it down."""
    stacked: bool = False


class EverydayRules:
    """The rules in progress.

    Args:
        workspace: where the hand can go.
        rng: sets the tables.
    """

    def __init__(self, workspace: Workspace, rng: np.random.Generator) -> None:
        self._workspace, self._rng = workspace, rng
        self._time = EvenSteps()
        self._kitchen: Kitchen | None = None
        self._things: dict[int, Thing] = {}
        self._todo: list[tuple[str, int]] = []
        self._errand: Errand | None = None
        self._hold_m: float | None = None
        self._full = 0.0
        """How full the cup is while nobody pours or drinks."""
        self._ids = self._tasks = 0
        self._goal = self._timer = 0
        self._breath_s = 0.0

    def step(self, given: PlayInput) -> tuple[Ended, ...]:
        """Advance by `given.dt_s`; the tasks that were done or given up."""
        return tuple(ended for moment in self._time.take(given) for ended in self._stepped(moment.hand, given.level))

    def scene(self) -> SceneView:
        """The table, and what is to be done."""
        errand = self._errand
        things = tuple(self._drawn(thing) for thing in self._things.values())
        if errand is None:
            return SceneView(0, things, None)
        return SceneView(errand.number, (*things, *self._asked(errand)), errand.stay.place)

    def clear(self) -> None:
        """Put back what the hand carries; it will be asked for again."""
        if self._errand is not None:
            self._todo.insert(0, (self._errand.name, self._errand.thing))
        self._time.forget()
        self._let_go()

    def _stepped(self, hand: Point, level: float) -> tuple[Ended, ...]:
        if self._errand is None:
            self._breath_s -= STEP_S
            if self._breath_s <= 0.0:
                self._begin(hand, level)
            return ()
        errand = self._errand = self._errand.after(hand)
        if errand.is_stayed:
            return self._went_on(errand)
        if errand.gone < 1.0:
            return ()
        self._let_go()
        return (Ended(success=False, points=0),)

    def _begin(self, hand: Point, level: float) -> None:
        """The next task, on another table where all is done."""
        table = self._kitchen
        if table is None or not self._todo:
            table = self._set_table(level)
        name, thing = self._todo.pop(0)
        stays = self._stays(name, self._things[thing], table, level)
        pace_m_s, spare_s = between(EASY_PACE_M_S, HARD_PACE_M_S, level), between(EASY_SPARE_S, HARD_SPARE_S, level)
        self._tasks += 1
        self._errand = Errand(self._tasks, name, thing, stays, time_for(hand, stays, pace_m_s, spare_s), hand)
        self._goal, self._timer, self._hold_m = self._new_id(), self._new_id(), None
        if name == "drink":  # where pouring failed somebody else has filled it
            self._full = 1.0

    def _set_table(self, level: float) -> Kitchen:
        """Another table: first the cup is filled and drunk, then the tower is built."""
        table = self._kitchen = kitchen(self._workspace, level, self._rng)
        self._full = 0.0
        shapes = [SHAPES[k % len(SHAPES)] for k in range(len(table.blocks) - 1)]
        base = ("base", table.tower[0])
        made = [base, ("cup", table.cup), ("jug", table.jug), *zip((*shapes, "roof"), table.blocks, strict=True)]
        things = [Thing(self._new_id(), kind, place) for kind, place in made]
        self._things = {thing.id: thing for thing in things}
        _, cup, jug, *blocks = things
        self._todo = [("pour", jug.id), ("drink", cup.id), *(("stack", block.id) for block in blocks)]
        return table

    def _stays(self, name: str, thing: Thing, table: Kitchen, level: float) -> tuple[Stay, ...]:
        radius_m = between(EASY_RADIUS_M, HARD_RADIUS_M, level)
        take = Stay("take", thing.place, radius_m, between(EASY_TAKE_S, HARD_TAKE_S, level))
        hold_s, put_s = between(EASY_HOLD_S, HARD_HOLD_S, level), between(EASY_PUT_S, HARD_PUT_S, level)
        if name == "stack":
            height = sum(other.stacked for other in self._things.values())
            return take, Stay("stack", table.tower[height], radius_m, put_s)
        place = table.mouth if name == "drink" else table.over_cup
        return take, Stay(name, place, radius_m, hold_s), Stay("put", thing.place, radius_m, put_s)

    def _went_on(self, errand: Errand) -> tuple[Ended, ...]:
        """A stay is complete: on to the next, or the task is done."""
        if errand.stay.verb in SAID:
            self._hold_m = spread_m(errand.inside)
            self._full = {"pour": 1.0, "drink": 0.0}.get(errand.name, self._full)
        if not errand.is_last:
            self._errand, self._goal = errand.next(), self._new_id()
            return ()
        self._let_go()
        said = self._set_down(errand)
        return (Ended(True, POINTS[errand.name], errand.off_m, self._hold_m, said),)

    def _set_down(self, errand: Errand) -> tuple[str, ...]:
        """Leave the thing where it was brought; what is said to that."""
        said = SAID[errand.name]
        if errand.name != "stack":
            return (said,)
        thing = self._things[errand.thing]
        self._things[thing.id] = replace(thing, place=errand.stay.place, stacked=True)
        return (said,) if self._todo else (said, "tower")

    def _let_go(self) -> None:
        self._errand, self._breath_s = None, BREATH_S

    def _new_id(self) -> int:
        self._ids += 1
        return self._ids

    def _drawn(self, thing: Thing) -> ThingView:
        errand, place = self._errand, thing.place
        state = "stacked" if thing.stacked else "standing"
        if errand is not None and errand.thing == thing.id:
            state, place = ("held", errand.hand) if errand.at else ("wanted", place)
        return ThingView(thing.id, thing.kind, place, EASY_RADIUS_M, self._fullness(thing), state)

    def _fullness(self, thing: Thing) -> float:
        """Of the cup: it fills while the jug is held over it, and empties at the mouth."""
        if thing.kind != "cup":
            return 0.0
        errand = self._errand
        pouring = errand.progress if errand is not None and errand.stay.verb == "pour" else 0.0
        drinking = errand.progress if errand is not None and errand.stay.verb == "drink" else 0.0
        return max(self._full - drinking, pouring)

    def _asked(self, errand: Errand) -> tuple[ThingView, ThingView]:
        stay = errand.stay
        goal = ThingView(self._goal, "goal", stay.place, stay.radius_m, errand.progress, stay.verb)
        return goal, ThingView(self._timer, "timer", stay.place, stay.radius_m, errand.gone)
