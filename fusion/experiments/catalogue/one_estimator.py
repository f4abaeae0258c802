"""All sensors in one estimator, each taken away in turn, and both cameras covered."""

from __future__ import annotations

from typing import TYPE_CHECKING, Final

import numpy as np

from fusion.evaluation.scores import Errors, score
from fusion.experiments.experiment import Chapter, Experiment, Setup
from fusion.experiments.measures.losing_sensors import (
    BOTH,
    JUDGED,
    LEARN_S,
    LOSSES,
    Judged,
    Loss,
    Patient,
    Told,
    judged,
    patient,
    together,
    told,
)
from fusion.experiments.outcome import Beside, Cell, Column, Outcome, Picture, Table, columns
from fusion.experiments.palette import FIRST, FIRST_SHADE, FUSED, OTHER, TRUTH, shade
from fusion.skeleton import arm

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure

RUNS: Final = 2
LENGTH_S: Final = 90.0
LEAST_S: Final = LEARN_S + 15.0
"""What is left for the gaps of a short run."""
CM_PER_M: Final = 100.0
SHOWN: Final = Loss("both cameras", BOTH, gap_s=20.0)
SHOWN_WITHOUT: Final = Loss("both cameras and all else", BOTH, True, True, True, gap_s=20.0)


def run(setup: Setup) -> Outcome:
    """Every loss on every patient."""
    seeds = tuple(setup.seed + k for k in range(setup.many(RUNS)))
    people = [patient(seed, setup.long(LENGTH_S, LEAST_S)) for seed in seeds]
    found: dict[str, Judged] = {}
    for k, loss in enumerate(LOSSES):
        if loss.gap_s is None or LEARN_S + loss.gap_s < people[0].end_s:
            found[loss.name] = together([judged(told(who, loss), who.side) for who in people])
        setup.progress((k + 1) / len(LOSSES))
    return Outcome(
        tuple(_beside(found)),
        (_summary(found), *(_by_joint(name, found) for name in JUDGED)),
        tuple(_pictures(people[0])),
        _WHY,
        seeds,
        tuple(f"{loss.name}: the run is too short" for loss in LOSSES if loss.name not in found),
    )


def _beside(found: dict[str, Judged]) -> list[Beside]:
    """There is no paper to stand beside: what docs/one-estimator.md claims."""
    shares = {
        f"{joint}, {name}": score(errors).inside_share
        for name, judged_ in found.items()
        for joint, errors in judged_.by_joint.items()
    }
    worst, inside = min(shares.items(), key=lambda item: item[1])
    everything, alone = (score(found[name].arm).rms_mm for name in ("nothing", "all but the cameras"))
    return [
        Beside("arm, everything there, against cameras alone (rms)", "–", f"{everything:.0f} against {alone:.0f} mm"),
        Beside(
            "truth inside the bound, the worst joint and row",
            "≥ 99.5 %",
            f"{100 * inside:.2f} % ({worst})",
            inside >= 0.995,
        ),
    ]


def _summary(found: dict[str, Judged]) -> Table:
    rows = []
    for name, judged_ in found.items():
        seen_m = judged_.from_shoulder_m
        apart = 1e3 * float(np.sqrt(np.mean(seen_m**2))), 1e3 * float(np.percentile(seen_m, 95))
        rows.append((name, *_figures(judged_.arm), *apart))
    headings = (*_HEADINGS, *columns("seen from the shoulder, rms", "p95", digits=0))
    caption = "Healthy arm (shoulder, elbow, wrist together) while something is gone, mm"
    return Table("arm", caption, headings, tuple(rows))


def _by_joint(joint: str, found: dict[str, Judged]) -> Table:
    rows = tuple((name, *_figures(judged_.by_joint[joint])) for name, judged_ in found.items())
    return Table(joint, f"The {joint} while something is gone, mm", _HEADINGS, rows, folded=joint != "pelvis")


_HEADINGS: Final = (
    Column("taken away"),
    *columns("rms", "p95", "max", "bound, median", digits=0),
    Column("inside [%]", 2),
)


def _figures(errors: Errors) -> tuple[Cell, ...]:
    found = score(errors)
    return found.rms_mm, found.p95_mm, found.max_mm, found.bound_p50_mm, 100 * found.inside_share


def _pictures(who: Patient) -> list[Picture]:
    if LEARN_S + (SHOWN.gap_s or 0.0) >= who.end_s:
        return []
    kept, lost = told(who, SHOWN), told(who, SHOWN_WITHOUT)
    return [
        Picture("both-covered", _TRACES, lambda figure: _draw_traces(figure, who, kept, lost), height_in=4.6),
        Picture("bound", _BOUND, lambda figure: _draw_bound(figure, who, kept, lost), height_in=3.0),
    ]


def _draw_traces(figure: Figure, who: Patient, kept: Told, lost: Told) -> None:
    """The wrist, axis by axis, around the first gap."""
    wrist = arm(who.side)[2]
    shown = _around_gap(kept)
    for axes, axis in zip(figure.subplots(3, 1, sharex=True), range(3), strict=True):
        middle = CM_PER_M * kept.positions[shown, wrist, axis]
        bound = CM_PER_M * kept.bound_m[shown, wrist]
        axes.fill_between(kept.t_s[shown], middle - bound, middle + bound, color=FUSED, alpha=0.15, lw=0, label="bound")
        axes.plot(kept.t_s[shown], CM_PER_M * kept.truth[shown, wrist, axis], color=TRUTH, lw=1, label="truth")
        axes.plot(kept.t_s[shown], middle, color=FUSED, label="inertial sensors and tag go on")
        axes.plot(
            lost.t_s[shown], CM_PER_M * lost.positions[shown, wrist, axis], color=OTHER, lw=1, label="nothing goes on"
        )
        _shade_gap(axes, kept)
        axes.set_ylabel(f"{'xyz'[axis]} [cm]")
    axes.set_xlabel("time [s]")
    figure.legend(*axes.get_legend_handles_labels(), loc="outside upper center", ncols=3)


def _draw_bound(figure: Figure, who: Patient, kept: Told, lost: Told) -> None:
    """Error and bound of the wrist on a logarithmic scale."""
    wrist, axes, shown = arm(who.side)[2], figure.subplots(), _around_gap(kept)
    for run_, colour, name in ((kept, FUSED, "inertial sensors and tag go on"), (lost, FIRST, "nothing goes on")):
        off_m = np.linalg.norm(run_.positions - run_.truth, axis=2)[shown, wrist]
        axes.semilogy(run_.t_s[shown], 1e3 * run_.bound_m[shown, wrist], color=colour, label=f"bound, {name}")
        axes.semilogy(run_.t_s[shown], 1e3 * np.maximum(off_m, 1e-3), color=colour, lw=0.8, ls=":", label="its error")
    _shade_gap(axes, kept)
    axes.set_xlabel("time [s]")
    axes.set_ylabel("wrist [mm]")
    figure.legend(*axes.get_legend_handles_labels(), loc="outside upper center", ncols=3)


def _around_gap(found: Told) -> slice:
    start, end = found.gaps[0]
    first, last = np.searchsorted(found.t_s, [start - 5.0, end + 5.0])
    return slice(int(first), int(last))


def _shade_gap(axes: Axes, found: Told) -> None:
    shade(axes, found.gaps[:1], FIRST_SHADE, "both cameras covered")


_TRACES = "The wrist while both cameras are covered for 20 s: inertial sensors, tag and anatomy go on, or nothing does."
_BOUND = "The same wrist's bound and error."
_WHY = (
    "No paper has such an estimator, so nothing stands beside. Cameras err as in [Du2016] Table 1 (means removed, "
    "0.9 from frame to frame), inertial sensors as the one of BROAD and by 3° of skin, ranges by 10 cm of bias, 4 cm "
    "white and 4 cm slow, and 30 cm too long for 5 % of the time; the patient shifts about by 12 cm. Mounting and "
    "clocks of the cameras are estimated; how the inertial sensors sit, where the anchors stand and what their links "
    "are biased by is learnt within the first 30 s. What is taken away widens the bound and leaves the rest as it "
    "is. Anatomy matters where a joint has neither camera nor inertial sensor. Without the tag nobody knows where a "
    "covered patient walks: the bound says so, while the arm as seen from the shoulder is as good as before."
)
EXPERIMENT = Experiment(
    "one-estimator",
    Chapter.OURS,
    "One estimator: each sensor taken away in turn",
    "The goal: a joint's set is cut by every camera, the inertial chain, the tag at the pelvis and "
    "anatomy; losing any sensor widens the set and nothing else.",
    "A simulated patient with two cameras, four inertial sensors and a tag. After half a minute something is taken "
    "away, for good or for 5 or 20 s at a time, and the errors from half a second later on are scored.",
    run,
    order=1,
)
