"""Ours: after a million steps every set is still a set."""

from __future__ import annotations

from typing import Final

from fusion.experiments.experiment import Chapter, Experiment, Setup
from fusion.experiments.measures.endurance import Endured, endured
from fusion.experiments.measures.known_scene import known_scene
from fusion.experiments.outcome import Beside, Column, Outcome, Table

STEPS: Final = 1_000_000
METHODS_WITH_SETS: Final = ("set-membership", "esmf", "kalman")
LENGTH_S: Final = 30.0


def run(setup: Setup) -> Outcome:
    """Each method that carries a set from step to step."""
    scene = known_scene(setup.seed, LENGTH_S).scene
    samples = tuple(scene.alignments[sample.sensor].apply(sample, t_s) for t_s, sample in scene.due)
    found = {}
    for number, method in enumerate(METHODS_WITH_SETS):

        def told(share: float, number: int = number) -> None:
            setup.progress((number + share) / len(METHODS_WITH_SETS))

        found[method] = endured(method, samples, setup.many(STEPS, 1000), setup.seed, told)
    return Outcome(
        tuple(_beside(method, one) for method, one in found.items()), (_table(found),), (), _WHY, (setup.seed,)
    )


def _beside(method: str, found: Endured) -> Beside:
    faults = found.not_a_number + found.not_symmetric + found.not_positive
    return Beside(f"{method}: faults after {found.steps:,} steps", "none", str(faults), faults == 0)


def _table(found: dict[str, Endured]) -> Table:
    rows = tuple(
        (
            method,
            one.steps,
            one.looks,
            one.not_a_number,
            one.not_symmetric,
            one.not_positive,
            f"{one.worst_condition:.1e}",
            one.largest_bound_m,
        )
        for method, one in found.items()
    )
    names = ("method", "steps", "looks", "not a number", "not symmetric", "not positive", "worst condition")
    headings = (*(Column(name) for name in names), Column("largest bound [m]"))
    return Table(
        "endurance",
        _CAPTION,
        headings,
        rows,
    )


_CAPTION = (
    "Sets and covariances of all 25 joints, as told and as carried from step to step, looked at every tenth step; "
    "condition: least eigenvalue over the largest"
)
_WHY = "No paper says how its filter does in the long run."
EXPERIMENT = Experiment(
    "numerics",
    Chapter.OURS,
    "A million steps",
    "Symmetric, positive sets and no number that is none after a million steps, whatever is fed.",
    "A simulated patient's samples round and round, two sensors, nine hours of them; about every two hundredth brings "
    "joints that are lost, no numbers, or metres away, or three seconds of silence.",
    run,
    order=9,
    only_by_name=True,
)
