"""[Shi, Tables 1 and 2, Fig. 5]: a tag stands while somebody walks around it."""

from __future__ import annotations

from typing import TYPE_CHECKING, Final

import numpy as np

from fusion.experiments.experiment import Chapter, Experiment, Setup
from fusion.experiments.outcome import NOT_GIVEN, Beside, Cell, Column, Outcome, Picture, Table
from fusion.experiments.palette import FUSED, OTHER, SECOND, TRUTH
from fusion.messages import Floats
from fusion.ranging.experiment import MIDDLE, RATE_HZ, somebody_walks_around
from fusion.ranging.experiment import Outcome as Lap

if TYPE_CHECKING:
    from matplotlib.figure import Figure

LAPS: Final = 10
FAR_M: Final = 50.0
"""Somebody who walks so far away blocks nothing."""
PAPER: Final = {"alone": ((100, 150), (110, 150)), "joined": ((125, 135), (125, 140))}
"""cm, the ranges in x and y that the paper reads off its Fig. 5."""
OURS: Final = "somebody in the way, joined by ours"
SHARE: Final = (0.5, 99.5)
"""Percentiles: the range that 99 % of the instants keep to."""


def run(setup: Setup) -> Outcome:
    """Ten laps with somebody in the way, and as many in line of sight."""
    seeds = tuple(setup.seed + k for k in range(setup.many(LAPS)))
    clear, laps = [], []
    for k, seed in enumerate(seeds):
        clear.append(somebody_walks_around(seed, radius_m=FAR_M))
        laps.append(somebody_walks_around(seed))
        setup.progress((k + 1) / len(seeds))
    courses = {
        "line of sight, radio alone": [lap.radio_alone for lap in clear],
        "somebody in the way, radio alone": [lap.radio_alone for lap in laps],
        "somebody in the way, joined": [lap.joined for lap in laps],
        OURS: [lap.mended for lap in laps],
    }
    return Outcome(
        (
            *_beside("radio alone", courses["somebody in the way, radio alone"]),
            *_beside("joined by the paper's rule", courses["somebody in the way, joined"]),
            *_beside("joined by ours", courses[OURS]),
        ),
        (_table(courses),),
        (Picture("standing", _CAPTION, lambda figure: _draw(figure, clear[0], laps[0]), height_in=4.4),),
        _WHY,
        seeds,
    )


def _beside(name: str, runs: list[Floats]) -> tuple[Beside, ...]:
    paper = PAPER["alone" if name == "radio alone" else "joined"]
    return tuple(
        Beside(
            f"{name}: {'xy'[axis]} stays within (99 %)",
            f"{paper[axis][0]}–{paper[axis][1]} cm",
            "{:.0f}–{:.0f} cm".format(*_range_cm(runs, axis)),
        )
        for axis in (0, 1)
    )


def _range_cm(runs: list[Floats], axis: int) -> Floats:
    every = np.concatenate([run[:, axis] for run in runs])
    ends: Floats = 100 * np.percentile(every, SHARE)
    return ends


def _table(courses: dict[str, list[Floats]]) -> Table:
    rows: list[tuple[Cell, ...]] = []
    for name, runs in courses.items():
        for axis in (0, 1):
            mean = 100 * float(np.mean([run[:, axis].mean() for run in runs]))
            std = 100 * float(np.mean([run[:, axis].std() for run in runs]))
            low, high = _range_cm(runs, axis)
            rows.append(("xy"[axis], name, mean, std, float(low), float(high), NOT_GIVEN))
    headings = (
        Column("axis"),
        Column("condition"),
        *(Column(name) for name in ("mean [cm]", "std [cm]", "99 % from [cm]", "to [cm]", "paper's mean and std")),
    )
    caption = "The paper's Tables 1 and 2 made again: means over the laps of each lap's mean and standard deviation"
    return Table("tables-1-and-2", caption, headings, tuple(rows))


def _draw(figure: Figure, clear: Lap, lap: Lap) -> None:
    panels = figure.subplots(2, 1, sharex=True)
    t_s = np.arange(len(lap.truth)) / RATE_HZ
    for axes, axis in zip(panels, (0, 1), strict=True):
        low, high = PAPER["joined"][axis]
        axes.axhspan(low, high, color="#DDEFE8", lw=0, label="paper's range, joined")
        axes.plot(t_s, 100 * lap.radio_alone[:, axis], color=SECOND, lw=0.9, label="somebody in the way, radio alone")
        axes.plot(t_s, 100 * clear.radio_alone[:, axis], color="#8A8A8A", lw=0.7, label="line of sight, radio alone")
        axes.plot(t_s, 100 * lap.joined[:, axis], color=OTHER, lw=0.9, label="somebody in the way, joined")
        axes.plot(t_s, 100 * lap.mended[:, axis], color=FUSED, label=OURS)
        axes.axhline(100 * MIDDLE[axis], color=TRUTH, lw=1, ls="--", label="truth")
        axes.set_ylabel(f"{'xy'[axis]} [cm]")
    panels[1].set_xlabel("time [s]")
    figure.legend(*panels[0].get_legend_handles_labels(), loc="outside upper center", ncols=3)


_CAPTION = "The paper's Fig. 5 made again by simulation: one lap of somebody around a tag that stands at (135, 135) cm."
_WHY = (
    "The paper's tables are lost; the ranges are those that its text reads off the figure. How much a body lengthens "
    "a range, and how noisy its radio and acceleration were, the paper does not say: 30 ± 10 cm, 3 cm and 0.05 m/s² "
    "are our choice, and the ranges hang on it. Ours are those of 99 % of the instants of all laps, not of one "
    "picture."
)
EXPERIMENT = Experiment(
    "shi-standing",
    Chapter.SHI,
    "Standing still while somebody walks around",
    "A tag at (135, 135) cm, ten laps of somebody around it: without fusion x wanders over 100–150 and y over "
    "110–150 cm, with it x over 125–135 and y over 125–140 cm.",
    "Ten simulated laps of 20 s; the walker blocks each of three anchors in turn and lengthens its range. Least "
    "squares on the ranges alone, the paper's join with the acceleration as docs/ranging.md restates it, and the "
    "filter of mirrorlimb locate with the same evidence.",
    run,
    order=1,
)
