"""Ours: two real Kinects at a right angle, either one covered for a second while the patient stands."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING, Final

import numpy as np

from fusion.estimation import METHODS
from fusion.experiments.experiment import Chapter, Experiment, Setup
from fusion.experiments.measures.covering import Covering, covering
from fusion.experiments.measures.scene import Scene, scene_of
from fusion.experiments.measures.steadiness import Steadiness, steadiness
from fusion.experiments.outcome import Beside, Cell, Column, Outcome, Picture, Table, columns
from fusion.experiments.palette import FIRST, SECOND, colour_of

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure

STUDIES: Final = "dual-kinect-study??-90deg"
ALL_CALLED: Final = "dual-kinect-"
MOMENTS: Final = 30
DEFAULT: Final = next(iter(METHODS))
GOAL_MM: Final = 20.0


@dataclass(frozen=True, slots=True)
class Study:
    """One recording, one method."""

    recording: str
    """Without what all of them are called."""
    method: str
    coverings: tuple[Covering, ...]
    steadiness: tuple[Steadiness, ...]
    """The method, then each sensor alone."""

    @property
    def better(self) -> Steadiness:
        """The best that any single sensor does, figure by figure."""
        alone = self.steadiness[1:]
        return Steadiness("better sensor", min(one.bone_std_m for one in alone), min(one.jitter_m for one in alone))


def run(setup: Setup) -> Outcome:
    """Every recording with every method."""
    scenes = [scene_of(recording) for recording in setup.recordings(STUDIES)]
    pairs = [(scene, method) for method in METHODS for scene in scenes]
    studies = []
    for k, (scene, method) in enumerate(pairs):
        studies.append(_study(scene, method, setup))
        setup.progress((k + 1) / len(pairs))
    ours = [study for study in studies if study.method == DEFAULT]
    return Outcome(
        _beside(ours),
        (_moved_table(studies), _steady_table(studies)),
        (
            Picture("moved", _MOVED, lambda figure: _draw_moved(figure, ours), height_in=3.8),
            Picture("steady", _STEADY, lambda figure: _draw_steady(figure, ours), height_in=3.2),
        ),
        _WHY,
        (setup.seed,),
    )


def _study(scene: Scene, method: str, setup: Setup) -> Study:
    covered = covering(scene, method, setup.many(MOMENTS), setup.seed)
    return Study(scene.name.removeprefix(ALL_CALLED), method, covered, steadiness(scene, method))


def _beside(studies: Sequence[Study]) -> tuple[Beside, ...]:
    """The goals, recording by recording."""
    rows = []
    for study in studies:
        medians = [1e3 * float(np.median(covered.moved_m)) for covered in study.coverings]
        said = " / ".join(f"{mm:.1f}" for mm in medians)
        what = f"{study.recording}: either sensor covered, median move"
        rows.append(Beside(what, f"at most {GOAL_MM:.0f} mm", f"{said} mm", max(medians, default=0.0) <= GOAL_MM))
        fused, better = study.steadiness[0], study.better
        rows.append(_half(f"{study.recording}: bone lengths' std", fused.bone_std_m, better.bone_std_m))
        rows.append(_half(f"{study.recording}: jitter above 5 Hz", fused.jitter_m, better.jitter_m))
    return tuple(rows)


def _half(what: str, ours_m: float, sensor_m: float) -> Beside:
    goal = f"at most half of {1e3 * sensor_m:.1f} mm"
    return Beside(what, goal, f"{1e3 * ours_m:.1f} mm", ours_m <= sensor_m / 2)


def _moved_table(studies: Sequence[Study]) -> Table:
    rows: list[tuple[Cell, ...]] = []
    for study in studies:
        for covered in study.coverings:
            moved, apart = 1e3 * covered.moved_m, 1e3 * covered.half_apart_m
            figures = [*np.percentile(moved, [50, 95, 100]), *np.nanpercentile(apart, [50, 95])]
            coasted = 100 * float(covered.coasted.mean())
            where = (study.recording, study.method, covered.sensor, len(covered.moments_s))
            rows.append((*where, *(float(figure) for figure in figures), coasted, covered.follows))
    headings = (
        *(Column(name) for name in ("recording", "method", "covered", "moments")),
        *columns("moved p50", "moved p95", "moved max", "half apart p50", "half apart p95", "coasted [%]"),
        Column("follows", 2),
    )
    caption = (
        "How far shoulder, elbow and wrist of the healthy arm move, mm; half apart: half the sensors' own distance, "
        "less its median in that stretch; follows: share of a sway of 0.1 m, seen by the sensor that is left, that the "
        "fused arm follows (0 = coasts)"
    )
    return Table("moved", caption, headings, tuple(rows))


def _steady_table(studies: Sequence[Study]) -> Table:
    rows: list[tuple[Cell, ...]] = []
    for study in studies:
        fused, *alone = study.steadiness
        rows.append((study.recording, study.method, 1e3 * fused.bone_std_m, 1e3 * fused.jitter_m))
        if study.method == DEFAULT:
            rows += [(study.recording, f"{one.name} alone", 1e3 * one.bone_std_m, 1e3 * one.jitter_m) for one in alone]
    headings = (Column("recording"), Column("method"), Column("bone lengths' std [mm]"), Column("jitter [mm]", 2))
    caption = "Upper arm and forearm of the healthy side over the whole recording; jitter above 5 Hz while standing"
    return Table("steady", caption, headings, tuple(sorted(rows, key=lambda row: str(row[0]))))


def _draw_moved(figure: Figure, studies: Sequence[Study]) -> None:
    panels = figure.subplots(1, len(studies), sharey=True, squeeze=False)[0]
    for axes, study in zip(panels, studies, strict=True):
        for covered, colour in zip(study.coverings, (FIRST, SECOND), strict=False):
            _draw_shares(axes, 1e3 * covered.moved_m, colour, "-", f"{covered.sensor} covered")
            _draw_shares(
                axes, 1e3 * covered.half_apart_m, colour, ":", f"half the sensors' distance ({covered.sensor})"
            )
        axes.axvline(GOAL_MM, color="#4D4D4D", lw=0.8)
        axes.set_xscale("log")
        axes.set_xlim(0.5, 1000)
        axes.set_xlabel("move [mm]")
        axes.set_title(study.recording)
    panels[0].set_ylabel("share of joint-frames [%]")
    figure.legend(*panels[0].get_legend_handles_labels(), loc="outside lower center", ncols=2)


def _draw_shares(axes: Axes, values: np.ndarray, colour: str, dashes: str, label: str) -> None:
    known = np.sort(values[np.isfinite(values)])
    at = np.unique(np.linspace(0, len(known) - 1, 400).astype(int))  # so that the file stays small
    axes.plot(known[at], 100 * (at + 1) / len(known), color=colour, ls=dashes, label=label)


def _draw_steady(figure: Figure, studies: Sequence[Study]) -> None:
    panels = figure.subplots(1, 2)
    titles = ("bone lengths", "jitter above 5 Hz, standing")
    for axes, title, field in zip(panels, titles, ("bone_std_m", "jitter_m"), strict=True):
        for k, colour in enumerate((colour_of(DEFAULT), FIRST, SECOND)):
            values = [1e3 * getattr(study.steadiness[k], field) for study in studies]
            at = np.arange(len(studies)) + (k - 1) * 0.26
            axes.bar(at, values, 0.24, color=colour, label="fused" if k == 0 else f"sensor {k} alone")
        halves = [1e3 * getattr(study.better, field) / 2 for study in studies]
        axes.hlines(halves, np.arange(len(studies)) - 0.4, np.arange(len(studies)) + 0.4, color="black", label="goal")
        names = [study.recording.removesuffix("-90deg") for study in studies]
        axes.set_xticks(range(len(studies)), names)
        axes.set_title(title)
        axes.grid(visible=False, axis="x")
    panels[0].set_ylabel("standard deviation, or rms [mm]")
    figure.legend(*panels[0].get_legend_handles_labels(), loc="outside lower center", ncols=4)


_MOVED = "Share of joint-frames that move by less than so much, set-membership; the line is the goal for the median."
_STEADY = "How much bones vary and joints tremble, set-membership beside each sensor alone."
_WHY = (
    "No paper has this. At a right angle each Kinect sees a joint elsewhere by centimetres, and on some of these "
    "recordings the far arm is another arm altogether for one sensor; the offsets between the sensors are learnt while "
    "both see the joint. Where they change with the posture, or one sensor takes a wrong arm for the right one, the "
    "joint moves far when the other is covered: the p95."
)
EXPERIMENT = Experiment(
    "covered-90deg",
    Chapter.OURS,
    "Covering either real sensor while the patient stands",
    "A fused arm joint moves by at most 20 mm in the median when either sensor is covered for a second, and does not "
    "coast; fused bones vary at most half as much as the better sensor's, and joints tremble at most half as much.",
    "Real recordings of two Kinects at about 90°. At 30 random moments of standing for each sensor the course is "
    "split: in one the sensor's frames are missing for a second; the fused shoulder, elbow and wrist of the healthy "
    "arm are compared at the same instants. Whether the method listens to the sensor that is left is tested by letting "
    "that one see the whole body sway.",
    run,
    needs=STUDIES,
    order=2,
)
