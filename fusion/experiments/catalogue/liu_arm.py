"""[Liu2017, Figs. 2-4]: position error and correlation of shoulder, elbow and wrist."""

from __future__ import annotations

from typing import TYPE_CHECKING, Final

import numpy as np

from fusion.experiments.experiment import Chapter, Experiment, Setup
from fusion.experiments.outcome import Beside, Cell, Column, Outcome, Picture, Table, columns
from fusion.experiments.palette import FIRST, FUSED, SECOND
from fusion.inertial.accuracy import PAPER_CORRELATION, WORN
from fusion.inertial.comparison import JOINTS, Comparison, compare_like_liu
from fusion.inertial.simulation import SensorErrors

if TYPE_CHECKING:
    from matplotlib.figure import Figure

RUNS: Final = 8
LENGTH_S: Final = 60.0
CASES: Final = {
    "the sensors' own errors": SensorErrors(),
    "worn on skin (3°), after a rough pose (5°)": WORN,
}


def run(setup: Setup) -> Outcome:
    """Both cases on the same simulated movements."""
    seeds = tuple(setup.seed + k for k in range(setup.many(RUNS)))
    cases: dict[str, list[Comparison]] = {name: [] for name in CASES}
    for number, (name, errors) in enumerate(CASES.items()):
        for k, seed in enumerate(seeds):
            cases[name].append(compare_like_liu(seed, errors, setup.long(LENGTH_S, 30.0)))
            setup.progress((number * len(seeds) + k + 1) / (len(CASES) * len(seeds)))
    worn = list(cases.values())[-1]
    return Outcome(
        tuple(beside for k in (1, 2) for beside in _beside(k, worn)),
        tuple(_table(k, name, runs) for k, (name, runs) in enumerate(cases.items())),
        (Picture("position-error", _CAPTION, lambda figure: _draw(figure, worn[0]), height_in=4.2),),
        _WHY,
        seeds,
    )


def _beside(joint: int, runs: list[Comparison]) -> tuple[Beside, ...]:
    name = JOINTS[joint]
    correlation = float(np.mean([run.correlation[joint] for run in runs]))
    return (
        Beside(f"{name}: correlation with the truth (worn)", f"{PAPER_CORRELATION[name]:.2f}", f"{correlation:.2f}"),
        Beside(f"{name}: position error, rms (worn)", "not given", f"{1e3 * _rms_m(joint, runs):.0f} mm"),
    )


def _rms_m(joint: int, runs: list[Comparison]) -> float:
    return float(np.sqrt(np.mean([run.rms_m[joint] ** 2 for run in runs])))


def _table(number: int, name: str, runs: list[Comparison]) -> Table:
    rows: list[tuple[Cell, ...]] = []
    for joint, label in enumerate(JOINTS):
        off = 1e3 * np.concatenate([np.linalg.norm(run.error_m[:, joint], axis=1) for run in runs])
        correlation = float(np.mean([run.correlation[joint] for run in runs]))
        figures = (1e3 * _rms_m(joint, runs), float(np.percentile(off, 95)), float(off.max()))
        paper = PAPER_CORRELATION[label]
        rows.append((label, *figures, correlation, "not given" if paper is None else f"{paper:.2f}"))
    headings = (
        Column("joint"),
        *columns("rms [mm]", "p95 [mm]", "max [mm]"),
        Column("correlation", 3),
        Column("paper's correlation"),
    )
    return Table(f"case-{number + 1}", f"Simulated arms, {name}", headings, tuple(rows))


def _draw(figure: Figure, run: Comparison) -> None:
    panels = figure.subplots(3, 1, sharex=True, sharey=True)
    step = 5
    for axes, joint in zip(panels, (2, 1, 0), strict=True):
        for axis, colour in enumerate((FIRST, SECOND, FUSED)):
            axes.plot(run.t_s[::step], 1e3 * run.error_m[::step, joint, axis], color=colour, lw=1, label="xyz"[axis])
        axes.set_title(JOINTS[joint])
        axes.set_ylabel("error [mm]")
    panels[0].legend(ncols=3, loc="lower right", bbox_to_anchor=(1, 1))
    panels[-1].set_xlabel("time [s]")


_CAPTION = (
    "The paper's Figs. 2 to 4 made again by simulation: position errors of wrist, elbow and shoulder of one arm, "
    "sensors worn on skin after a rough calibration pose. The shoulder's is the constant left by the weighted "
    "translation."
)
_WHY = (
    "The paper's figures are lost with its pictures; only the correlations are in its text. Our shoulder is the "
    "origin of the chain and does not move in the simulation, so there is nothing to correlate; the paper's "
    "subject's shoulder did move. The simulated arm has no muscles that push the sensors about and obeys its seven "
    "angles exactly; the paper's arm did neither, and its chain has no calibration of how sensors sit."
)
EXPERIMENT = Experiment(
    "liu-arm",
    Chapter.LIU,
    "Position error and correlation per joint",
    "Three inertial sensors on an arm beside OptiTrack, both brought into one frame by a scale, a three-point frame "
    "and a translation weighted 0.6, 0.3, 0.1: correlations 0.91 (shoulder), 0.79 (elbow), 0.70 (wrist).",
    "Eight simulated arms, a minute each, with three sensors whose noise and biases are those of the real sensor in "
    "imu-broad; tracked without magnetometer, compared in the paper's way. Once with the sensors' own errors alone, "
    "once with sensors that turn on the skin and a calibration pose that is off.",
    run,
)
