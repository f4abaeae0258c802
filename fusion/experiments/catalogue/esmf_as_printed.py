"""[Du2016 §2.4] letter by letter: with the bounds of its own Table 1 the sets explode."""

from __future__ import annotations

from typing import TYPE_CHECKING, Final

import numpy as np

from fusion.experiments.experiment import Chapter, Experiment, Setup
from fusion.experiments.measures.literal_runs import Followed, follow, follow_literally, hand
from fusion.experiments.outcome import Beside, Cell, Column, Outcome, Picture, Table
from fusion.experiments.palette import FUSED, PAPER, SECOND, colour_of

if TYPE_CHECKING:
    from matplotlib.figure import Figure

BOUNDS_M: Final = (0.02, 0.04, 0.06, 0.10, 0.20)
LENGTH_S: Final = 20.0
EXPLODED_M: Final = 10.0
"""No room is larger."""
PRINTED, MENDED = "as printed", "gain mended alone"
OURS: Final = ("esmf", "set-membership")
SHOWN_S: Final = 1.5


def run(setup: Setup) -> Outcome:
    """Every filter on the same measurements, at five bounds of the noise."""
    courses: dict[tuple[str, float], Followed] = {}
    for k, bound_m in enumerate(BOUNDS_M):
        seen = hand(setup.seed, setup.long(LENGTH_S), bound_m)
        courses[PRINTED, bound_m] = follow_literally(seen, mended_gain=False)
        courses[MENDED, bound_m] = follow_literally(seen, mended_gain=True)
        for method in OURS:
            courses[method, bound_m] = follow(seen, method)
        setup.progress((k + 1) / len(BOUNDS_M))
    exploded_s = _explodes_after_s(courses[PRINTED, BOUNDS_M[-1]])
    said = "holds" if np.isinf(exploded_s) else f"larger than the room after {exploded_s:.2f} s"
    ours = courses["set-membership", BOUNDS_M[-1]]
    return Outcome(
        (
            Beside("the filter as printed, bounds of Table 1", "works (Fig. 16)", said),
            Beside("set-membership, the same noise: median bound", "not given", f"{1e3 * _half(ours):.0f} mm"),
        ),
        (_table(courses),),
        (Picture("sets-explode", _CAPTION, lambda figure: _draw(figure, courses), height_in=3.6),),
        _WHY,
        (setup.seed,),
    )


def _explodes_after_s(course: Followed) -> float:
    """When the set is first larger than any room; +inf where it never is."""
    large = np.flatnonzero(course.half_axis_m > EXPLODED_M)
    return float(course.t_s[large[0]] - course.t_s[0]) if len(large) else float("inf")


def _half(course: Followed) -> float:
    return float(np.median(course.half_axis_m))


def _table(courses: dict[tuple[str, float], Followed]) -> Table:
    rows: list[tuple[Cell, ...]] = []
    for (name, bound_m), course in courses.items():
        exploded_s = _explodes_after_s(course)
        held = course.half_axis_m < EXPLODED_M
        error_mm = 1e3 * float(np.sqrt(np.mean(course.error_m[held] ** 2)))
        outside = 100 * float(np.mean(course.error_m[held] > course.half_axis_m[held]))
        half_mm = "exploded" if np.isfinite(exploded_s) else f"{1e3 * _half(course):.0f}"
        when = "never" if np.isinf(exploded_s) else f"{exploded_s:.2f} s"
        unused = 100 * float(np.mean(course.refused))
        rows.append((f"{1e3 * bound_m:.0f}", name, half_mm, when, unused, error_mm, outside))
    headings = (
        Column("noise within ± [mm]"),
        Column("filter"),
        Column("median longest half axis [mm]"),
        Column("explodes after"),
        Column("measurements not used [%]"),
        Column("error until then, rms [mm]"),
        Column("truth outside until then [%]"),
    )
    return Table(
        "explosion",
        "One hand, two sensors at a right angle, every filter on the same measurements",
        headings,
        tuple(rows),
    )


def _draw(figure: Figure, courses: dict[tuple[str, float], Followed]) -> None:
    axes = figure.subplots()
    lines = [
        (PRINTED, 0.04, PAPER, "-", "as printed, noise within ±40 mm"),
        (PRINTED, 0.06, SECOND, "--", "as printed, ±60 mm"),
        (PRINTED, 0.20, SECOND, "-", "as printed, ±200 mm (Table 1)"),
        ("esmf", 0.20, colour_of("esmf"), "-", "our esmf, ±200 mm"),
        ("set-membership", 0.20, FUSED, "-", "our set-membership, ±200 mm"),
    ]
    for name, bound_m, colour, dashes, label in lines:
        course = courses[name, bound_m]
        shown = (course.t_s < SHOWN_S) & (course.half_axis_m < 1e4)
        axes.plot(course.t_s[shown], course.half_axis_m[shown], color=colour, ls=dashes, label=label)
    axes.axhline(EXPLODED_M, color="#4D4D4D", lw=0.8, ls=":")
    axes.text(SHOWN_S, EXPLODED_M * 1.15, "larger than any room", ha="right", va="bottom", fontsize=8)
    axes.set_yscale("log")
    axes.set_ylim(0.05, 100)
    axes.set_xlim(0, SHOWN_S)
    axes.set_xlabel("time [s]")
    axes.set_ylabel("longest half axis of the hand's set [m]")
    axes.legend(loc="upper left", bbox_to_anchor=(1, 1))


_CAPTION = "The set of a hand's position over the first second and a half."
_WHY = (
    "As printed, the remainder of the linearised measurement is bounded over the predicted set, so a large set makes a "
    "larger remainder and that a larger set; with the printed ρ a cut leaves √(P R), which is larger than P whenever R "
    "is; and the trace in β adds square metres to squares of metres per second. Below some size of the noise the three "
    "stay in balance, above it nothing stops them, and once the numbers overflow no measurement can be used. Mending "
    "the gain changes nothing in that. The paper must have used something else than it printed, or smaller sets. Our "
    "esmf turns each measurement's own box to Cartesian, which depends on no prediction; set-membership cuts with "
    "strips of least volume besides. Both always reckon with the intervals of Table 1, however small the noise."
)
EXPERIMENT = Experiment(
    "esmf-as-printed",
    Chapter.DU,
    "The filter as printed",
    "Equations (7) to (11) with the noise's interval from Table 1; the paper reports that the filter works (Fig. 16, "
    "Table 2).",
    "The printed equations, word for word but for the lost 'tr' in β, follow one hand of a simulated patient between "
    "two sensors; noise within ±20 to ±200 mm, its correlation from frame to frame 0.9; start within 1 m/s. Beside it "
    "the same with the gain that belongs to the set's centre, and our esmf and set-membership, on the same "
    "measurements.",
    run,
    order=5,
)
