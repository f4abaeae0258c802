"""[Shi, Fig. 6]: a walk around a square of 2.4 m."""

from __future__ import annotations

from typing import TYPE_CHECKING, Final

import numpy as np

from fusion.experiments.experiment import Chapter, Experiment, Setup
from fusion.experiments.outcome import NOT_GIVEN, Beside, Cell, Column, Outcome, Picture, Table, columns
from fusion.experiments.palette import FUSED, OTHER, SECOND, TRUTH
from fusion.messages import Floats
from fusion.ranging.experiment import ANCHORS, walk_around_a_square
from fusion.ranging.experiment import Outcome as Lap

if TYPE_CHECKING:
    from matplotlib.figure import Figure

LAPS: Final = 10


def run(setup: Setup) -> Outcome:
    """Ten walks around the square."""
    seeds = tuple(setup.seed + k for k in range(setup.many(LAPS)))
    laps = []
    for k, seed in enumerate(seeds):
        laps.append(walk_around_a_square(seed))
        setup.progress((k + 1) / len(seeds))
    alone, joined, ours = (_off_cm(courses, laps) for courses in zip(*map(_courses, laps), strict=True))
    return Outcome(
        (
            Beside("radio alone, rms off the path", NOT_GIVEN, f"{_rms(alone):.0f} cm"),
            Beside("joined by the paper's rule, rms off the path", "very near the path", f"{_rms(joined):.0f} cm"),
            Beside("joined by ours", "very near the path", f"{_rms(ours):.0f} cm", _rms(ours) < _rms(alone)),
        ),
        (_table({"radio alone": alone, "the paper's rule": joined, "ours": ours}),),
        (Picture("square", _CAPTION, lambda figure: _draw(figure, laps[0]), height_in=4.0),),
        _WHY,
        seeds,
    )


def _courses(lap: Lap) -> tuple[Floats, Floats, Floats]:
    return lap.radio_alone, lap.joined, lap.mended


def _off_cm(courses: tuple[Floats, ...], laps: list[Lap]) -> Floats:
    off = [np.linalg.norm((course - lap.truth)[:, :2], axis=1) for course, lap in zip(courses, laps, strict=True)]
    return 100 * np.concatenate(off)


def _rms(values: Floats) -> float:
    return float(np.sqrt(np.mean(values**2)))


def _table(off: dict[str, Floats]) -> Table:
    rows: tuple[tuple[Cell, ...], ...] = tuple(
        (name, _rms(cm), *(float(value) for value in np.percentile(cm, [50, 95, 100])), NOT_GIVEN)
        for name, cm in off.items()
    )
    headings = (Column("method"), *columns("rms", "p50", "p95", "max"), Column("paper"))
    return Table("square", "Distance from the true place on the floor, cm, all walks", headings, rows)


def _draw(figure: Figure, lap: Lap) -> None:
    names, colours = ("radio alone", "the paper's rule", "ours"), (SECOND, OTHER, FUSED)
    panels = figure.subplots(1, 3, sharex=True, sharey=True)
    for axes, name, course, colour in zip(panels, names, _courses(lap), colours, strict=True):
        axes.plot(100 * lap.truth[:, 0], 100 * lap.truth[:, 1], color=TRUTH, lw=2.2, alpha=0.5, label="true path")
        axes.plot(100 * course[:, 0], 100 * course[:, 1], color=colour, lw=1, label=name)
        axes.plot(100 * ANCHORS[:, 0], 100 * ANCHORS[:, 1], "^", color="#4D4D4D", label="anchors")
        axes.set_title(name)
        axes.set_aspect("equal")
        axes.set_xlabel("x [cm]")
    figure.axes[0].set_ylabel("y [cm]")
    figure.axes[0].legend(loc="center")


_CAPTION = (
    "The paper's Fig. 6 made again by simulation: one walk, by radio alone, joined with the acceleration by the "
    "paper's rule, and by ours."
)
_WHY = (
    "The paper shows two pictures and no figure. Its bearer seems to have blocked an anchor now and then; ours "
    "blocks one for a whole side of the square, so that the two that are left are chosen between by a prediction "
    "that has drifted: by the paper's rule the inertial deviation starts anew at 0 with every reset although the speed "
    "is not known, and soon outweighs good ranges. Ours keeps a state of position, speed and heading with honest "
    "variances (docs/ranging.md)."
)
EXPERIMENT = Experiment(
    "shi-square",
    Chapter.SHI,
    "Around a square of 2.4 m",
    "Somebody walks once around the square: radio alone strays from the path, the join keeps very near to it (Fig. 6); "
    "no figure is given.",
    "Ten simulated walks at 0.6 m/s; the bearer's own body, behind the tag, blocks anchors. Radio alone by least "
    "squares, the paper's join as docs/ranging.md restates it, and the filter of mirrorlimb locate.",
    run,
    order=2,
)
