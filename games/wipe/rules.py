"""Wiping: clear a misted pane, patch by patch, until the whole picture behind it is seen.

The pane lies through the reachable space. Where the hand is near it, the cells under the hand become clear, in the
patch and beside it. A trial is one patch, to be cleared in its time; what stays misted then is part of a later patch.
Patches begin in the middle of the pane and go outwards, and every further picture reaches nearer to the rim.

Things: "pane": its middle, half the side of a cell (`radius_m`), its lean (`turn_rad`, upper edge away from the eyes),
the share that is clear (`progress`), and each cell (`state`): rows from the top, left to right, joined by "/", a cell
being "0" (mist) to "9" (clear), or "." where it is not to be wiped; another picture is another id. "cell": one of the
patch, its progress how clear it is. "wiper": the point of the pane under the hand, its radius what is wiped, its state
"on" or, where the hand is too far from the pane, "off"; its progress how near the hand is. "timer": its progress is
the share of the time that is gone. Feedback: "wiped", and "picture" when all is clear.
"""

from __future__ import annotations

from dataclasses import dataclass, replace
from math import pi
from typing import Final

import numpy as np
from numpy.typing import NDArray

from fusion.skeleton import Side
from games.even_steps import STEP_S, EvenSteps
from games.game import Point, ThingView, Workspace
from games.levels import between
from games.rules import Ended, PlayInput, SceneView
from games.wipe.mist import Mist, mist
from games.wipe.pane import COLUMNS, TILT_RAD, pane

EASY_CELLS, HARD_CELLS = 7, 20
EASY_WIPER_M: Final = 0.07
EASY_WIPER_CELLS, HARD_WIPER_CELLS = 2.0, 0.7
"""Radius of what the hand wipes: at level 0, there no more than so many sides of a cell; and at level 1 in these."""
EASY_OFF_M, HARD_OFF_M = 0.15, 0.05
"""The hand wipes this far before the pane ..."""
BEHIND: Final = 2.0
"""... and so many times as far behind it: nothing stops a hand there."""
EASY_RUB_S, HARD_RUB_S = 0.25, 0.3
"""How long a cell is rubbed until it is clear."""
EASY_PACE_M_S, HARD_PACE_M_S = 0.04, 0.6
EASY_SPARE_S, HARD_SPARE_S = 6.0, 0.5
"""A patch's time is for rubbing as many cells at once as the wiper covers, for the way at the pace, and this on top."""
BREATH_S: Final = 0.7
"""Between two patches."""
LOOK_S: Final = 4.0
"""To look at a picture that is clear."""
FIRST_SHARE, SHARE_MORE = 0.7, 0.15
"""Of the cells in reach, those nearest the middle: in the first picture, and more in each further one."""
POINTS: Final = 3
"""With one more for each cell of the patch."""
FAR: Final = 0.3
"""Of the way from the hand, beside the way from the middle, where the next patch is chosen."""

UNDER_M: Final = 1.0
"""What a cell under the hand costs: a patch that begins there would be wiped by a hand at rest."""


@dataclass(frozen=True, slots=True)
class Patch:
    """The part of the pane that is to be cleared now, and how it goes."""

    number: int
    cells: tuple[int, ...]
    first_id: int
    """Of its cells' things; the timer's is before it."""
    wiper_m: float
    off_m: float
    rub_s: float
    time_s: float
    aim: int
    """The cell where the hand is best brought now."""
    age_s: float = 0.0
    over_s: float = 0.0
    """How long the hand was over cells of the patch ..."""
    off_m_s: float = 0.0
    """... and its distance from the pane, summed over that."""


class WipeRules:
    """The rules in progress.

    Args:
        workspace: where the hand can go.
        rng: lays the pane and chooses the patches.
    """

    def __init__(self, workspace: Workspace, rng: np.random.Generator) -> None:
        self._rng, self._side = rng, workspace.side
        self._pane = pane(workspace, rng)
        self._easy_wiper_m = min(EASY_WIPER_M, EASY_WIPER_CELLS * self._pane.cell_m)
        self._time = EvenSteps()
        self._patch: Patch | None = None
        self._hand: Point = self._pane.centre
        self._patches = self._pictures = self._ids = 0
        self._breath_s = 0.0
        self._wiper_id = self._new_ids(1)
        self._mist = self._new_mist()

    def step(self, given: PlayInput) -> tuple[Ended, ...]:
        """Advance by `given.dt_s`; the patches that were cleared or given up."""
        return tuple(ended for moment in self._time.take(given) for ended in self._stepped(moment.hand, given.level))

    def scene(self) -> SceneView:
        """The pane, the patch and the wiper."""
        patch = self._patch
        if patch is None:
            return SceneView(0, (self._drawn(),), None)
        things = (self._drawn(), *self._cells(patch), self._wiper(patch), _timer(patch))
        x, y, z = self._pane.aims[patch.aim].tolist()
        return SceneView(patch.number, things, (x, y, z))

    def clear(self) -> None:
        """The patch is taken back; what is clear stays clear."""
        self._time.forget()
        self._let_go(BREATH_S)

    def _stepped(self, hand: Point, level: float) -> tuple[Ended, ...]:
        self._hand = hand
        if self._patch is None:
            self._breath_s -= STEP_S
            if self._breath_s <= 0.0:
                self._patch = self._begun(level)
            return ()
        patch = self._patch = self._wiped(self._patch)
        if (self._mist.clear_of(patch.cells) >= 1.0).all():
            return self._cleared(patch)
        if patch.age_s < patch.time_s:
            return ()
        self._let_go(BREATH_S)
        return (Ended(success=False, points=0, error_m=_error_m(patch)),)

    def _begun(self, level: float) -> Patch:
        """The next patch, on a picture of its own where this one is clear."""
        if not self._mist.left.size:
            self._mist = self._new_mist()
        cells = self._chosen(round(between(EASY_CELLS, HARD_CELLS, level)))
        aim, cell_m = self._nearest(cells), self._pane.cell_m
        wiper_m = between(self._easy_wiper_m, HARD_WIPER_CELLS * cell_m, level)
        rub_s = between(EASY_RUB_S, HARD_RUB_S, level)
        way_m = float(np.linalg.norm(self._pane.places[aim] - self._hand)) + (len(cells) - 1) * cell_m
        at_once = max(pi * (wiper_m / cell_m) ** 2, 1.0)
        self._patches += 1
        return Patch(
            number=self._patches,
            cells=cells,
            first_id=self._new_ids(len(cells) + 1) + 1,
            wiper_m=wiper_m,
            off_m=between(EASY_OFF_M, HARD_OFF_M, level),
            rub_s=rub_s,
            time_s=len(cells) / at_once * rub_s
            + way_m / between(EASY_PACE_M_S, HARD_PACE_M_S, level)
            + between(EASY_SPARE_S, HARD_SPARE_S, level),
            aim=aim,
        )

    def _chosen(self, count: int) -> tuple[int, ...]:
        """A misted cell near the middle and the hand, yet not under it, and the misted cells nearest to it."""
        misted, places = self._mist.left, self._pane.places
        from_hand_m = np.linalg.norm(places - np.asarray(self._hand), axis=1)
        noise_m = self._rng.uniform(0.0, self._pane.cell_m, len(places))
        aside_m = np.linalg.norm(places - np.asarray(self._pane.on(self._hand)), axis=1)
        under_m = np.where(aside_m <= self._easy_wiper_m, UNDER_M, 0.0)
        cost = self._pane.from_centre_m() + FAR * from_hand_m + noise_m + under_m
        seed = int(misted[np.argmin(cost[misted])])
        from_seed_m = np.linalg.norm(places[misted] - places[seed], axis=1)
        nearest = misted[np.argsort(from_seed_m, kind="stable")[:count]]
        return tuple(int(cell) for cell in nearest)

    def _wiped(self, patch: Patch) -> Patch:
        """`STEP_S` of wiping."""
        under, off_m = self._under(patch), self._pane.beyond_m(self._hand)
        if -patch.off_m <= off_m <= BEHIND * patch.off_m:
            self._mist = self._mist.wiped(under, STEP_S / patch.rub_s)
        over = bool(under[list(patch.cells)].any())
        left = tuple(cell for cell in patch.cells if self._mist.clear[cell] < 1.0)
        aim = patch.aim if patch.aim in left or not left else self._nearest(left)
        return replace(
            patch,
            aim=aim,
            age_s=patch.age_s + STEP_S,
            over_s=patch.over_s + (STEP_S if over else 0.0),
            off_m_s=patch.off_m_s + (STEP_S * abs(off_m) if over else 0.0),
        )

    def _under(self, patch: Patch) -> NDArray[np.bool_]:
        """(cells,) whether each is under the hand."""
        aside_m = np.linalg.norm(self._pane.places - np.asarray(self._pane.on(self._hand)), axis=1)
        return np.asarray(aside_m <= patch.wiper_m)

    def _cleared(self, patch: Patch) -> tuple[Ended, ...]:
        done = not self._mist.left.size
        self._let_go(LOOK_S if done else BREATH_S)
        said = ("wiped", "picture") if done else ("wiped",)
        return (Ended(True, POINTS + len(patch.cells), _error_m(patch), feedback=said),)

    def _nearest(self, cells: tuple[int, ...]) -> int:
        """The cell nearest to the hand."""
        ways_m = np.linalg.norm(self._pane.places[list(cells)] - np.asarray(self._hand), axis=1)
        return cells[int(np.argmin(ways_m))]

    def _new_mist(self) -> Mist:
        """Mist on the cells in reach that are nearest to the middle, on more of them with every picture."""
        share = min(FIRST_SHARE + SHARE_MORE * self._pictures, 1.0)
        within = np.flatnonzero(self._pane.is_reachable)
        inner = within[np.argsort(self._pane.from_centre_m()[within], kind="stable")]
        in_play = np.zeros(len(self._pane.places), bool)
        in_play[inner[: max(1, round(share * len(inner)))]] = True
        self._pictures += 1
        return mist(self._new_ids(1), in_play)

    def _let_go(self, breath_s: float) -> None:
        self._patch, self._breath_s = None, breath_s

    def _new_ids(self, count: int) -> int:
        """The first of so many new ids."""
        first, self._ids = self._ids + 1, self._ids + count
        return first

    def _drawn(self) -> ThingView:
        fog, cell_m = self._mist, self._pane.cell_m
        signs = fog.signs(COLUMNS, backwards=self._side is Side.LEFT)
        return ThingView(fog.id, "pane", self._pane.centre, cell_m / 2.0, fog.share, signs, TILT_RAD)

    def _cells(self, patch: Patch) -> tuple[ThingView, ...]:
        places, half_m = self._pane.places[list(patch.cells)].tolist(), self._pane.cell_m / 2.0
        clear = self._mist.clear_of(patch.cells).tolist()
        cells = enumerate(zip(places, clear, strict=True))
        return tuple(ThingView(patch.first_id + k, "cell", (x, y, z), half_m, c) for k, ((x, y, z), c) in cells)

    def _wiper(self, patch: Patch) -> ThingView:
        off_m = self._pane.beyond_m(self._hand)
        near = 1.0 - min(max(off_m / BEHIND, -off_m) / patch.off_m, 1.0)
        state = "on" if near > 0.0 else "off"
        return ThingView(self._wiper_id, "wiper", self._pane.on(self._hand), patch.wiper_m, near, state)


def _error_m(patch: Patch) -> float | None:
    """How far the hand was from the pane while it was over the patch, on average."""
    return patch.off_m_s / patch.over_s if patch.over_s > 0.0 else None


def _timer(patch: Patch) -> ThingView:
    gone = min(patch.age_s / patch.time_s, 1.0)
    return ThingView(patch.first_id - 1, "timer", (0.0, 0.0, 0.0), patch.wiper_m, gone)
