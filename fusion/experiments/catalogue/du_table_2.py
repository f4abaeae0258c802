"""[Du2016, Table 2]: the errors after fusion, by every method."""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING, Final

import numpy as np

from fusion.estimation import METHODS
from fusion.experiments.experiment import Chapter, Experiment, Setup
from fusion.experiments.measures.against_truth import ArmErrors, arm_errors
from fusion.experiments.measures.error_law import AXES, TABLE_1, TABLE_2, UNITS, ErrorLaw, error_law
from fusion.experiments.measures.known_scene import known_scene
from fusion.experiments.measures.scene import told
from fusion.experiments.outcome import Beside, Column, Outcome, Picture, Table
from fusion.experiments.palette import PAPER, colour_of
from fusion.offline import fuse_recording
from fusion.recording.recording import Recording

if TYPE_CHECKING:
    from matplotlib.figure import Figure

TRUTH: Final = "dual-kinect-truth-*"
RUNS: Final = 3
LENGTH_S: Final = 40.0
Laws = dict[str, ErrorLaw]


def run(setup: Setup) -> Outcome:
    """Every method on simulated patients, and on the recordings with truth."""
    seeds = tuple(setup.seed + k for k in range(setup.many(RUNS)))
    laws = {"simulated": simulated_laws(setup, seeds)}
    left_out: tuple[str, ...] = ()
    if setup.has(TRUTH):
        laws["recordings"] = recorded_laws(setup, setup.recordings(TRUTH))
    else:
        left_out = ("recordings with truth: none were given.",)
    return Outcome(
        tuple(_beside(where, found) for where, found in laws.items()),
        tuple(_table(where, found) for where, found in laws.items()),
        (Picture("errors-after-fusion", _CAPTION, lambda figure: _draw(figure, laws), height_in=3.4 * len(laws)),),
        _WHY,
        seeds,
        left_out,
    )


def simulated_laws(setup: Setup, seeds: Sequence[int]) -> Laws:
    """By method; the sensors' mounting and clocks are known."""
    scenes = [known_scene(seed, setup.long(LENGTH_S)) for seed in seeds]
    laws = {}
    for k, method in enumerate(METHODS):
        laws[method] = _law([arm_errors(each.recording, told(each.scene, method)[0]) for each in scenes])
        setup.progress((k + 1) / len(METHODS))
    return laws


def recorded_laws(setup: Setup, recordings: Sequence[Recording]) -> Laws:
    """By method, over the instants at which no trouble was planted; mounting and clocks are estimated."""
    laws = {}
    for k, method in enumerate(METHODS):
        laws[method] = _law([arm_errors(recording, fuse_recording(recording, method)) for recording in recordings])
        setup.progress((k + 1) / len(METHODS))
    return laws


def _law(errors: Sequence[ArmErrors]) -> ErrorLaw:
    """Of all joints and instants without planted trouble."""
    parts = [(each.told[each.clear].reshape(-1, 3), each.truth[each.clear].reshape(-1, 3)) for each in errors]
    return error_law(np.concatenate([part for part, _ in parts]), np.concatenate([part for _, part in parts]))


def _beside(where: str, laws: Laws) -> Beside:
    ours = laws["set-membership"].std
    return Beside(
        f"standard deviation after fusion in x, y, z (set-membership, {where})",
        " / ".join(f"{std:.1f}" for std in TABLE_2.std[:3]) + " mm",
        " / ".join(f"{std:.1f}" for std in ours[:3]) + " mm",
    )


def _table(where: str, laws: Laws) -> Table:
    everything = {"paper": TABLE_2} | laws
    figures = [law.std for law in everything.values()] + [law.mean for law in everything.values()]
    headings = [Column(f"{what}, {name}", 2) for what in ("std", "mean") for name in everything]
    rows = tuple((AXES[k], UNITS[k], *(float(figure[k]) for figure in figures)) for k in range(len(AXES)))
    return Table(f"table-2-{where}", f"Errors after fusion, {where}", (Column("axis"), Column("unit"), *headings), rows)


def _draw(figure: Figure, laws: dict[str, Laws]) -> None:
    rows = figure.subplots(len(laws), 1, squeeze=False)[:, 0]
    for axes, (where, found) in zip(rows, laws.items(), strict=True):
        bars = {"one Kinect (Table 1)": TABLE_1, "paper, fused (Table 2)": TABLE_2} | found
        wide = 0.84 / len(bars)
        for k, (name, law) in enumerate(bars.items()):
            at = np.arange(4) + (k - (len(bars) - 1) / 2) * wide
            colour = {0: "#D0D0D0", 1: "#4D4D4D"}.get(k, PAPER if name not in METHODS else colour_of(name))
            axes.bar(at, law.std[:4], wide * 0.92, color=colour, label=name)
        axes.set_xticks(range(4), AXES[:4])
        axes.set_ylabel("standard deviation [mm]")
        axes.set_title(where)
        axes.grid(visible=False, axis="x")
    rows[0].legend(ncols=1, loc="upper left", bbox_to_anchor=(1.0, 1.0))


_CAPTION = "Standard deviation of the error by axis after fusion, the paper's and ours, beside one sensor's."
_WHY = (
    "The average of two independent sensors of Table 1 at a right angle has √(45.6² + 54.1²)/2 = 35 mm in x and in z "
    "while nothing moves, and more while something does, as a sample is held until the next. Errors that stay from "
    "frame to frame, as the simulated ones do (correlation 0.9) and a Kinect's do, hardly average out over time, so "
    "no filter gains much on that. The paper does not say how long its errors last. θ = asin(z/r) is nearly singular "
    "for its subject and not for ours. In the recordings each sensor's mean error was removed beforehand; what is "
    "left of it after fusion is the alignment's."
)
EXPERIMENT = Experiment(
    "du-table-2",
    Chapter.DU,
    "Table 2: the errors after fusion",
    "Two Kinects fused by the extended set-membership filter, means taken off: standard deviations of 34.9 to 40.6 mm.",
    "Two simulated sensors whose noise follows Table 1 with its means taken off, as the paper does, three patients; "
    "and the recordings with truth, outside the trouble planted in them. Every method; mounting and clocks are known "
    "in the simulation and estimated for the recordings; shoulder, elbow and wrist of the healthy arm, in the first "
    "sensor's frame.",
    run,
    order=3,
)
